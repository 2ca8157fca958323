#include "solver/contact/ContactSolver.h"

#include "model/DesignError.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"
#include "model/base/Text.h"
#include "solver/assembly/SurfaceTraction.h"
#include "solver/contact/ContactSteps.h"
#include "solver/statics/StepMixing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double stepGrowth = 2;
constexpr double hopeless = 1e8;
constexpr int halvings = 2;      // of one iteration's step length, where elements turn inside out
constexpr int mostShortened = 2; // shortened iterations of a load step; then half of the load is tried
// A residual below this that stagnates is at round-off level (as in NewtonSolver).
constexpr double roundingBelow = 1e-6;
// An iteration that has not found the forces after this number of tangents finds them sooner from half of the load.
constexpr int tangentsToFindForces = 3;
constexpr double forcesAreFoundBelow = 0.5;
constexpr int stallsOfRounding = 3;
// The solve ends after this number of failed load steps in which less than this share of the remaining load was
// applied: each takes two or three tangents, and there would be hundreds down to a thousandth of the load.
constexpr int mostFailedSteps = 5;
constexpr double progressOfRest = 1. / 8;
// A new tangent takes the time of some twenty iterations with the one in use.
constexpr double keptIterations = 20;
constexpr int iterationsOfNewTangent = 5; // of a load step; further iterations are charged to the old one

} // namespace

ContactSolver::ContactSolver(const Assembler& assembler, const Mesh& mesh, const SensorDesign& design,
                             const std::vector<LoadCase>& path, NewtonOptions options, NewtonObserver observer)
    : assembler_(assembler), mesh_(mesh), design_(design), path_(path), indenters_(path.front().indenters),
      options_(options), observer_(std::move(observer)), tips_mm_(tipsAtRest_mm(indenters_, mesh)) {}

void ContactSolver::choosePoints(double margin) {
  points_ = touchablePoints(mesh_, design_, path_, margin);
  std::vector<bool> met(indenters_.size());
  for (const ContactPoint& point : points_) met[static_cast<std::size_t>(point.indenter)] = true;
  for (std::size_t k = 0; k < met.size(); ++k)
    if (!met[k])
      throw DesignError("indenter " + std::to_string(k) + " (" + shapeName(indenters_[k].shape) + " at " +
                        text(indenters_[k].place_mm.x()) + ", " + text(indenters_[k].place_mm.y()) +
                        " mm) touches no node of the mesh; expected a finer mesh or a deeper touch");
  auto pattern = std::make_shared<SparsePattern>(*assembler_.pattern());
  for (const ContactPoint& point : points_) pattern->lastGroups.push_back(assembler_.group(point.node));
  tangentServes_ = false;
  cholesky_.emplace(std::make_shared<const CholeskyPlan>(std::move(pattern)));
  contact_.emplace(indenters_, points_, tips_mm_);
}

ContactIncrement ContactSolver::atRest() const {
  return {{0, assembler_.discretisation().atRest()}, untouched(points_.size(), indenters_.size())};
}

/// Forces of areas and discs change from those of the previous load to this one's.
void ContactSolver::beginLoad(std::size_t load) {
  now_ = load;
  expected_ = contactEstimates(path_[load].indenters, design_);
  if (load == 0)
    before_ = Eigen::VectorXd::Zero(3 * Eigen::Index(mesh_.nodeCount()));
  else
    before_.swap(forces_N_);
  forces_N_ = nodalForces(mesh_, design_, path_[load]);
}

std::vector<ContactResult> ContactSolver::solve() {
  double margin = touchableMargin;
  for (int attempt = 1;; ++attempt, margin *= marginGrowth) {
    choosePoints(margin);
    std::vector<ContactResult> results;
    ContactIncrement start = atRest();
    bool beyond = false;
    for (std::size_t load = 0; load < path_.size() && !beyond; ++load) {
      beginLoad(load);
      results.push_back(follow(start));
      if (!results.back().newton.converged) break;
      start = results.back().increments.back();
      beyond = attempt < mostMargins && touchesBeyond({start.equilibrium.state, start.contact});
    }
    if (!beyond) return results;
  }
}

