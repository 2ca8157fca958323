#include "app/gui/project/Workbench.h"

#include "app/gui/project/changes/ProjectChange.h"

#include <QUndoCommand>

#include <algorithm>

namespace palp {

namespace {

constexpr int kMergeId = 1;

/// The same project with the view, the boards, the reference design and the studies of `other`.
Project shownAs(Project project, const Project& other) {
  project.view = other.view;
  project.live = other.live;
  project.moreBoards = other.moreBoards;
  project.kept = other.kept;
  project.studies = other.studies;
  return project;
}

} // namespace

/// One entry of the history: the project before and after. An edit leaves the view as it is.
class ProjectEdit : public QUndoCommand {
public:
  ProjectEdit(Workbench& workbench, QString kind, Project after)
      : workbench_(workbench), kind_(std::move(kind)), place_(workbench.place_), before_(workbench.project_),
        after_(std::move(after)) {
    name();
  }

  void undo() override { go(before_, QObject::tr("Undone: %1")); }
  void redo() override {
    if (std::exchange(done_, true)) return go(after_, QObject::tr("Redone: %1"));
    workbench_.apply(shownAs(after_, workbench_.project()));
  }
  [[nodiscard]] int id() const override { return kMergeId; }
  [[nodiscard]] const SensorDesign& before() const { return before_.design; }
  [[nodiscard]] const SensorDesign& after() const { return after_.design; }
  [[nodiscard]] const QDateTime& when() const { return when_; }
  bool mergeWith(const QUndoCommand* later) override {
    const auto& edit = *static_cast<const ProjectEdit*>(later);
    if (!workbench_.entryOpen_ || edit.kind_ != kind_) return false;
    after_ = edit.after_;
    when_ = edit.when_;
    setObsolete(after_ == shownAs(before_, after_)); // there and back again: nothing to undo
    name();
    return true;
  }

private:
  void name() { setText(changeWords(kind_, before_, after_)); }
  void go(const Project& to, const QString& words) {
    const Project shown = workbench_.project();
    workbench_.apply(shownAs(to, shown));
    emit workbench_.wentBack(place_, words.arg(text()), shown);
  }

  Workbench& workbench_;
  QString kind_;
  QString place_; ///< the scene it was made in
  Project before_, after_;
  QDateTime when_ = QDateTime::currentDateTime();
  bool done_ = false;
};

Workbench::Workbench(const Project& project, QObject* parent) : QObject(parent), saved_(project) {
  history_.setUndoLimit(200);
  apply(project);
}

void Workbench::edit(const QString& what, const Project& next) {
  if (next == project()) return;
  if (!acceptsLosses(lossQuestion_.losses({Leaving::Way::Edit, &next}))) return showAgain();
  if (next == shownAs(project(), next)) { // nothing that the history records
    apply(next);
    return;
  }
  project_ = shownAs(project(), next); // what is shown is not part of the history
  history_.push(new ProjectEdit(*this, what, next));
  entryOpen_ = true;
}

void Workbench::edit(const QString& what, const std::function<void(Project&)>& change) {
  Project next = project();
  change(next);
  edit(what, next);
}

void Workbench::replace(const Project& project, const QString& file) {
  begin(project, file, project);
}

void Workbench::replaceUnsaved(const Project& project, const QString& file) {
  begin(project, file, {});
}

void Workbench::begin(const Project& project, const QString& file, std::optional<Project> saved) {
  entryOpen_ = false;
  history_.clear();
  file_ = file;
  saved_ = std::move(saved);
  apply(project);
  emit projectReplaced();
}

std::vector<EarlierDesign> Workbench::earlierDesigns() const {
  std::vector<EarlierDesign> all;
  const auto add = [&](const ProjectEdit& edit, const SensorDesign& design, bool undone) {
    const auto same = [&](const EarlierDesign& other) { return other.design == design; };
    if (edit.before() == edit.after() || design == project().design || std::any_of(all.begin(), all.end(), same))
      return;
    all.push_back({design, edit.text(), edit.when(), undone});
  };
  const auto entry = [this](int k) { return static_cast<const ProjectEdit*>(history_.command(k)); };
  for (int k = history_.index() - 1; k >= 0; --k) add(*entry(k), entry(k)->before(), false);
  for (int k = history_.index(); k < history_.count(); ++k) add(*entry(k), entry(k)->after(), true);
  return all;
}

Workbench::Modified Workbench::modification() const {
  if (!saved_) return Modified::Project;
  Project last = *saved_;
  const LiveSettings& live = project().live;
  last.view = project().view;
  last.live.source = live.source;
  last.live.device = live.device;
  last.live.recording = live.recording;
  last.live.replaySpeed = live.replaySpeed;
  last.live.simulation = live.simulation;
  if (last == project()) return Modified::Nothing;
  const bool calibrated = last.live.frames != live.frames || last.live.calibrated != live.calibrated;
  last.live = live;
  if (last != project()) return Modified::Project;
  return calibrated ? Modified::Calibration : Modified::LiveSettings;
}

void Workbench::saved(const QString& file) {
  saved_ = project();
  file_ = file;
  emit fileChanged();
}

bool Workbench::comparable() const {
  return project().view.uniform ? !project().load.indenters.empty() : project().kept.has_value();
}

std::shared_ptr<const ReferencePath> Workbench::referencePath() const {
  if (!comparable()) return nullptr;
  const bool uniform = project().view.uniform;
  return kept_.pathFor(uniform ? touch_.touch().design() : *project().kept, touch_.touch(), uniform);
}

void Workbench::needReference() {
  if (!comparable() || !touch_.upToDate()) return;
  const bool uniform = project().view.uniform;
  kept_.want(uniform ? touch_.touch().design() : *project().kept, touch_.touch(), uniform);
}

std::optional<TouchResistances> Workbench::resistances() const {
  if (touch_.electrodes() == nullptr) return {};
  if (touch_.touch().design().field() == nullptr) return resistancesOf(touch_.touch().design(), *touch_.electrodes());
  return field_.of(touch_.touch(), touch_.loadFraction());
}

std::optional<TouchResistances> Workbench::resistancesAtEnd() const {
  const Touch& touch = touch_.touch();
  if (touch.displacements() == nullptr) return {};
  if (touch.design().field() == nullptr) return resistancesOf(touch.design(), *touch.displacements());
  return field_.of(touch, touch.solution()->reachedLoadFraction);
}

std::optional<TouchResistances> Workbench::referenceResistances() const {
  const auto kept = referencePath();
  if (!kept) return {};
  if (!kept->touch) return resistancesOf(kept->design, kept->at(touch_.loadFraction()).electrodes);
  return referenceField_.of(*kept->touch, kept->fractionAt(touch_.loadFraction()));
}

void Workbench::needResistances() {
  if (touch_.upToDate()) field_.want(touch_.touch(), touch_.loadFraction());
}

void Workbench::needReferenceResistances() {
  needReference();
  if (const auto kept = referencePath(); kept && kept->touch)
    referenceField_.want(*kept->touch, kept->fractionAt(touch_.loadFraction()));
}

void Workbench::apply(const Project& project) {
  project_ = project;
  if (!comparable()) kept_.forget();
  const SensorDesign* other = project.view.uniform ? &project.design : project.kept ? &*project.kept : nullptr;
  if (!comparable() || other->field() == nullptr) referenceField_.leave();
  if (project.design.field() == nullptr) field_.leave();
  touch_.setInputs(project.design, project.load, project.mesh, loadsAfter(project.load, project.path, project.design));
  emit projectChanged();
  emit fileChanged();
}

} // namespace palp
