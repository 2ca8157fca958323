#include "app/gui/window/exports/ExportSource.h"

#include "app/gui/network/NetworkSource.h"
#include "app/gui/project/ExportLines.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/project/changes/ProjectChange.h"
#include "app/gui/window/Scene.h"

#include <QStringList>

namespace palp {

namespace {

/// The project with the inputs of the touch that is shown.
Project ofTouch(Workbench& workbench) {
  const Touch& touch = workbench.touch().touch();
  Project made = workbench.project();
  made.design = touch.design();
  made.load = touch.load();
  made.mesh = touch.meshOptions();
  if (touch.path() != loadsAfter(made.load, made.path, made.design)) made.path.reset();
  return made;
}

QString studiesStale(const Project& project) {
  QStringList reasons;
  const auto add = [&](const QString& what, const SensorDesign& of) {
    Project then = project;
    then.design = of;
    const QString since = sinceWords(then, project);
    if (!since.isEmpty()) reasons << QObject::tr("%1: %2").arg(what, since);
  };
  const DesignStudies& studies = project.studies;
  if (studies.curve) add(QObject::tr("sweep of the design"), studies.curve->design);
  if (studies.mapped) {
    SensorDesign of = studies.mapped->design;
    of.resistance = project.design.resistance; // the law was chosen for the map
    add(QObject::tr("map of the resolution"), of);
  }
  if (studies.compared) add(QObject::tr("comparison"), studies.compared->now);
  return reasons.join("; ");
}

} // namespace

QString touchStale(Workbench& workbench) {
  if (workbench.touch().upToDate()) return {};
  const QString since = sinceWords(ofTouch(workbench), workbench.project());
  return since.isEmpty() ? QObject::tr("something that it depends on has changed since") : since;
}

QString exportSource(const Scene& scene, const QWidget& saved, Workbench& workbench, const NetworkSession& network) {
  const QString name = scene.objectName();
  const Project& now = workbench.project();
  if (name == "network") return networkSource(saved.objectName(), now, network);
  Project made = now;
  QString stale;
  if (name == "deformation" || name == "resistance") {
    made = ofTouch(workbench);
    stale = touchStale(workbench);
  } else if (name == "design") {
    stale = studiesStale(now);
  }
  return exportLines(scene.commands(made, "sensor.json"), made.design, stale);
}

} // namespace palp