ContactResult ContactSolver::follow(const ContactIncrement& start) {
  ContactResult result;
  result.points = points_;
  result.increments.push_back(start);
  result.increments.back().equilibrium.loadFraction = 0;
  NewtonResult& newton = result.newton;
  if (now_ == 0) {
    newton.internalForces = Eigen::VectorXd::Zero(forces_N_.size());
  } else {
    newton.internalForces = internal_;
    newton.smallestJ = forces_.smallestJ;
    newton.largestJ = forces_.largestJ;
  }
  const double largest = largestContactStep(path_[now_].indenters, now_ == 0);
  double fraction = 0, size = largest, before = 0;
  int failed = 0; // steps since the load fraction `before`
  while (fraction < 1) {
    const double target = fraction + size > 1 - 1e-9 ? 1 : fraction + size;
    const ContactIncrement& last = result.increments.back();
    State state;
    const auto attempt = [&](TangentialControl control) {
      state = {last.equilibrium.state, last.contact};
      Outcome outcome = step(fraction, target, state, control);
      if (outcome == Outcome::Converged && control == TangentialControl::Displacement) { // now released
        tangentServes_ = true;
        outcome = step(target, target, state, TangentialControl::Force);
      }
      if (outcome == Outcome::Converged && slidAway(path_[now_].indenters, expected_, last.contact, state.contact))
        outcome = Outcome::NoContact;
      tangentServes_ = outcome == Outcome::Converged && charged_ < keptIterations;
      return outcome;
    };
    const bool withOldTangent = tangentServes_;
    Outcome outcome = attempt(TangentialControl::Force);
    if (withOldTangent && outcome != Outcome::Converged && outcome != Outcome::Cancelled)
      outcome = attempt(TangentialControl::Force);
    // One or two nodes cannot hold a tangentially free indenter while it comes down on them.
    if (outcome == Outcome::NoContact && anyForceWithFriction()) outcome = attempt(TangentialControl::Displacement);
    if (outcome == Outcome::Converged) {
      fraction = target;
      result.increments.push_back({{fraction, std::move(state.rubber)}, std::move(state.contact)});
      newton.internalForces = internal_;
      newton.smallestJ = forces_.smallestJ;
      newton.largestJ = forces_.largestJ;
      size = std::min(largest, stepGrowth * size);
      if (fraction - before < progressOfRest * (1 - before)) continue;
      before = fraction;
      failed = 0;
      continue;
    }
    size = (target - fraction) / 2;
    const bool stuck = ++failed == mostFailedSteps;
    if (outcome == Outcome::Cancelled || stuck || size < options_.smallestStep) {
      newton.cancelled = outcome == Outcome::Cancelled;
      newton.stopReason = stopReason(outcome, options_.iterationsAStep, fraction, target);
      if (stuck && !newton.cancelled) newton.stopReason += "; smaller load steps do not converge either";
      if (!newton.cancelled) newton.stopReason += whyHard(last.contact);
      break;
    }
  }
  newton.converged = fraction >= 1;
  if (newton.converged && relative_ >= options_.relativeTolerance)
    newton.stopReason = "the residual stagnates at round-off level: " +
                        gotExpected(relative_, " of the load", shortText(options_.relativeTolerance) + " or less");
  newton.steps = std::move(steps_);
  steps_.clear();
  return result;
}

/// The known reason why such a load does not converge, and its remedy; empty if there is none.
std::string ContactSolver::whyHard(const ContactState& reached) const {
  double finest_mm2 = std::numeric_limits<double>::infinity();
  for (const ContactPoint& point : points_) finest_mm2 = std::min(finest_mm2, point.area_mm2);
  const double finest_mm = std::sqrt(finest_mm2);
  for (std::size_t k = 0; k < indenters_.size(); ++k) {
    const Indenter& one = path_[now_].indenters[k];
    if (one.shape == IndenterShape::Flat && one.rim_mm < finest_mm)
      return "; the pressure at a sharp rim is unbounded: the rim radius of " + withDigits(one.rim_mm, 6) +
             " mm is smaller than the mesh resolves (" + text(std::round(1000 * finest_mm) / 1000) +
             " mm); use a larger rim radius, a finer mesh or a smaller depth";
    const double depth_mm = -reached.translations_mm(2, static_cast<Eigen::Index>(k));
    if (isRound(one) && std::max(depth_mm, expected_[k].depth_mm) > one.radius_mm)
      return "; the " + shapeName(one.shape) + " of radius " + withDigits(one.radius_mm, 6) +
             " mm is pressed deeper than its radius, which distorts the elements below it; use a larger radius or a "
             "smaller depth";
  }
  return {};
}

bool ContactSolver::anyForceWithFriction() const {
  return std::any_of(path_[now_].indenters.begin(), path_[now_].indenters.end(),
                     [](const Indenter& indenter) { return indenter.press() && indenter.friction > 0; });
}

