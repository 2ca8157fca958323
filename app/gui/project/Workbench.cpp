#include "app/gui/project/Workbench.h"

#include <QUndoCommand>

namespace palp {

namespace {

constexpr int kMergeId = 1;

} // namespace

/// One entry of the history: the project before and after.
class ProjectEdit : public QUndoCommand {
public:
  ProjectEdit(Workbench& workbench, const QString& what, Project after)
      : QUndoCommand(what), workbench_(workbench), before_(workbench.project()), after_(std::move(after)) {}

  void undo() override { workbench_.apply(before_); }
  void redo() override { workbench_.apply(after_); }
  [[nodiscard]] int id() const override { return kMergeId; }
  bool mergeWith(const QUndoCommand* later) override {
    if (later->text() != text()) return false;
    after_ = static_cast<const ProjectEdit*>(later)->after_;
    setObsolete(after_ == before_); // there and back again is nothing to undo
    return true;
  }

private:
  Workbench& workbench_;
  Project before_;
  Project after_;
};

Workbench::Workbench(const Project& project, QObject* parent) : QObject(parent) {
  history_.setUndoLimit(200);
  apply(project);
}

void Workbench::edit(const QString& what, const Project& next) {
  if (next == project_) return;
  history_.push(new ProjectEdit(*this, what, next));
}

void Workbench::replace(const Project& project) {
  history_.clear();
  apply(project);
  emit projectReplaced();
}

void Workbench::apply(const Project& project) {
  project_ = project;
  touch_.setInputs(project_.design, project_.load, project_.mesh);
  emit projectChanged();
}

} // namespace palp
