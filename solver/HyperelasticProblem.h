#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/RowColumnResistance.h"
#include "model/SensorDesign.h"
#include "model/Solution.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

namespace palp {

/// Options of Newton's method; the defaults suit every load of the paper.
struct NewtonOptions {
  double relativeTolerance = 1e-9; ///< of the residual, relative to the load's norm
  int iterationsAStep = 20;
  double smallestStep = 1e-3; ///< load fraction below which it gives up
  int threads = 0;            ///< 0: all cores; changes the time, never the result
};

/// Is called after every Newton iteration, in the calling thread; a stop request takes effect within 0.3 s.
struct NewtonObserver {
  std::function<void(const NewtonStep&)> step;
  std::stop_token stop;
};

/// The block as a nonlinear boundary value problem: mixed finite elements (pressure is an independent unknown,
/// eliminated element by element), bottom face fixed. Finds the sparsity pattern once and keeps its factorisation.
class HyperelasticProblem {
public:
  HyperelasticProblem(SensorDesign design, Mesh mesh);
  ~HyperelasticProblem();
  HyperelasticProblem(HyperelasticProblem&&) noexcept;
  HyperelasticProblem& operator=(HyperelasticProblem&&) noexcept;

  [[nodiscard]] const SensorDesign& design() const;
  [[nodiscard]] const Mesh& mesh() const;
  [[nodiscard]] int dof() const;                 ///< free displacement unknowns after elimination
  [[nodiscard]] std::string elementType() const; ///< as in the JSON: "P2+bubble/P1d", "Q1/P0"

  /// Equilibrium under the load, starting at rest. Throws DesignError if the load cannot be applied (model/LoadCase.h).
  [[nodiscard]] Solution solve(const LoadCase& load, const NewtonOptions& options = {},
                               const NewtonObserver& observer = {}) const;

  /// What the first solve computes before anything else and keeps, for callers that time it separately: the order of
  /// elimination,
  void findOrdering() const;
  /// and the factorisation at rest. Returns its size in bytes; 0 if stopped.
  [[nodiscard]] std::size_t findFactor(int threads, const std::stop_token& stop = {}) const;
  /// Frees the factorisation at rest, most of a problem's memory; the next solve computes it again.
  void forgetFactor() const;

  /// Displacements and pressure at the electrodes of both layers.
  [[nodiscard]] ElectrodeDisplacements electrodes(const LoadIncrement& state) const;
  [[nodiscard]] NodalFields fields(const LoadIncrement& state) const;

  struct Parts; ///< shared with BatchSolver
  [[nodiscard]] const Parts& parts() const { return *parts_; }

private:
  std::unique_ptr<Parts> parts_;
};

} // namespace palp
