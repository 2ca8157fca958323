#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "io/Decoder.h"
#include "model/SampleSet.h"
#include "solver/SensorMesh.h"

#include <QObject>

#include <deque>
#include <memory>

namespace palp {

/// What the simulated board needs of a design that is not the paper's: solved samples, and a network for them. Solved
/// on request; the last few designs are kept.
class SimulatedDesign : public QObject {
  Q_OBJECT

public:
  struct Solved {
    SensorDesign design;
    bool moving = false; ///< touches of an indenter anywhere, in place of loads on areas
    std::shared_ptr<const SampleSet> samples;
    Decoder decoder;
  };

  explicit SimulatedDesign(QObject* parent = nullptr);

  void solve(const SensorDesign& design, const MeshOptions& mesh, bool moving);
  /// Null before it was solved.
  [[nodiscard]] const Solved* of(const SensorDesign& design, bool moving) const;
  [[nodiscard]] JobRunner& runner() { return runner_; }

signals:
  void solved();

private:
  std::deque<std::shared_ptr<const Solved>> kept_;
  JobRunner runner_;
};

} // namespace palp
