#include "app/gui/window/SceneCosts.h"

#include "app/gui/project/Workbench.h"
#include "app/gui/views/PictureView.h"
#include "app/gui/window/MainWindow.h"
#include "app/study/reports/ProcessMemory.h"
#include "model/base/NumberText.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QEvent>
#include <QEventLoop>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTimer>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace palp {

namespace {

constexpr int kLookEvery_ms = 10;
constexpr double kQuiet_s = 0.15;    ///< without work and pictures: a step is over
constexpr double kDrawsOn_s = 0.6;   ///< a scene with a live board draws on and on: over so long after the last work
constexpr double kIncomplete_s = 15; ///< nothing runs and the scene is not complete: it failed
constexpr double kAlone_s = 1;
constexpr std::array kStages{"mesh", "factorise", "solve"};

using Runs = std::array<int, kStages.size()>;

Runs runs(const StageLog& log) {
  Runs result{};
  for (std::size_t s = 0; s < kStages.size(); ++s) result[s] = log.runs(kStages[s]);
  return result;
}

/// Of all threads: a software renderer draws in its own.
double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Seconds since the process was started, to 0.01 s: field 22 of /proc/self/stat (proc(5)) against the time since boot.
double age_s() {
  std::ifstream file("/proc/self/stat");
  std::string word;
  std::getline(file, word, ')'); // the name may hold spaces
  for (int field = 3; field <= 22; ++field) file >> word;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const double start_s = numberIn(word).value_or(0) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) - start_s;
}

void spin(int milliseconds) {
  QEventLoop loop;
  QTimer::singleShot(milliseconds, &loop, &QEventLoop::quit);
  loop.exec();
}

/// A scene that shows nothing computed, to hide the named one behind.
QString another(const QString& name) {
  return name == "reports" ? "design" : "reports";
}

} // namespace

SceneCosts::SceneCosts(MainWindow& window, Workbench& workbench) : window_(window), workbench_(workbench) {
  qApp->installEventFilter(this);
}

bool SceneCosts::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Paint || !watched->isWidgetType()) return false;
  const QWidget* scenes = window_.currentScene().parentWidget();
  for (const auto* widget = static_cast<const QWidget*>(watched); widget != nullptr; widget = widget->parentWidget())
    if (widget->parentWidget() == scenes) ++paintings_[widget->objectName()];
  return false;
}

/// Pictures that the views of each scene drew.
std::map<QString, int> SceneCosts::drawings() const {
  std::map<QString, int> result;
  const QWidget* scenes = window_.currentScene().parentWidget();
  for (const QString& name : window_.sceneNames())
    for (const auto* view :
         scenes->findChild<QWidget*>(name, Qt::FindDirectChildrenOnly)->findChildren<const PictureView*>())
      result[name] += view->renderCount();
  return result;
}

/// A view of the scene that is seen; on a busy machine that may take longer than a step is quiet for.
bool SceneCosts::waitsToDraw() const {
  const auto views = window_.currentScene().findChildren<const PictureView*>();
  return std::any_of(views.begin(), views.end(), [](const PictureView* view) { return view->waitsToDraw(); });
}

double SceneCosts::settle() {
  QElapsedTimer clock;
  clock.start();
  double ran_s = 0, worked_s = 0, drew_s = 0;
  for (auto drawn = drawings();;) {
    spin(kLookEvery_ms);
    const double now_s = 1e-9 * static_cast<double>(clock.nsecsElapsed());
    if (window_.busy()) ran_s = worked_s = now_s;
    if (!window_.currentScene().complete()) worked_s = now_s;
    if (auto now = drawings(); now != drawn) {
      drew_s = now_s;
      drawn = std::move(now);
    }
    const bool waits = waitsToDraw();
    if (!waits && now_s - std::max(worked_s, drew_s) > kQuiet_s) return std::max(worked_s, drew_s);
    if ((!waits || drew_s > worked_s) && now_s - worked_s > kDrawsOn_s) return worked_s;
    if (now_s - ran_s > kIncomplete_s) return worked_s;
  }
}

