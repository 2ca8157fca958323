#include "solver/statics/NewtonSolver.h"

#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "solver/statics/LinearisedBlock.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double growthAfterSuccess = 1.5;
constexpr double hopelessResidual = 1e8;
constexpr double acceptedSlope = 0.9;  // of the residual's work along the step, against its start
constexpr double judgedAbove = 1e-4;   // relative residual; below it full steps are right and rounding is near
constexpr double contractionAStep = 4; // a step l must shrink the correction to 1 - l / 4
constexpr int lineSearchTrials = 6;
constexpr int definitenessTrials = 4;
// Relative residual below which one or two more iterations with the same tangent end it.
constexpr double keepFactorBelow = 1e-5;
// Above this contraction a factor that is kept is of a state too far away, and not rounding what stagnates.
constexpr double slowContraction = 0.1;
// Number of further iterations with the same tangent that cost less than a new one.
constexpr double keptIterations = 3;
// A residual below this that stagnates is at round-off level.
constexpr double stallsBelow = 1e-6;
constexpr int stallsAtRounding = 3;
// So is any that stagnates where strains are so small that the problem is linear: below 1e-8 N the forces' own rounding
// is 1e-5 of the load.
constexpr double smallStrain = 1e-4;

double smallestElement_mm(const Discretisation& mesh) {
  double volume = INFINITY;
  for (int e = 0; e < mesh.elements(); ++e) volume = std::min(volume, mesh.volume(e));
  return std::cbrt(volume);
}

double largest(const Eigen::VectorXd& values) {
  return values.cwiseAbs().maxCoeff();
}

} // namespace

NewtonSolver::NewtonSolver(const Assembler& assembler, SparseCholesky& cholesky, NewtonOptions options,
                           NewtonObserver observer)
    : assembler_(assembler), cholesky_(cholesky), options_(options), observer_(std::move(observer)) {}

NewtonSolver& NewtonSolver::startingWith(LentTangent rest) {
  rest_ = std::move(rest);
  return *this;
}

NewtonResult NewtonSolver::solve(const Loading& loading) {
  const Discretisation& mesh = assembler_.discretisation();
  NewtonResult result;
  result.increments.push_back({0, mesh.atRest()});
  result.internalForces = Eigen::VectorXd::Zero(loading.forces.size());
  const double load = mesh.freePart(loading.forces).norm();
  smallMove_mm_ = smallStrain * smallestElement_mm(mesh);
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
      result.smallestJ = forces_.smallestJ;
      result.largestJ = forces_.largestJ;
      size *= growthAfterSuccess;
      continue;
    }
    size = (target - fraction) / 2;
    if (outcome == Outcome::Cancelled || size < options_.smallestStep) {
      result.cancelled = outcome == Outcome::Cancelled;
      result.stopReason = stopReason(outcome, options_.iterationsAStep, fraction, target);
      break;
    }
  }
  result.converged = fraction >= 1;
  if (result.converged && relative_ >= options_.relativeTolerance)
    result.stopReason = "the residual stagnates at round-off level: " +
                        gotExpected(relative_, " of the load", shortText(options_.relativeTolerance) + " or less");
  result.steps = std::move(steps_);
  return result;
}

void NewtonSolver::setResidual(const Loading& loading, double fraction) {
  const Discretisation& mesh = assembler_.discretisation();
  const Eigen::VectorXd external = fraction * mesh.freePart(loading.forces);
  internal_ = assembler_.sum(forces_.raw, options_.threads);
  residual_ = external - mesh.freePart(assembler_.sum(forces_.forces, options_.threads));
  // Condensed, the volumes' residuals would count kappa-fold.
  relative_ = std::hypot((external - mesh.freePart(internal_)).norm(), assembler_.localNorm(forces_)) / scale_;
}

/// Residual of the state, condensed with the tangent in use.
void NewtonSolver::evaluate(const Loading& loading, double fraction, const ElementState& state) {
  assembler_.residual(state, *tangents_, forces_, options_.threads);
  setResidual(loading, fraction);
}

