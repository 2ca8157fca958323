#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/PointProbe.h"
#include "solver/assembly/Assembler.h"
#include "solver/linear/SparseCholesky.h"

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
  void forgetInitialTangent() const;
  [[nodiscard]] const PointProbe& upperProbe() const;
  [[nodiscard]] const PointProbe& lowerProbe() const;

private:
  mutable std::mutex mutex_; ///< guards what is made at first use
  mutable std::shared_ptr<const CholeskyPlan> plan_;
  mutable std::shared_ptr<const InitialTangent> rest_;
  mutable std::optional<PointProbe> upperProbe_, lowerProbe_;
};

/// The elements' own unknowns as in LoadIncrement (unknowns x elements).
Eigen::MatrixXd elementUnknowns(const Discretisation& mesh, const LaneVector& unknowns);

} // namespace palp
