#pragma once

#include "app/gui/jobs/TouchSession.h"
#include "app/gui/project/Project.h"

#include <QObject>
#include <QUndoStack>

namespace palp {

/// The project that all scenes share, its undo history, and what is computed from it.
class Workbench : public QObject {
  Q_OBJECT

public:
  explicit Workbench(const Project& project, QObject* parent = nullptr);

  [[nodiscard]] const Project& project() const { return project_; }
  /// An edit that can be undone; `what` stands in the history, and edits of the same kind in a row become one.
  void edit(const QString& what, const Project& next);
  /// Another project in place of this one; the history begins anew.
  void replace(const Project& project);

  [[nodiscard]] TouchSession& touch() { return touch_; }
  [[nodiscard]] QUndoStack& history() { return history_; }

signals:
  void projectChanged();
  /// After projectChanged(): it is another project, not an edit of this one.
  void projectReplaced();

private:
  friend class ProjectEdit;
  void apply(const Project& project);

  Project project_;
  QUndoStack history_;
  TouchSession touch_;
};

} // namespace palp
