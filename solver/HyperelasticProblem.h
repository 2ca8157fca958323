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

/// Settings of Newton's method; the defaults serve every load of the paper.
struct NewtonOptions {
  double relativeTolerance = 1e-9; ///< of the residual, against the load's norm
  int iterationsAStep = 20;
  double smallestStep = 1e-3; ///< of the load fraction; a smaller one ends the solve
  int threads = 0;            ///< 0: all cores; changes the time, never the result
  /// Releases the tangent at rest when a later one replaces it: a third less peak memory, but the next solve has to
  /// compute it again. The result is the same.
  bool oneTangent = false;
};

/// `step` is called after every Newton iteration, in the calling thread; `stop` ends the solve within 0.3 s.
struct NewtonObserver {
  std::function<void(const NewtonStep&)> step;
  std::stop_token stop;
};

/// The same block with the same wires and loads: one deformation, whatever resistances are read of it.
bool sameButForLaw(const SensorDesign& a, const SensorDesign& b);

/// The block as a nonlinear boundary value problem: bottom face fixed, mixed finite elements whose pressures are
/// unknowns of their own, eliminated element by element. Keeps the sparsity pattern and the factorisation at rest for
/// all solves. Copies share them and cost nothing; moving copies, so that no problem is ever left empty.
class HyperelasticProblem {
public:
  HyperelasticProblem(SensorDesign design, Mesh mesh);
  HyperelasticProblem(const HyperelasticProblem&) = default;
  HyperelasticProblem& operator=(const HyperelasticProblem&) = default;

  [[nodiscard]] const SensorDesign& design() const { return *design_; }
  /// The same block with another resistance law, which does not affect the rubber: all else is shared.
  [[nodiscard]] HyperelasticProblem withLawOf(const SensorDesign& design) const;
  [[nodiscard]] const Mesh& mesh() const;
  [[nodiscard]] int dof() const;                 ///< free displacement unknowns after elimination
  [[nodiscard]] std::string elementType() const; ///< as in the JSON: "P2+bubble/P1d", "Q1/P0"

  /// Equilibrium under the load from rest. Throws DesignError where the load cannot act (model/LoadCase.h).
  [[nodiscard]] Solution solve(const LoadCase& load, const NewtonOptions& options = {},
                               const NewtonObserver& observer = {}) const;
  /// Equilibria under the loads of a path, each from where the one before has ended: friction is path-dependent.
  /// Returns one solution per load, up to the first that fails. Throws DesignError for an invalid path
  /// (model/LoadCase.h).
  [[nodiscard]] std::vector<Solution> solvePath(const std::vector<LoadCase>& path, const NewtonOptions& options = {},
                                                const NewtonObserver& observer = {}) const;

  /// The first solve starts with these two and keeps their results; public for measurements.
  /// Finds the order of elimination.
  void findOrdering() const;
  /// The factorisation of the tangent at rest. Returns its size in bytes, 0 if stopped.
  [[nodiscard]] std::size_t findFactor(int threads, const std::stop_token& stop = {}) const;
  /// Frees the factorisation at rest, most of the memory of a problem; the next solve finds it again. It changes no
  /// answer, so it is const as `solve` is. Does not wait for a solve in progress.
  void releaseFactor() const;

  /// Displacements and pressure at the electrodes of both layers.
  [[nodiscard]] ElectrodeDisplacements electrodes(const LoadIncrement& state) const;
  [[nodiscard]] NodalFields fields(const LoadIncrement& state) const;

  /// The discretised block with its tangent at rest, shared by copies and by BatchSolver (statics/LinearisedBlock.h).
  [[nodiscard]] const LinearisedBlock& block() const { return *block_; }

private:
  std::shared_ptr<const LinearisedBlock> block_;
  std::shared_ptr<const SensorDesign> design_; ///< with its law; all else as in the block
};

} // namespace palp
