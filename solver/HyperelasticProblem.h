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
#include <vector>

namespace palp {

struct LinearisedBlock;

/// Settings of Newton's method; the defaults are suitable for the loads of the paper.
struct NewtonOptions {
  double relativeTolerance = 1e-9; ///< of the residual, against the load's norm
  int iterationsAStep = 20;
  double smallestStep = 1e-3; ///< of the load fraction; a smaller one ends the solve
  int threads = 0;            ///< 0: all cores; changes the time, never the result
  /// Frees the tangent at rest as soon as a later tangent replaces it: this takes a third less peak memory, but the
  /// next solve has to compute it again. The result is the same.
  bool oneTangent = false;
};

/// `step` is called after every Newton iteration, in the calling thread; `stop` ends the solve within 0.3 s.
struct NewtonObserver {
  std::function<void(const NewtonStep&)> step;
  std::stop_token stop;
};

/// Returns whether two designs are equal except for the resistance and pressure laws, so that they deform equally.
bool sameButForLaw(const SensorDesign& a, const SensorDesign& b);

/// The block as a nonlinear boundary value problem: bottom face fixed, mixed finite elements with independent pressure
/// unknowns, which are eliminated element by element. Keeps the sparsity pattern and the factorisation at rest for all
/// solves. Copies are cheap, because they share both. Moving copies, so that a moved-from problem remains valid.
class HyperelasticProblem {
public:
  HyperelasticProblem(SensorDesign design, Mesh mesh);
  HyperelasticProblem(const HyperelasticProblem&) = default;
  HyperelasticProblem& operator=(const HyperelasticProblem&) = default;

  [[nodiscard]] const SensorDesign& design() const { return *design_; }
  /// Returns the same block with the laws of `design`, which do not affect the deformation; all else is shared.
  [[nodiscard]] HyperelasticProblem withLawOf(const SensorDesign& design) const;
  [[nodiscard]] const Mesh& mesh() const;
  [[nodiscard]] int dof() const;                 ///< free displacement unknowns after elimination
  [[nodiscard]] std::string elementType() const; ///< as in the JSON: "P2+bubble/P1d", "Q1/P0"

  /// Computes the equilibrium under the load, starting at rest. Throws DesignError for an invalid load
  /// (model/LoadCase.h).
  [[nodiscard]] Solution solve(const LoadCase& load, const NewtonOptions& options = {},
                               const NewtonObserver& observer = {}) const;
  /// Computes the equilibria under the loads of a path, each starting at the previous one, because friction is
  /// path-dependent. Returns one solution per load, up to the first that fails. Throws DesignError for an invalid path
  /// (model/LoadCase.h).
  [[nodiscard]] std::vector<Solution> solvePath(const std::vector<LoadCase>& path, const NewtonOptions& options = {},
                                                const NewtonObserver& observer = {}) const;

  /// Finds the order of elimination. The first solve calls this and findFactor, and keeps their results; both are
  /// public so that they can be measured.
  void findOrdering() const;
  /// Factorises the tangent at rest. Returns the size of the factor in bytes, 0 if cancelled.
  [[nodiscard]] std::size_t findFactor(int threads, const std::stop_token& stop = {}) const;
  /// Frees the factorisation at rest, most of the memory of a problem; the next solve computes it again. It does not
  /// change results, so it is const like `solve`. Does not wait for a solve in progress.
  void releaseFactor() const;

  /// Returns displacements and pressure at the electrodes of both layers.
  [[nodiscard]] ElectrodeDisplacements electrodes(const LoadIncrement& state) const;
  [[nodiscard]] NodalFields fields(const LoadIncrement& state) const;

  /// The discretised block with its tangent at rest, shared by copies and by BatchSolver (statics/LinearisedBlock.h).
  [[nodiscard]] const LinearisedBlock& block() const { return *block_; }

private:
  std::shared_ptr<const LinearisedBlock> block_;
  std::shared_ptr<const SensorDesign> design_; ///< with its own laws; all else as in block_
};

} // namespace palp