/// An indenter's control at a fraction of the present load, interpolated from that of the previous load of the path.
Indenter ContactSolver::partOf(std::size_t indenter, double fraction) const {
  const Indenter& goal = path_[now_].indenters[indenter];
  if (now_ == 0) return goal.at(fraction);
  const Indenter& from = path_[now_ - 1].indenters[indenter];
  const auto between = [&]<class Value>(const Value& a, const Value& b) -> Value {
    return (1 - fraction) * a + fraction * b;
  };
  Indenter part = goal;
  if (const Press* press = goal.press())
    part.control = Press{between(from.press()->force_N, press->force_N)};
  else
    part.control = Motion{between(from.motion()->depth_mm, goal.motion()->depth_mm),
                          between(from.motion()->shift_mm, goal.motion()->shift_mm)};
  return part;
}

std::vector<ContactTarget> ContactSolver::targets(double fraction) const {
  std::vector<Indenter> parts;
  for (std::size_t k = 0; k < indenters_.size(); ++k) parts.push_back(partOf(k, fraction));
  return contactTargets(parts, expected_);
}

Eigen::Matrix3Xd ContactSolver::positions(const Eigen::VectorXd& displacements) const {
  Eigen::Matrix3Xd x(3, static_cast<Eigen::Index>(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const int node = points_[i].node;
    x.col(static_cast<Eigen::Index>(i)) = mesh_.nodes_mm.col(node) + displacements.segment<3>(3 * Eigen::Index(node));
  }
  return x;
}

Eigen::VectorXd ContactSolver::onFreeComponents(const Eigen::Matrix3Xd& forces) const {
  const Discretisation& mesh = assembler_.discretisation();
  Eigen::VectorXd all = Eigen::VectorXd::Zero(mesh.dof());
  for (std::size_t i = 0; i < points_.size(); ++i)
    all.segment<3>(mesh.freeIndex(3 * points_[i].node)) = forces.col(static_cast<Eigen::Index>(i));
  return all;
}

void ContactSolver::setResidual(double fraction, const State& state) {
  const Discretisation& mesh = assembler_.discretisation();
  const Eigen::VectorXd loads = before_ + fraction * (forces_N_ - before_);
  const Eigen::VectorXd external = mesh.freePart(loads) + onFreeComponents(state.contact.forces_N);
  internal_ = assembler_.sum(forces_.raw, options_.threads);
  residual_ = external - mesh.freePart(assembler_.sum(forces_.forces, options_.threads));
  const double scale = external.norm();
  relative_ =
      scale > 0 ? std::hypot((external - mesh.freePart(internal_)).norm(), assembler_.localNorm(forces_)) / scale : 1;
}

ContactSolver::Outcome ContactSolver::newTangent(double fraction, const State& state) {
  assembler_.tangent(state.rubber, tangents_, forces_, options_.threads, observer_.stop);
  if (stopped()) return Outcome::Cancelled;
  setResidual(fraction, state);
  LaneVector matrix = assembler_.matrix(tangents_, options_.threads);
  tangents_.stiffness = {};
  // The factor only preconditions; the residual, in double precision, determines the result.
  const UpdatePrecision products = assembler_.rubber().roundsWell() ? UpdatePrecision::Single : UpdatePrecision::Double;
  const auto outcome = cholesky_->factorise(std::move(matrix), options_.threads, observer_.stop, products);
  if (outcome == SparseCholesky::Outcome::Stopped) return Outcome::Cancelled;
  if (outcome == SparseCholesky::Outcome::NotPositiveDefinite) return Outcome::Indefinite;
  compliance_ = cholesky_->inverseOfLast(observer_.stop);
  charged_ = 0;
  return stopped() ? Outcome::Cancelled : Outcome::Converged;
}

/// Equilibrium and contact at the load fraction `to`. In an iteration, with K the tangent and R the residual without
/// a change of the contact forces f:
///   w = K^-1 R;  f' = contact of the points at X + u + w with the compliance C = K^-1;  du = w + K^-1 (f' - f).
ContactSolver::Outcome ContactSolver::step(double from, double to, State& state, TangentialControl control) {
  const Discretisation& mesh = assembler_.discretisation();
  std::vector<ContactTarget> goal = targets(to);
  if (control == TangentialControl::Displacement) (void)constrainTangentially(goal, state.contact);
  contact_->startStep(positions(state.rubber.displacements), state.contact);
  if (now_ == 0 && from == 0)
    for (std::size_t k = 0; k < goal.size(); ++k) {
      const Indenter part = partOf(k, to);
      state.contact.translations_mm.col(static_cast<Eigen::Index>(k)).z() = -contactEstimate(part, design_).depth_mm;
    }
  if (tangentServes_) // the forces are those of the initial equilibrium
    setResidual(to, state);
  else if (const Outcome outcome = newTangent(to, state); outcome != Outcome::Converged)
    return outcome;
  record(to, 0);
  StepMixing mixing; // of the iterations with one tangent; contact forces are solved in each
  double previous = 1;
  int stalled = 0, shortened = 0;
  for (int iteration = 1; iteration <= options_.iterationsAStep; ++iteration) {
    if (stopped()) return Outcome::Cancelled;
    const State start = state;
    ContactState found = start.contact;
    bool answered = false;
    Eigen::VectorXd moved = residual_;
    cholesky_->solve(
        moved,
        [&](const Eigen::VectorXd& byResidual) -> Eigen::VectorXd {
          Eigen::Matrix3Xd expected = positions(start.rubber.displacements);
          expected.reshaped() += byResidual;
          answered = contact_->solve(compliance_, expected, goal, found, observer_.stop);
          return (found.forces_N - start.contact.forces_N).reshaped();
        },
        observer_.stop);
    if (stopped()) return Outcome::Cancelled;
    if (!answered) return Outcome::NoContact;
    Eigen::VectorXd du = mesh.withZeros(moved);
    // The elements' internal residuals were condensed without the change of the contact forces, which acts on nodes
    // alone.
    LaneVector dx = assembler_.recover(tangents_, forces_, du, options_.threads);
    mixing.mix(du, dx);
    double length = 1;
    Outcome shortenedBy = Outcome::Inverted;
    for (int trial = 0;; ++trial) {
      state.rubber.displacements = start.rubber.displacements + length * du;
      for (std::size_t i = 0; i < dx.size(); ++i) state.rubber.unknowns[i] = start.rubber.unknowns[i] + length * dx[i];
      state.contact = found;
      state.contact.forces_N = start.contact.forces_N + length * (found.forces_N - start.contact.forces_N);
      assembler_.residual(state.rubber, tangents_, forces_, options_.threads);
      setResidual(to, state);
      if (forces_.smallestJ > 0) break;
      if (trial == halvings) return outcomeOfVolume(forces_.smallestJ);
      if (stopped()) return Outcome::Cancelled;
      shortenedBy = outcomeOfVolume(forces_.smallestJ);
      length /= 2;
    }
    record(to, iteration);
    const bool lost = iteration >= tangentsToFindForces && relative_ > forcesAreFoundBelow;
    if (lost || !(relative_ < hopeless)) return Outcome::Diverged;
    if (length < 1 && ++shortened > mostShortened) return shortenedBy;
    stalled = relative_ < roundingBelow && relative_ > previous / 2 ? stalled + 1 : 0;
    if (length == 1 && (relative_ < options_.relativeTolerance || stalled == stallsOfRounding)) {
      charged_ += std::max(0, iteration - iterationsOfNewTangent);
      return Outcome::Converged;
    }
    const bool keep = length == 1 && tangentWillDo(previous);
    previous = relative_;
    if (keep || iteration == options_.iterationsAStep) continue;
    mixing.restart();
    if (const Outcome outcome = newTangent(to, state); outcome != Outcome::Converged) return outcome;
  }
  return Outcome::TooManyIterations;
}

/// Whether the present tangent converges soon, if it contracts as in the last iteration.
bool ContactSolver::tangentWillDo(double previous) const {
  if (!(relative_ < previous)) return relative_ < roundingBelow;
  return std::log(options_.relativeTolerance / relative_) >= keptIterations * std::log(relative_ / previous);
}

bool ContactSolver::touchesBeyond(const State& state) const {
  const double allowed_mm = mesh_.nodes_mm.row(2).maxCoeff() / penetrationOfHeight;
  std::vector<bool> candidate(static_cast<std::size_t>(mesh_.nodeCount()));
  for (const ContactPoint& point : points_) candidate[static_cast<std::size_t>(point.node)] = true;
  for (const ContactPoint& point : contactPoints(mesh_)) {
    if (candidate[static_cast<std::size_t>(point.node)]) continue;
    const Eigen::Vector3d position_mm =
        mesh_.nodes_mm.col(point.node) + state.rubber.displacements.segment<3>(3 * Eigen::Index(point.node));
    if (penetrates(indenters_, tips_mm_ + state.contact.translations_mm, position_mm, allowed_mm)) return true;
  }
  return false;
}

void ContactSolver::record(double fraction, int iteration) {
  steps_.push_back({fraction, iteration, relative_});
  if (!observer_.step) return;
  NewtonStep step = steps_.back();
  step.loadFraction += static_cast<double>(now_); // the loads of a path in sequence
  observer_.step(step);
}

} // namespace palp
