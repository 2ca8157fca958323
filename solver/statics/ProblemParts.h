#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/PointProbe.h"
#include "solver/assembly/Assembler.h"
#include "solver/linear/SparseCholesky.h"

#include <condition_variable>
#include <mutex>
#include <optional>

namespace palp {

/// The tangent at rest: every solve begins with it, all loads of a batch share it.
struct InitialTangent {
  ElementTangents tangents; ///< without the stiffness, which is summed up
  ElementForces forces;     ///< zero
  SparseCholesky factor;
};

/// What a problem keeps, shared read-only with BatchSolver. What is expensive is made at its first use and kept.
struct HyperelasticProblem::Parts {
  Parts(SensorDesign d, Mesh m);

  SensorDesign design;
  Mesh mesh;
  std::shared_ptr<const Discretisation> discretisation;
  Assembler assembler;

  [[nodiscard]] std::shared_ptr<const CholeskyPlan> plan() const;
  /// Empty: stopped.
  [[nodiscard]] std::shared_ptr<const InitialTangent> initialTangent(int threads, const std::stop_token& stop) const;
  /// The same by another plan, and not kept.
  [[nodiscard]] std::shared_ptr<InitialTangent> makeTangent(std::shared_ptr<const CholeskyPlan> plan, int threads,
                                                            const std::stop_token& stop,
                                                            Products products = Products::Double) const;
  void keepInitialTangent(std::shared_ptr<const InitialTangent> tangent) const;
  /// Does not wait for a thread that makes it.
  void releaseInitialTangent() const;
  [[nodiscard]] const PointProbe& upperProbe() const;
  [[nodiscard]] const PointProbe& lowerProbe() const;

private:
  struct Making { ///< while it lives, one thread makes the tangent and others wait
    const Parts& parts;
    ~Making();
  };

  // A lock for each thing that is made at first use: a window that asks for a probe must not wait for a factorisation.
  mutable std::once_flag planOnce_, upperOnce_, lowerOnce_;
  mutable std::shared_ptr<const CholeskyPlan> plan_;
  mutable std::optional<PointProbe> upperProbe_, lowerProbe_;
  mutable std::mutex tangentGuard_; ///< of the two below; held for no longer than a pointer takes
  mutable bool making_ = false;
  mutable std::shared_ptr<const InitialTangent> tangent_;
  mutable std::condition_variable_any made_; ///< or given up
};

/// The elements' own unknowns as in LoadIncrement (unknowns x elements).
Eigen::MatrixXd elementUnknowns(const Discretisation& mesh, const LaneVector& unknowns);

} // namespace palp