/// Tangent and residual of the state; what moves by prescription pushes the rest.
NewtonSolver::Outcome NewtonSolver::newTangent(const Loading& loading, double fraction, const ElementState& state,
                                               const Eigen::VectorXd* prescribed) {
  rest_.letGo();
  assembler_.tangent(state, ownTangents_, forces_, options_.threads, observer_.stop);
  if (stopped()) return Outcome::Cancelled;
  tangents_ = &ownTangents_;
  setResidual(loading, fraction);
  if (prescribed)
    residual_ -= assembler_.discretisation().freePart(assembler_.stiffnessTimes(ownTangents_, *prescribed));
  LaneVector matrix = assembler_.matrix(ownTangents_, options_.threads);
  ownTangents_.stiffness = {}; // summed up; the factor needs its memory
  const auto outcome = cholesky_.factorise(std::move(matrix), options_.threads, observer_.stop);
  if (outcome == SparseCholesky::Outcome::Stopped) return Outcome::Cancelled;
  if (outcome == SparseCholesky::Outcome::NotPositiveDefinite) return Outcome::Indefinite;
  factor_ = &cholesky_;
  return Outcome::Converged;
}

/// Tangent and residual at the start of a load step under forces alone.
NewtonSolver::Outcome NewtonSolver::startTangent(const Loading& loading, double from, double to,
                                                 const ElementState& state) {
  if (from > 0 || !rest_) return newTangent(loading, to, state);
  tangents_ = &rest_->tangents;
  factor_ = &rest_->factor;
  forces_ = rest_->forces;
  setResidual(loading, to);
  return Outcome::Converged;
}

/// First step of a prescribed motion v: K du = R - K v on the free components, du = v on the others. The motion is
/// applied in full, as its residual does not measure overshooting, and its forces become the scale of residuals. Ends
/// with a tangent for the next step: going back along this one would undo the motion, too.
NewtonSolver::Outcome NewtonSolver::movePrescribed(const Loading& loading, double to, const Eigen::VectorXd& motion,
                                                   ElementState& state) {
  if (const Outcome outcome = newTangent(loading, to, state, &motion); outcome != Outcome::Converged) return outcome;
  relative_ = 1;
  record(to, 0);
  if (stopped()) return Outcome::Cancelled;
  const Direction first = direction(state, motion);
  if (stopped()) return Outcome::Cancelled; // there may be no direction
  move(first, state);
  evaluate(loading, to, state);
  scale_ = internal_.norm(); // now that there are reactions to measure by
  setResidual(loading, to);
  if (forces_.smallestJ <= 0) return outcomeOfVolume(forces_.smallestJ);
  record(to, 1);
  return relative_ <= keepFactorBelow ? Outcome::Converged : newTangent(loading, to, state);
}

NewtonSolver::Direction NewtonSolver::direction(const ElementState& state, const Eigen::VectorXd& prescribed) const {
  Direction direction{.start = state, .du = residual_, .dx = {}, .residual = relative_};
  factor_->solve(direction.du, observer_.stop);
  direction.slope = residual_.dot(direction.du);
  direction.du = assembler_.discretisation().withZeros(direction.du) + prescribed;
  direction.dx = assembler_.recover(*tangents_, forces_, direction.du, options_.threads);
  return direction;
}

void NewtonSolver::move(const Direction& direction, ElementState& state) {
  state.displacements = direction.start.displacements + direction.length * direction.du;
  for (std::size_t i = 0; i < direction.dx.size(); ++i)
    state.unknowns[i] = direction.start.unknowns[i] + direction.length * direction.dx[i];
}

/// Whether a step l du went too far:
///   elements are inside out; or
///   |R| > |F| and the residual's work along the step did not fall, |R(u + l du) . du| > 0.9 |R(u) . du|; or
///   |R| grew and so did the remaining distance, |K^-1 R(u + l du)| > (1 - l / 4) |du|, K being the tangent of the step
/// (the restricted natural monotonicity test: Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 3.3).
/// No step does where the rubber answers linearly all along it.
/// A growing residual alone does not suffice: a long good step leaves wrong pressures, which the next one corrects. Nor
/// does a growing distance: in a tall block it grows on the right path, while the residual falls.
bool NewtonSolver::overshot(const Direction& direction) const {
  if (forces_.smallestJ <= 0 || !std::isfinite(relative_)) return true;
  if (largest(direction.start.displacements) + largest(direction.du) < smallMove_mm_) return false;
  const Eigen::VectorXd du = assembler_.discretisation().freePart(direction.du);
  if (relative_ > 1 && std::abs(residual_.dot(du)) > acceptedSlope * std::abs(direction.slope)) return true;
  if (relative_ <= std::max(judgedAbove, direction.residual)) return false;
  Eigen::VectorXd left = residual_;
  factor_->solve(left, observer_.stop);
  return left.norm() > (1 - direction.length / contractionAStep) * du.norm();
}

