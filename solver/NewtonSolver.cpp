#include "solver/NewtonSolver.h"

#include "model/Text.h"

#include <cmath>

namespace palp {

namespace {

constexpr double growthAfterSuccess = 1.5;
constexpr double hopelessResidual = 1e8;
constexpr double acceptedSlope = 0.9; // of the residual's work along the step, against its start
constexpr int lineSearchTrials = 6;

} // namespace

NewtonSolver::NewtonSolver(const Assembler& assembler, SparseCholesky& cholesky, NewtonOptions options,
                           NewtonObserver observer)
    : assembler_(assembler), cholesky_(cholesky), options_(options), observer_(std::move(observer)) {}

NewtonResult NewtonSolver::solve(const Loading& loading) {
  const Discretisation& mesh = assembler_.discretisation();
  NewtonResult result;
  result.increments.push_back({0, mesh.atRest()});
  result.internalForces = Eigen::VectorXd::Zero(loading.forces.size());
  const double load = mesh.freePart(loading.forces).norm();
  scale_ = load > 0 ? load : 1;
  double fraction = 0, size = 1;
  while (fraction < 1) {
    const double target = std::min(1.0, fraction + size);
    ElementState state = result.increments.back().state;
    const Outcome outcome = step(loading, fraction, target, state);
    if (outcome == Outcome::Converged) {
      fraction = target;
      result.increments.push_back({fraction, std::move(state)});
      result.internalForces = internal_;
      result.smallestJ = arrays_.smallestJ;
      result.largestJ = arrays_.largestJ;
      size *= growthAfterSuccess;
      continue;
    }
    size = (target - fraction) / 2;
    if (outcome == Outcome::Cancelled || size < options_.smallestStep) {
      result.cancelled = outcome == Outcome::Cancelled;
      result.stopReason = reason(outcome, fraction, target);
      break;
    }
  }
  result.converged = fraction >= 1;
  result.steps = std::move(steps_);
  return result;
}

/// Residual (in residual_) and its relative norm.
double NewtonSolver::assemble(const Loading& loading, double fraction, const ElementState& state, bool tangent) {
  if (tangent) {
    assembler_.tangent(state, arrays_, options_.threads, observer_.stop);
  } else {
    assembler_.residual(state, arrays_, options_.threads);
  }
  internal_ = assembler_.forces(arrays_, options_.threads);
  const Discretisation& mesh = assembler_.discretisation();
  residual_ = fraction * mesh.freePart(loading.forces) - mesh.freePart(internal_);
  return residual_.norm() / scale_;
}

void NewtonSolver::move(const ElementState& start, double length, const Eigen::VectorXd& du, const LaneVector& dx,
                        ElementState& state) const {
  state.displacements = start.displacements + length * du;
  for (std::size_t i = 0; i < dx.size(); ++i) state.unknowns[i] = start.unknowns[i] + length * dx[i];
}

/// Shortens a step that turned elements inside out or overshot: false where no length helps.
bool NewtonSolver::searchLine(const Loading& loading, double fraction, const ElementState& start,
                              const Eigen::VectorXd& du, const LaneVector& dx, double slope, ElementState& state) {
  const Eigen::VectorXd direction = assembler_.discretisation().freePart(du);
  double length = 1;
  for (int trial = 0; trial < lineSearchTrials && !stopped(); ++trial) {
    length /= 2;
    move(start, length, du, dx, state);
    static_cast<void>(assemble(loading, fraction, state, false));
    if (arrays_.smallestJ > 0 && std::abs(residual_.dot(direction)) <= acceptedSlope * std::abs(slope)) return true;
  }
  return false;
}

NewtonSolver::Outcome NewtonSolver::step(const Loading& loading, double from, double to, ElementState& state) {
  const Discretisation& mesh = assembler_.discretisation();
  Eigen::VectorXd prescribed = (to - from) * (loading.prescribed - mesh.withZeros(mesh.freePart(loading.prescribed)));
  const bool moves = prescribed.cwiseAbs().maxCoeff() > 0;
  ElementState start;
  Eigen::VectorXd du, direction;
  LaneVector dx;
  double slope = 0;
  for (int iteration = 0; iteration <= options_.iterationsAStep; ++iteration) {
    if (stopped()) return Outcome::Cancelled;
    double relative = assemble(loading, to, state, true);
    if (stopped()) return Outcome::Cancelled;
    const bool bad = iteration > 0 && !(moves && iteration == 1) &&
                     (arrays_.smallestJ <= 0 || !std::isfinite(relative) ||
                      (relative > 1 && std::abs(residual_.dot(direction)) > acceptedSlope * std::abs(slope)));
    if (bad) {
      if (!searchLine(loading, to, start, du, dx, slope, state))
        return stopped() ? Outcome::Cancelled : arrays_.smallestJ <= 0 ? Outcome::Inverted : Outcome::Diverged;
      relative = assemble(loading, to, state, true);
      if (stopped()) return Outcome::Cancelled;
    }
    if (iteration == 0 && moves) {
      residual_ -= mesh.freePart(assembler_.stiffnessTimes(arrays_, prescribed));
      scale_ = std::max(mesh.freePart(loading.forces).norm(), residual_.norm());
      relative = residual_.norm() / scale_;
    }
    steps_.push_back({to, iteration, relative});
    if (observer_.step) observer_.step(steps_.back());
    if (!std::isfinite(relative) || relative > hopelessResidual)
      return arrays_.smallestJ <= 0 ? Outcome::Inverted : Outcome::Diverged;
    if (iteration > 0 && relative < options_.relativeTolerance) return Outcome::Converged;
    if (iteration == options_.iterationsAStep) break;
    if (!cholesky_.factorise(assembler_.matrix(arrays_, options_.threads))) return Outcome::Indefinite;
    if (stopped()) return Outcome::Cancelled;
    direction = residual_;
    cholesky_.solve(direction);
    slope = residual_.dot(direction);
    du = mesh.withZeros(direction);
    if (iteration == 0) du += prescribed;
    dx = assembler_.recover(arrays_, du, options_.threads);
    start = state;
    move(start, 1, du, dx, state);
  }
  return Outcome::TooManyIterations;
}

std::string NewtonSolver::reason(Outcome outcome, double reached, double tried) const {
  const std::string where = " between load fractions " + text(reached) + " and " + text(tried);
  switch (outcome) {
  case Outcome::Converged:
    return {};
  case Outcome::Cancelled:
    return "cancelled at load fraction " + text(reached);
  case Outcome::Inverted:
    return "elements turn inside out" + where;
  case Outcome::Indefinite:
    return "the tangent is no longer positive definite (the block loses stability)" + where;
  case Outcome::TooManyIterations:
    return "no convergence in " + std::to_string(options_.iterationsAStep) + " iterations" + where;
  case Outcome::Diverged:
    return "Newton's iteration diverges" + where;
  }
  return {};
}

} // namespace palp
