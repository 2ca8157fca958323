#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/assembly/Assembler.h"
#include "solver/statics/StepOutcome.h"

#include <functional>
#include <memory>

namespace palp {

struct InitialTangent;

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
  std::string stopReason; ///< converged: empty, or that rounding allows no smaller residual than was reached
  std::vector<NewtonStep> steps;
  std::vector<EquilibriumState> increments; ///< at rest first
  Eigen::VectorXd internalForces;           ///< of the last equilibrium: the reactions on fixed components
  double smallestJ = 1, largestJ = 1;       ///< of the last equilibrium
};

/// The tangent at rest, lent to a solve: kept throughout, or released while another replaces it and computed again.
class LentTangent {
public:
  using Find = std::function<std::shared_ptr<const InitialTangent>()>;
  LentTangent() = default;
  /// Without `findAgain` it is kept throughout.
  LentTangent(std::shared_ptr<const InitialTangent> held, Find findAgain)
      : held_(std::move(held)), findAgain_(std::move(findAgain)) {}

  /// Whether there is one, found again if need be.
  explicit operator bool() {
    if (!held_ && findAgain_) held_ = findAgain_();
    return held_ != nullptr;
  }
  const InitialTangent* operator->() const { return held_.get(); }
  void letGo() {
    if (findAgain_) held_.reset();
  }

private:
  std::shared_ptr<const InitialTangent> held_;
  Find findAgain_;
};

/// Newton's method with load stepping and line search. A load step that fails (elements inside out, a tangent that is
/// not positive definite, no convergence) is taken again with half its size. A factorisation is kept for the next
/// iteration where that is sure to end it.
class NewtonSolver {
public:
  NewtonSolver(const Assembler& assembler, SparseCholesky& cholesky, NewtonOptions options, NewtonObserver observer);
  /// Takes the tangent at rest from here instead of assembling it again.
  NewtonSolver& startingWith(LentTangent rest);
  [[nodiscard]] NewtonResult solve(const Loading& loading);

private:
  using Outcome = StepOutcome;
  /// A Newton direction and where it starts.
  struct Direction {
    ElementState start;
    Eigen::VectorXd du; ///< all components
    LaneVector dx;
    double residual = 0; ///< relative, at the start
    double slope = 0;    ///< the residual's work along du at the start
    double length = 1;   ///< share of it that is taken
  };

  [[nodiscard]] Outcome step(const Loading& loading, double from, double to, ElementState& state);
  [[nodiscard]] Outcome startTangent(const Loading& loading, double from, double to, const ElementState& state);
  [[nodiscard]] Outcome movePrescribed(const Loading& loading, double to, const Eigen::VectorXd& motion,
                                       ElementState& state);
  [[nodiscard]] Outcome newTangent(const Loading& loading, double fraction, const ElementState& state,
                                   const Eigen::VectorXd* prescribed = nullptr);
  [[nodiscard]] Direction direction(const ElementState& state, const Eigen::VectorXd& prescribed) const;
  static void move(const Direction& direction, ElementState& state);
  [[nodiscard]] bool overshot(const Direction& direction) const;
  [[nodiscard]] Outcome searchLine(const Loading& loading, double fraction, Direction& direction, ElementState& state);
  [[nodiscard]] Outcome definiteTangent(const Loading& loading, double fraction, Direction& last, ElementState& state);
  [[nodiscard]] bool factorWillDo(double previous, bool ofTheStart) const;
  void evaluate(const Loading& loading, double fraction, const ElementState& state);
  void setResidual(const Loading& loading, double fraction);
  void record(double fraction, int iteration);
  [[nodiscard]] bool stopped() const { return observer_.stop.stop_requested(); }

  const Assembler& assembler_;
  SparseCholesky& cholesky_;
  NewtonOptions options_;
  NewtonObserver observer_;
  LentTangent rest_;
  ElementTangents ownTangents_;
  const ElementTangents* tangents_ = nullptr; ///< of the factorisation in use
  const SparseCholesky* factor_ = nullptr;
  ElementForces forces_;
  Eigen::VectorXd internal_; ///< raw forces of all components of the state evaluated last
  Eigen::VectorXd residual_; ///< free components, condensed
  double relative_ = 0;      ///< norm of the nodes' and the elements' own residuals over scale_
  double scale_ = 1;
  double smallMove_mm_ = 0; ///< to which the rubber answers linearly
  std::vector<NewtonStep> steps_;
};

} // namespace palp