NewtonSolver::Outcome NewtonSolver::searchLine(const Loading& loading, double fraction, Direction& direction,
                                               ElementState& state) {
  for (int trial = 0; trial < lineSearchTrials; ++trial) {
    if (stopped()) return Outcome::Cancelled;
    direction.length /= 2;
    move(direction, state);
    evaluate(loading, fraction, state);
    if (!overshot(direction)) return Outcome::Converged;
  }
  return forces_.smallestJ <= 0 ? outcomeOfVolume(forces_.smallestJ) : Outcome::Diverged;
}

/// A new tangent; where it is not positive definite, the state goes back along its last step as far as needed. It
/// starts with half of the full step, even where less was taken of it: closer to the start are states about to lose
/// stability, whose steps are huge.
NewtonSolver::Outcome NewtonSolver::definiteTangent(const Loading& loading, double fraction, Direction& last,
                                                    ElementState& state) {
  last.length = 1;
  for (int trial = 0;; ++trial) {
    const Outcome outcome = newTangent(loading, fraction, state);
    if (outcome != Outcome::Indefinite || trial == definitenessTrials) return outcome;
    last.length /= 2;
    move(last, state);
  }
}

/// Whether the tangent in use ends the iteration soon. That of the load step's start contracts all along as it does at
/// first; one on the way does not. The tangent of a curved law may change too much on the last step of all.
bool NewtonSolver::factorWillDo(double previous, bool ofTheStart) const {
  const double contraction = relative_ / previous;
  const bool curved = assembler_.rubber().law != KernelLaw::MooneyRivlin;
  if (relative_ <= keepFactorBelow) return contraction < slowContraction || !curved;
  if (!ofTheStart) return false;
  return contraction < 1 && std::log(options_.relativeTolerance / relative_) >= keptIterations * std::log(contraction);
}

void NewtonSolver::record(double fraction, int iteration) {
  steps_.push_back({fraction, iteration, relative_});
  if (observer_.step) observer_.step(steps_.back());
}

/// Equilibrium at the load fraction f = `to`: R(u, x) = f F - F_int(u, x) = 0 together with the elements' own equations
/// in their own unknowns x (bubbles, pressures), by Newton's method on both (Bonet and Wood, Nonlinear Continuum
/// Mechanics for Finite Element Analysis, 2008, chapter 9):
///   (Kuu - Kux Kxx^-1 Kxu) du = R_u - Kux Kxx^-1 R_x,   dx = Kxx^-1 (R_x - Kxu du),   u += l du,   x += l dx,
/// with l = 1 unless that goes too far. The pressures move linearly with the displacements instead of following them
/// exactly, which is what keeps the steps large for nearly incompressible rubber.
NewtonSolver::Outcome NewtonSolver::step(const Loading& loading, double from, double to, ElementState& state) {
  const Discretisation& mesh = assembler_.discretisation();
  const Eigen::VectorXd motion = (to - from) * (loading.prescribed - mesh.withZeros(mesh.freePart(loading.prescribed)));
  const bool moves = motion.cwiseAbs().maxCoeff() > 0;
  const Outcome start = moves ? movePrescribed(loading, to, motion, state) : startTangent(loading, from, to, state);
  if (start != Outcome::Converged) return start;
  if (!moves) record(to, 0);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(motion.size());
  double previous = relative_;
  int stalled = 0;
  bool ofTheStart = !moves; // the tangent in use
  for (int iteration = moves ? 2 : 1; iteration <= options_.iterationsAStep; ++iteration) {
    if (stopped()) return Outcome::Cancelled;
    Direction newton = direction(state, none);
    if (stopped()) return Outcome::Cancelled; // there may be no direction
    move(newton, state);
    evaluate(loading, to, state);
    if (overshot(newton))
      if (const Outcome outcome = searchLine(loading, to, newton, state); outcome != Outcome::Converged) return outcome;
    record(to, iteration);
    if (relative_ > hopelessResidual) return Outcome::Diverged;
    const bool maybeRounding = relative_ < stallsBelow || largest(state.displacements) < smallMove_mm_;
    stalled = maybeRounding && relative_ > previous / 2 ? stalled + 1 : 0;
    if (relative_ < options_.relativeTolerance || stalled == stallsAtRounding) return Outcome::Converged;
    const bool keep = factorWillDo(previous, ofTheStart);
    previous = relative_;
    if (keep || iteration == options_.iterationsAStep) continue;
    ofTheStart = false;
    if (const Outcome outcome = definiteTangent(loading, to, newton, state); outcome != Outcome::Converged)
      return outcome;
  }
  return Outcome::TooManyIterations;
}

} // namespace palp
