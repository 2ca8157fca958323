#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/jobs/TouchResistances.h"
#include "app/study/touch/Touch.h"

#include <QTimer>

#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace palp {

class ConductionField;

/// The resistances of one state by the conduction field, for all read-outs.
struct FieldFound {
  TerminalNetwork network;
  std::vector<TouchResistances> read; ///< in the order of Readout
};

/// The field of a touch at a share of its load; `field` is that of its problem. Null: stopped. Throws DesignError as
/// ConductionField does.
std::shared_ptr<const FieldFound> fieldFound(const Touch& touch, double loadFraction, const ConductionField& field,
                                             const std::stop_token& stop);
/// By the touch's read-out; for a job. Empty: stopped.
std::optional<TouchResistances> fieldResistances(const Touch& touch, double loadFraction, const std::stop_token& stop);
/// The state at a share of the load, linear between the equilibria that were computed, as the scenes draw the load
/// path.
LoadIncrement stateAt(const Solution& solution, double fraction);

/// The conduction field of a touch, in the background and only while a scene shows it. Every read-out is read out of
/// the same network of wires; the last few states are kept.
class FieldTouch : public QObject {
  Q_OBJECT

public:
  explicit FieldTouch(QObject* parent = nullptr);
  ~FieldTouch() override;

  /// A scene shows this touch at this share of its load: computed unless that was done, or runs.
  void want(const Touch& touch, double loadFraction);
  /// By the touch's read-out; empty before it is there.
  [[nodiscard]] std::optional<TouchResistances> of(const Touch& touch, double loadFraction) const;
  /// By all read-outs; null before it is there.
  [[nodiscard]] std::shared_ptr<const FieldFound> found(const Touch& touch, double loadFraction) const;
  /// The field behind it, with its results at rest; null where it was released.
  [[nodiscard]] std::shared_ptr<const ConductionField> field(const Touch& touch) const;
  /// Why there is none; empty while it is computed.
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// What was cancelled or failed is computed at the next request.
  void retry();
  /// Nothing is wanted any more: what runs is stopped.
  void leave();
  [[nodiscard]] JobRunner& runner() { return runner_; }
  /// How many states were computed.
  [[nodiscard]] int runs() const { return runs_; }

signals:
  void changed();

private:
  /// What is computed, by all read-outs.
  struct Inputs {
    SensorDesign design;
    LoadCase load;
    std::vector<LoadCase> path;
    MeshOptions mesh;
    double loadFraction = 1;
    bool operator==(const Inputs&) const = default;
  };
  /// The field of a problem; the touch keeps the problem.
  struct Kept {
    Touch touch;
    std::shared_ptr<const ConductionField> field;
  };
  struct Known {
    Inputs inputs;
    std::shared_ptr<const FieldFound> found;
  };
  [[nodiscard]] static Inputs inputsOf(const Touch& touch, double loadFraction);
  [[nodiscard]] std::shared_ptr<const FieldFound> find(const Inputs& inputs) const;

  JobRunner runner_;
  QTimer idle_; ///< then memory that only another load on the same block needs is released
  std::optional<Inputs> wanted_;
  std::deque<Known> known_; ///< the newest first
  std::optional<Kept> kept_;
  QString problem_;
  int runs_ = 0;
};

} // namespace palp
