#pragma once

#include "app/gui/jobs/FieldTouch.h"
#include "app/gui/jobs/ReferenceTouch.h"
#include "app/gui/jobs/TouchSession.h"
#include "app/gui/project/Leaving.h"
#include "app/gui/project/Project.h"

#include <QDateTime>
#include <QObject>
#include <QUndoStack>

#include <functional>
#include <optional>
#include <vector>

namespace palp {

/// A design that there was in the history of the project.
struct EarlierDesign {
  SensorDesign design;
  QString change;      ///< that led away from it, as the history names it
  QDateTime when;      ///< that was
  bool undone = false; ///< it came after the present one
};

/// The project that all scenes share, the file it is kept in, its undo history, and what is computed from it.
class Workbench : public QObject {
  Q_OBJECT

public:
  explicit Workbench(const Project& project, QObject* parent = nullptr);

  [[nodiscard]] const Project& project() const { return project_; }
  /// A change. How things are shown and the live settings just change; all else becomes an entry of the history that
  /// can be undone, named after what changed with its values, or `what` where that would be too long. Edits of the
  /// same `what` in a row are one entry until closeEntry(). Asks before something ends by it that cannot be had again;
  /// where the user refuses, nothing changes.
  void edit(const QString& what, const Project& next);
  /// The same with a function that changes the project.
  void edit(const QString& what, const std::function<void(Project&)>& change);
  /// The next edit begins an entry of its own.
  void closeEntry() { entryOpen_ = false; }
  /// Another project in place of this one, kept in `file` (empty: in none yet), which holds it. Its history begins
  /// here.
  void replace(const Project& project, const QString& file = {});
  /// The same with a project that is in no file as it is: it is unsaved from the first.
  void replaceUnsaved(const Project& project, const QString& file);

  /// The project's file; empty before it is saved for the first time.
  [[nodiscard]] const QString& file() const { return file_; }
  /// What was set that the file does not hold. How things are shown does not count, nor which board or recording Live
  /// plays and what the simulated one does.
  enum class Modified { Nothing, LiveSettings, Calibration, Project };
  [[nodiscard]] Modified modification() const;
  [[nodiscard]] bool modified() const { return modification() != Modified::Nothing; }
  /// This file now contains the project as it is.
  void saved(const QString& file);

  /// What every way of leaving asks.
  [[nodiscard]] LossQuestion& lossQuestion() { return lossQuestion_; }

  /// Every panel shows the project again, instead of what was typed and could not be applied.
  void showAgain() { emit projectChanged(); }

  /// The scene in which edits are made from now on: undoing them leads there.
  void setPlace(const QString& scene) { place_ = scene; }

  [[nodiscard]] TouchSession& touch() { return touch_; }
  [[nodiscard]] ReferenceTouch& kept() { return kept_; }
  /// There is another solution to compare the touch with: of the reference design, or its own under uniform load.
  [[nodiscard]] bool comparable() const;
  /// That solution, for the touch that is shown; null before it is computed and where there is none.
  [[nodiscard]] std::shared_ptr<const ReferencePath> referencePath() const;
  /// A scene shows it: it is computed.
  void needReference();
  /// Under the law of the field: of the touch that is shown, and of the reference design.
  [[nodiscard]] FieldTouch& field() { return field_; }
  [[nodiscard]] FieldTouch& referenceField() { return referenceField_; }
  /// By the law of the touch that is shown, at the place of the load path that is shown; empty before they are there.
  [[nodiscard]] std::optional<TouchResistances> resistances() const;
  [[nodiscard]] std::optional<TouchResistances> referenceResistances() const;
  /// At the end of the load path, for scales that hold on all of it; under the field as far as they were computed.
  [[nodiscard]] std::optional<TouchResistances> resistancesAtEnd() const;
  /// A scene shows them: the field is computed where the law needs it.
  void needResistances();
  void needReferenceResistances();
  [[nodiscard]] QUndoStack& history() { return history_; }
  /// The designs of this project that are not the present one, each once: those before it, the latest first, then those
  /// that were undone.
  [[nodiscard]] std::vector<EarlierDesign> earlierDesigns() const;

signals:
  void projectChanged();
  /// After projectChanged(): it is another project, not an edit of this one.
  void projectReplaced();
  /// Its name, or whether it holds everything.
  void fileChanged();
  /// An edit that was made in this scene was undone or done again; `before` is the project as it was before that.
  void wentBack(const QString& scene, const QString& sentence, const palp::Project& before);

private:
  friend class ProjectEdit;
  void begin(const Project& project, const QString& file, std::optional<Project> saved);
  void apply(const Project& project);

  Project project_;
  QString file_;
  std::optional<Project> saved_; ///< as the file holds it, or as it began; none: it was never the same
  LossQuestion lossQuestion_;
  QUndoStack history_;
  bool entryOpen_ = false;
  QString place_;
  TouchSession touch_;
  ReferenceTouch kept_;
  FieldTouch field_, referenceField_;
};

} // namespace palp
