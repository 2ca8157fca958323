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

/// How Newton's method goes; the defaults serve every load of the paper.
struct NewtonOptions {
  double relativeTolerance = 1e-9; ///< of the residual, against the load's norm
  int iterationsAStep = 20;
  double smallestStep = 1e-3; ///< load fraction below which it gives up
  int threads = 0;            ///< 0: all cores; changes the time, never the result
  /// Lets the tangent at rest go when one on the way takes its place: a third less memory at the peak, but the next
  /// solve has to find it again. The same result.
  bool oneTangent = false;
};

/// `step` is called after every Newton iteration, in the calling thread; `stop` ends the solve within 0.3 s.
struct NewtonObserver {
  std::function<void(const NewtonStep&)> step;
  std::stop_token stop;
};

/// The block as a nonlinear boundary value problem: mixed finite elements (pressure an unknown of its own, eliminated
/// element by element), bottom face fixed. Finds the pattern once and keeps its factorisation. Copies share all of it
/// and cost nothing; there is no moving, so that none is ever left empty.
class HyperelasticProblem {
public:
  HyperelasticProblem(SensorDesign design, Mesh mesh);
  HyperelasticProblem(const HyperelasticProblem&) = default;
  HyperelasticProblem& operator=(const HyperelasticProblem&) = default;

  [[nodiscard]] const SensorDesign& design() const;
  [[nodiscard]] const Mesh& mesh() const;
  [[nodiscard]] int dof() const;                 ///< free displacement unknowns after elimination
  [[nodiscard]] std::string elementType() const; ///< as in the JSON: "P2+bubble/P1d", "Q1/P0"

  /// Equilibrium under the load from rest. Throws DesignError where the load cannot act (model/LoadCase.h).
  [[nodiscard]] Solution solve(const LoadCase& load, const NewtonOptions& options = {},
                               const NewtonObserver& observer = {}) const;

  /// What the first solve finds before anything else and keeps, for those who time it apart: the order of elimination,
  void findOrdering() const;
  /// and the factorisation at rest. Returns its bytes; 0: stopped.
  [[nodiscard]] std::size_t findFactor(int threads, const std::stop_token& stop = {}) const;
  /// Gives back the memory of the factorisation at rest, most of what a problem holds; the next solve finds it anew.
  /// Changes no answer, and so is const as the solve that keeps it is. Does not wait for a solve that is going on.
  void releaseFactor() const;

  /// Displacements and pressure at the electrodes of both layers.
  [[nodiscard]] ElectrodeDisplacements electrodes(const LoadIncrement& state) const;
  [[nodiscard]] NodalFields fields(const LoadIncrement& state) const;

  struct Parts; ///< what copies and BatchSolver share
  [[nodiscard]] const Parts& parts() const { return *parts_; }

private:
  std::shared_ptr<const Parts> parts_;
};

} // namespace palp
