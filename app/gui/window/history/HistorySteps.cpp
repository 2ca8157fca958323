#include "app/gui/window/history/HistorySteps.h"

#include "app/gui/jobs/CallLater.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/window/MainWindow.h"

namespace palp {

namespace {

/// A scene shows some of what is otherwise in two projects.
bool shows(const QString& scene, const Project& a, const Project& b) {
  const bool block = scene == "deformation" || scene == "resistance";
  if (a.design != b.design && (block || scene == "design")) return true;
  if (a.load != b.load && block) return true;
  if (a.mesh != b.mesh && (scene == "deformation" || scene == "design")) return true;
  return (a.samples != b.samples || a.network != b.network) && scene == "network";
}

} // namespace

HistorySteps::HistorySteps(MainWindow& window, Workbench& workbench)
    : QObject(&window), window_(window), workbench_(workbench) {
  connect(&workbench, &Workbench::wentBack, this,
          [this](const QString& scene, const QString& sentence, const Project& before) {
            scene_ = scene;
            sentence_ = sentence;
            if (from_) return;
            from_ = before;
            callLater(*this, [this] { arrive(); });
          });
}

void HistorySteps::arrive() {
  const Project from = *from_;
  from_.reset();
  const bool elsewhere = !shows(window_.currentScene().objectName(), from, workbench_.project());
  if (elsewhere) window_.showScene(scene_);
  window_.showMessage(elsewhere ? tr("%1, in the scene %2").arg(sentence_, window_.sceneTitle()) : sentence_);
}

} // namespace palp
