#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/jobs/TouchResistances.h"
#include "app/study/touch/Touch.h"

#include <memory>
#include <optional>
#include <vector>

namespace palp {

class ConductionField;

/// The conduction field of the touch that is shown, in the background and only while a scene shows it. Every read-out
/// is read out of the same network of wires.
class FieldTouch : public QObject {
  Q_OBJECT

public:
  explicit FieldTouch(QObject* parent = nullptr);
  ~FieldTouch() override;

  /// A scene shows this touch at this share of its load: computed unless that was done, or runs.
  void want(const Touch& touch, double loadFraction);
  /// By the touch's read-out; empty before it is there, and where another touch was wanted last.
  [[nodiscard]] std::optional<TouchResistances> of(const Touch& touch, double loadFraction) const;
  /// Why there is none; empty while it is computed.
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// What was stopped or failed is computed where it is wanted again.
  void retry();
  /// Nothing is wanted any more.
  void forget();
  /// Gives back what only another load on the same block needs.
  void rest() { kept_.reset(); }
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void changed();

private:
  /// What is computed, by all read-outs.
  struct Inputs {
    SensorDesign design;
    LoadCase load;
    MeshOptions mesh;
    double loadFraction = 1;
    bool operator==(const Inputs&) const = default;
  };
  /// The field of a problem, with what it has found at rest; the touch keeps the problem.
  struct Kept {
    Touch touch;
    std::shared_ptr<const ConductionField> field;
  };
  [[nodiscard]] static Inputs inputsOf(const Touch& touch, double loadFraction);

  JobRunner runner_;
  std::optional<Inputs> wanted_;
  std::vector<TouchResistances> read_; ///< in the order of Readout
  std::optional<Kept> kept_;
  QString problem_;
};

} // namespace palp
