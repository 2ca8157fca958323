#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/jobs/LoadPath.h"
#include "app/gui/project/Project.h"
#include "app/study/touch/Touch.h"

#include <QTimer>

#include <memory>
#include <mutex>
#include <optional>

namespace palp {

/// What the background job reports of Newton's method while it runs.
class NewtonTrace {
public:
  void add(const NewtonStep& step);
  [[nodiscard]] std::vector<NewtonStep> steps() const;

private:
  mutable std::mutex mutex_;
  std::vector<NewtonStep> steps_;
};

/// The chain of one touch behind the window: advanced in the background no farther than the visible scene needs, on
/// copies; a result is taken only while its inputs still hold, and until then the last good one is shown.
class TouchSession : public QObject {
  Q_OBJECT

public:
  explicit TouchSession(QObject* parent = nullptr);

  /// New inputs; what still holds is kept.
  /// `path`: what the load's indenters follow after it, as in Touch.
  void setInputs(const SensorDesign& design, const LoadCase& load, const MeshOptions& mesh,
                 const std::vector<LoadCase>& path = {});
  /// The furthest stage of the visible scene.
  void need(Stage stage);
  /// Computes what is needed again after a cancel.
  void resume();
  void cancel() { runner_.cancel(); }

  /// The last good result; its design and load are those it was computed from.
  [[nodiscard]] const Touch& touch() const { return shown_; }
  /// Design and load can be computed; where not, the panels say why.
  [[nodiscard]] bool computable() const;
  /// Something that the visible scene needs has not been computed.
  [[nodiscard]] bool missing() const { return wanted_.reached() < target(); }
  /// False while inputs are newer than what is shown.
  [[nodiscard]] bool upToDate() const { return shownRevision_ == revision_; }
  /// Fields of the place of the load path that is shown; null before the first solution.
  [[nodiscard]] const NodalFields* fields() const { return fields_.get(); }
  [[nodiscard]] const ElectrodeDisplacements* electrodes() const { return electrodes_.get(); }
  /// What the load's indenters do at that place; empty before the first solution.
  [[nodiscard]] const std::vector<IndenterState>& indenters() const { return indenters_; }
  /// At the end of the load path, for scales that hold on all of it.
  [[nodiscard]] const NodalFields* endFields() const { return endFields_.get(); }
  /// The place that is shown on the way from rest to the load, in percent of it, and the last one that was reached;
  /// above 100 on the steps of its path, a hundred each.
  [[nodiscard]] int place() const { return place_; }
  [[nodiscard]] int lastPlace() const;
  [[nodiscard]] double loadFraction() const;
  /// Residuals of the solve that runs, else of the one that is shown.
  [[nodiscard]] std::vector<NewtonStep> newton() const;
  [[nodiscard]] const StageLog& stages() const { return stages_; }
  [[nodiscard]] JobRunner& runner() { return runner_; }

  /// Shows another place of the load path, linear between the equilibria that were computed; not while a solve runs.
  void showPlace(int percent);
  /// The place that will be shown when its fields are there.
  [[nodiscard]] int scrubbingTo() const { return scrubbing_.value_or(place_); }
  /// Estimates the discretisation error of what is shown; the answer comes with errorEstimated().
  void estimateError();
  /// Releases the memory that only another solve needs; called when nothing was computed for a while.
  void rest();

signals:
  /// Another mesh, solution or place of the load path is shown.
  void changed(bool meshChanged);
  void newtonStepped();
  /// Not a number where there is no estimate; `method` then has the reason.
  void errorEstimated(double relative, const QString& method);

private:
  void run();
  /// The inputs are again those of what is shown, as after an undo: it holds.
  [[nodiscard]] bool takeShown();
  /// Another law of the resistances alone: what is shown stays, read by it.
  [[nodiscard]] bool takeLaw();
  /// What is needed, as far as the law of the design lets a touch be followed.
  [[nodiscard]] Stage target() const;
  /// The job that runs computes the inputs as they are now.
  [[nodiscard]] bool computing() const;
  void showState(int percent);
  void take(const Touch& touch, std::shared_ptr<const NodalFields> fields, quint64 revision);

  JobRunner runner_;
  QTimer idle_;
  Touch wanted_; ///< inputs as they are now, with the results that still hold
  Touch shown_;
  Stage need_ = Stage::Design;
  quint64 revision_ = 1;
  quint64 shownRevision_ = 0;
  quint64 computed_ = 0; ///< revision that the runner's last job computes; 0: it computes no touch
  std::shared_ptr<const NodalFields> fields_;
  std::shared_ptr<const ElectrodeDisplacements> electrodes_;
  std::vector<IndenterState> indenters_;
  std::shared_ptr<NewtonTrace> trace_;
  std::shared_ptr<const NodalFields> endFields_;
  std::shared_ptr<const std::vector<LoadPathState>> path_; ///< null until it is first scrubbed through
  int place_ = -1;
  std::optional<int> scrubbing_; ///< requested and not available yet
  StageLog stages_;
};

} // namespace palp
