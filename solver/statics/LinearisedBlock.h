#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/PointProbe.h"
#include "solver/assembly/Assembler.h"
#include "solver/linear/SparseCholesky.h"

#include <condition_variable>
#include <mutex>
#include <optional>

namespace palp {

/// The tangent at rest: the first tangent of every solve, and the only one of a batch.
struct InitialTangent {
  ElementTangents tangents; ///< without the stiffness, which is assembled
  ElementForces forces;     ///< zero
  SparseCholesky factor;
};

/// The discretised block with its tangent at rest: mesh, assembler, probes and factor, shared read-only by copies of a
/// HyperelasticProblem and by BatchSolver. Expensive parts are made at their first use and kept.
struct LinearisedBlock {
  LinearisedBlock(SensorDesign d, Mesh m);

  SensorDesign design;
  Mesh mesh;
  std::shared_ptr<const Discretisation> discretisation;
  Assembler assembler;

  [[nodiscard]] std::shared_ptr<const CholeskyPlan> plan() const;
  /// Null if cancelled.
  [[nodiscard]] std::shared_ptr<const InitialTangent> initialTangent(int threads, const std::stop_token& stop) const;
  /// The same by another plan, not kept.
  [[nodiscard]] std::shared_ptr<InitialTangent> makeTangent(std::shared_ptr<const CholeskyPlan> plan, int threads,
                                                            const std::stop_token& stop,
                                                            UpdatePrecision products = UpdatePrecision::Double) const;
  void keepInitialTangent(std::shared_ptr<const InitialTangent> tangent) const;
  /// Does not wait for a thread that makes it.
  void releaseInitialTangent() const;
  [[nodiscard]] const PointProbe& upperProbe() const;
  [[nodiscard]] const PointProbe& lowerProbe() const;

private:
  struct Making { ///< while it lives, one thread makes the tangent and others wait
    const LinearisedBlock& block;
    ~Making();
  };

  // A lock for each part that is made at first use: a window that needs a probe must not wait for a factorisation.
  mutable std::once_flag planOnce_, upperOnce_, lowerOnce_;
  mutable std::shared_ptr<const CholeskyPlan> plan_;
  mutable std::optional<PointProbe> upperProbe_, lowerProbe_;
  mutable std::mutex tangentGuard_; ///< of the two below; locked for a pointer's assignment only
  mutable bool making_ = false;
  mutable std::shared_ptr<const InitialTangent> tangent_;
  mutable std::condition_variable_any made_; ///< or abandoned
};

/// The elements' own unknowns as in LoadIncrement (unknowns x elements).
Eigen::MatrixXd elementUnknowns(const Discretisation& mesh, const LaneVector& unknowns);

} // namespace palp