QJsonObject SceneCosts::step(const QString& event, const std::function<void()>& change, double exactly_s) {
  const bool fromStart = !window_.isVisible();
  const double startedBefore_s = fromStart ? age_s() : 0, cpuBefore_s = fromStart ? 0 : cpu_s();
  const Runs runsBefore = runs(workbench_.touch().stages());
  const auto drawnBefore = drawings();
  paintings_.clear();
  if (!fromStart) resetPeakMemory();
  QElapsedTimer clock;
  clock.start();
  change();
  const double changing_s = 1e-9 * static_cast<double>(clock.nsecsElapsed());
  if (exactly_s > 0) spin(static_cast<int>(1000 * exactly_s));
  const double seconds = exactly_s > 0 ? exactly_s : startedBefore_s + changing_s + settle();

  const Scene& seen = window_.currentScene();
  QJsonObject result{{"scene", seen.objectName()}, {"event", event}};
  const Runs runsAfter = runs(workbench_.touch().stages());
  for (std::size_t s = 0; s < kStages.size(); ++s) result[kStages[s]] = runsAfter[s] - runsBefore[s];
  int drawn = 0, hidden = 0;
  for (const auto& [name, count] : drawings()) {
    const auto before = drawnBefore.find(name);
    const int more = count - (before == drawnBefore.end() ? 0 : before->second);
    (name == seen.objectName() ? drawn : hidden) += more;
  }
  for (const auto& [name, count] : paintings_)
    if (name != seen.objectName()) hidden += count;
  result["pictures"] = drawn;
  result["hidden_pictures"] = hidden;
  result["seconds"] = seconds;
  result["cpu_s"] = cpu_s() - cpuBefore_s;
  result["held_MB"] = heldMemory_MB();
  result["peak_MB"] = peakMemory_MB();
  result["shows_mesh"] = seen.stage() >= Stage::Mesh;
  result["shows_solution"] = seen.stage() >= Stage::Solution;
  result["complete"] = !window_.busy() && seen.complete();
  return result;
}

QJsonArray SceneCosts::oneScene(const QString& name) {
  const auto edited = [this](const std::function<void(Project&)>& change) {
    return [this, change] {
      Project next = workbench_.project();
      change(next);
      workbench_.edit("scene costs", next);
    };
  };
  const auto otherLoad = edited([](Project& project) {
    const ForceRange& range = project.design.forceRange;
    const int area = project.design.areas.count() - 1;
    const bool there = !project.load.areas.empty() && project.load.areas[0].area == area;
    project.load = {{{there ? 0 : area, (range.low_N + range.high_N) / 2}}, {}};
  });
  const auto see = [this](const QString& scene) {
    return [this, scene] {
      window_.showScene(scene);
      window_.show();
    };
  };
  QJsonArray steps;
  steps << step("opened", see(name));
  steps << step(
      "left alone", [] {}, kAlone_s);
  steps << step("another load", otherLoad);
  steps << step("another material", edited([](Project& project) {
                  project.design.material.law = timesStress(project.design.material.law, 0.9);
                }));
  const auto moved = [](ElectrodeLayer& layer, double factor) {
    for (std::vector<double>& depths : layer.z_mm)
      for (double& z : depths) z *= factor;
  };
  steps << step("lower layer moved", edited([&](Project& project) { moved(project.design.lower, 0.9); }));
  steps << step("upper layer moved", edited([&](Project& project) { moved(project.design.upper, 0.99); }));
  steps << step("hidden behind " + another(name), see(another(name)));
  steps << step("another load while hidden", otherLoad, kAlone_s);
  steps << step("seen again", see(name));
  for (auto&& each : steps) {
    QJsonObject object = each.toObject();
    object["scene"] = name;
    each = object;
  }
  return steps;
}

QJsonArray SceneCosts::allScenes() {
  QJsonArray steps;
  for (const char* event : {"in turn", "in turn again"})
    for (const QString& name : window_.sceneNames())
      steps << step(event, [this, name] {
        window_.showScene(name);
        window_.show();
      });
  return steps;
}

void printSceneCosts(MainWindow& window, Workbench& workbench, const QString& scene) {
  SceneCosts costs(window, workbench);
  const QJsonArray steps = scene.isEmpty() ? costs.allScenes() : costs.oneScene(scene);
  const QJsonObject all{{"scenes", QJsonArray::fromStringList(window.sceneNames())},
                        {"window_px", QJsonArray{window.width(), window.height()}},
                        {"steps", steps}};
  std::cout << QJsonDocument(all).toJson(QJsonDocument::Compact).toStdString() << "\n";
}

} // namespace palp
