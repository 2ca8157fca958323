#pragma once

#include "solver/Assembler.h"
#include "solver/HyperelasticProblem.h"

namespace palp {

/// External forces and prescribed displacements of all components (3 node + direction) at full load; both grow in
/// proportion to the load fraction.
struct Loading {
  Eigen::VectorXd forces;
  Eigen::VectorXd prescribed; ///< read where the component is fixed
};

/// An equilibrium on the way.
struct EquilibriumState {
  double loadFraction = 0;
  ElementState state;
};

/// How a solve went; the texts of Solution.
struct NewtonResult {
  bool converged = false;
  bool cancelled = false;
  std::string stopReason;
  std::vector<NewtonStep> steps;
  std::vector<EquilibriumState> increments; ///< at rest first
  Eigen::VectorXd internalForces;           ///< of the last equilibrium: the reactions on fixed components
  double smallestJ = 1, largestJ = 1;       ///< of the last equilibrium
};

/// Newton's method with load stepping and line search. A load step that fails (elements inside out, a tangent that is
/// not positive definite, no convergence) is taken again with half its size.
class NewtonSolver {
public:
  NewtonSolver(const Assembler& assembler, SparseCholesky& cholesky, NewtonOptions options, NewtonObserver observer);
  [[nodiscard]] NewtonResult solve(const Loading& loading);

private:
  enum class Outcome { Converged, Inverted, Indefinite, TooManyIterations, Diverged, Cancelled };

  [[nodiscard]] Outcome step(const Loading& loading, double from, double to, ElementState& state);
  [[nodiscard]] double assemble(const Loading& loading, double fraction, const ElementState& state, bool tangent);
  [[nodiscard]] bool searchLine(const Loading& loading, double fraction, const ElementState& start,
                                const Eigen::VectorXd& du, const LaneVector& dx, double slope, ElementState& state);
  void move(const ElementState& start, double length, const Eigen::VectorXd& du, const LaneVector& dx,
            ElementState& state) const;
  [[nodiscard]] bool stopped() const { return observer_.stop.stop_requested(); }
  [[nodiscard]] std::string reason(Outcome outcome, double reached, double tried) const;

  const Assembler& assembler_;
  SparseCholesky& cholesky_;
  NewtonOptions options_;
  NewtonObserver observer_;
  ElementArrays arrays_;
  Eigen::VectorXd internal_; ///< forces of all components of the state assembled last
  Eigen::VectorXd residual_; ///< free components
  double scale_ = 1;         ///< norm that residuals are measured by
  std::vector<NewtonStep> steps_;
};

} // namespace palp
