#include "solver/contact/ReducedContact.h"

#include "solver/linear/DenseSystems.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace palp {

namespace {

constexpr int mostIterations = 60;
constexpr double exactly = 1e-12; // relative to the largest translation
constexpr double slipBeforeTouch =
    0.5; // share of a point's motion in a step that counts as slip, if it comes into contact in that step
constexpr double smallestTranslation = 1e-9;
// Factors on the stiffness that weighs slip: tried one after the other until one leads to a solution.
constexpr std::array slipStiffnesses{1., 3., 1. / 3};

/// Stiffness [N / mm] between that of one of these points alone and that of one when all move with it (geometric mean).
/// Weighed by the first, points that slip under a large tangential motion, before the rubber follows and they stick,
/// oscillate without end; weighed by the second, those at the rim of the stick zone do.
double slipStiffness(const Eigen::MatrixXd& compliance, const std::vector<int>& points) {
  double alone = 0, together = 0; // of x and y
  for (const int i : points)
    for (const int j : points)
      for (const Eigen::Index c : {0, 1}) {
        const double moved = compliance(3 * Eigen::Index(i) + c, 3 * Eigen::Index(j) + c);
        together += moved;
        if (i == j) alone += moved;
      }
  return 2 * double(points.size()) / std::sqrt(alone * together);
}

} // namespace

ReducedContact::ReducedContact(const std::vector<Indenter>& indenters, const std::vector<ContactPoint>& points,
                               Eigen::Matrix3Xd tips_mm)
    : indenters_(indenters), points_(points), tips_mm_(std::move(tips_mm)) {}

void ReducedContact::startStep(const Eigen::Matrix3Xd& positions_mm, const ContactState& start) {
  assert(positions_mm.cols() == Eigen::Index(points_.size()) && "one position for each point");
  startPlaces_mm_ = positions_mm;
  touchedAtStart_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const int k = points_[i].indenter;
    const auto column = static_cast<Eigen::Index>(i);
    startPlaces_mm_.col(column) -= tips_mm_.col(k) + start.translations_mm.col(k);
    touchedAtStart_.push_back(start.statuses[i] != ContactStatus::Open);
  }
}

IndenterDistance ReducedContact::distanceOf(int point, const Eigen::Vector3d& position_mm,
                                            const Eigen::Matrix3Xd& translations_mm) const {
  const int k = points_[static_cast<std::size_t>(point)].indenter;
  return distance(indenters_[static_cast<std::size_t>(k)], position_mm - tips_mm_.col(k) - translations_mm.col(k));
}

double ReducedContact::penetration_mm(const Eigen::Matrix3Xd& positions_mm, const ContactState& state) const {
  double deepest = 0;
  for (int i = 0; i < static_cast<int>(points_.size()); ++i)
    deepest = std::min(deepest, distanceOf(i, positions_mm.col(i), state.translations_mm).gap_mm);
  return -deepest;
}

/// With T = I - n n^T, p = f . n, the slip s since the start and stiffnesses k and q:
///   frictionless  R = g n + T f / k
///   sticks        R = g n + T s
///   slides        R = g n + (T f - mu p e) / k,  e = t / |t|,  t = T (f - q s);  it sticks while |t| <= mu p.
ReducedContact::Conditions ReducedContact::conditions(int point, const Eigen::Vector3d& force,
                                                      const Eigen::Vector3d& position,
                                                      const Eigen::Matrix3Xd& translations, double stiffness,
                                                      double bySlip) const {
  const ContactPoint& at = points_[static_cast<std::size_t>(point)];
  const Indenter& indenter = indenters_[static_cast<std::size_t>(at.indenter)];
  const Eigen::Vector3d place = position - tips_mm_.col(at.indenter) - translations.col(at.indenter);
  const IndenterDistance near = distance(indenter, place);
  const Eigen::Vector3d& n = near.normal;
  const Eigen::Matrix3d& H = near.curvature_per_mm;
  const Eigen::Matrix3d normal = n * n.transpose(), T = Eigen::Matrix3d::Identity() - normal;
  const double p = force.dot(n), mu = indenter.friction;
  Conditions c;
  c.residual = near.gap_mm * n;
  c.byForce.setZero();
  c.byPlace = normal + near.gap_mm * H;
  // d(T f) = T df - H dx p - n (f . H dx)
  const Eigen::Matrix3d turning = -(p * H + n * (H * force).transpose());
  c.status = ContactStatus::Slip;
  if (mu == 0 || p <= 0) {
    c.residual += T * force / stiffness;
    c.byForce = T / stiffness;
    c.byPlace += turning / stiffness;
    return c;
  }
  const double share = touchedAtStart_[static_cast<std::size_t>(point)] ? 1 : slipBeforeTouch;
  const Eigen::Vector3d slip = share * (place - startPlaces_mm_.col(point));
  const Eigen::Vector3d trial = T * (force - bySlip * slip);
  const double length = trial.norm();
  if (length <= mu * p) {
    c.status = ContactStatus::Stick;
    c.residual += T * slip;
    c.byPlace += share * T - (n.dot(slip) * H + n * (H * slip).transpose());
    return c;
  }
  const Eigen::Vector3d e = trial / length;
  const Eigen::Matrix3d across = (T - e * e.transpose()) / length;
  c.residual += (T * force - mu * p * e) / stiffness;
  c.byForce = (T - mu * e * n.transpose() - mu * p * across) / stiffness;
  c.byPlace +=
      turning / stiffness + mu * p * share * bySlip / stiffness * across - mu * e * (H * force).transpose() / stiffness;
  return c;
}

bool ReducedContact::solve(const Eigen::MatrixXd& compliance, const Eigen::Matrix3Xd& positions_mm,
                           const std::vector<ContactTarget>& targets, ContactState& state,
                           const std::stop_token& stop) const {
  assert(compliance.rows() == 3 * Eigen::Index(points_.size()) && compliance.cols() == compliance.rows() &&
         positions_mm.cols() == Eigen::Index(points_.size()) && "one block and one position for each point");
  assert(targets.size() == indenters_.size() && state.statuses.size() == points_.size() && "one target per indenter");
  const ContactState start = state;
  if (std::none_of(indenters_.begin(), indenters_.end(), [](const Indenter& one) { return one.friction > 0; }))
    return solve(compliance, positions_mm, targets, 1, state, stop);
  return std::any_of(slipStiffnesses.begin(), slipStiffnesses.end(), [&](double share) {
    state = start;
    return solve(compliance, positions_mm, targets, share, state, stop);
  });
}

bool ReducedContact::solve(const Eigen::MatrixXd& compliance, const Eigen::Matrix3Xd& positions_mm,
                           const std::vector<ContactTarget>& targets, double slipShare, ContactState& state,
                           const std::stop_token& stop) const {
  const auto count = static_cast<int>(points_.size());
  const double stiffness = compliance.rows() / compliance.trace(); // [N / mm] of one point, about
  const Eigen::Matrix3Xd startForces = state.forces_N;
  Eigen::Matrix3Xd& f = state.forces_N;
  Eigen::Matrix3Xd& d = state.translations_mm;
  std::vector<std::pair<int, int>> moves; // indenter, direction: unknown translations
  for (std::size_t k = 0; k < targets.size(); ++k)
    for (int c = 0; c < 3; ++c)
      if (targets[k].free(c))
        moves.emplace_back(static_cast<int>(k), c);
      else
        d(c, static_cast<Eigen::Index>(k)) = targets[k].translation_mm(c);
  std::vector<int> touching, before;
  double bySlip = 0;
  for (int iteration = 0; iteration < mostIterations && !stop.stop_requested(); ++iteration) {
    const auto place = [&] {
      Eigen::Matrix3Xd x = positions_mm;
      const Eigen::Matrix3Xd change = f - startForces;
      x.reshaped() += compliance * change.reshaped();
      return x;
    };
    Eigen::Matrix3Xd x = place();
    before.swap(touching);
    touching.clear();
    bool released = false;
    for (int i = 0; i < count; ++i) {
      const IndenterDistance near = distanceOf(i, x.col(i), d);
      if (f.col(i).dot(near.normal) - stiffness * near.gap_mm > 0) {
        touching.push_back(i);
      } else if (!f.col(i).isZero(0)) {
        f.col(i).setZero();
        released = true;
      }
    }
    if (released) x = place();
    if (bySlip == 0 && !touching.empty()) bySlip = slipShare * slipStiffness(compliance, touching);
    const auto unknowns = static_cast<Eigen::Index>(3 * touching.size());
    const auto size = unknowns + static_cast<Eigen::Index>(moves.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right(size);
    bool statusesHold = true;
    for (std::size_t a = 0; a < touching.size(); ++a) {
      const int i = touching[a];
      const auto row = static_cast<Eigen::Index>(3 * a);
      const Conditions c = conditions(i, f.col(i), x.col(i), d, stiffness, bySlip);
      statusesHold = statusesHold && state.statuses[static_cast<std::size_t>(i)] == c.status;
      state.statuses[static_cast<std::size_t>(i)] = c.status;
      for (std::size_t b = 0; b < touching.size(); ++b)
        matrix.block<3, 3>(row, static_cast<Eigen::Index>(3 * b)) =
            c.byPlace * compliance.block<3, 3>(3 * Eigen::Index(i), 3 * Eigen::Index(touching[b]));
      matrix.block<3, 3>(row, row) += c.byForce;
      right.segment<3>(row) = -c.residual;
      for (std::size_t m = 0; m < moves.size(); ++m) {
        if (moves[m].first != points_[static_cast<std::size_t>(i)].indenter) continue;
        const auto column = unknowns + static_cast<Eigen::Index>(m);
        matrix.block<3, 1>(row, column) = -c.byPlace.col(moves[m].second);
        matrix(column, row + moves[m].second) = 1;
      }
    }
    for (int i = 0; i < count; ++i)
      if (!std::binary_search(touching.begin(), touching.end(), i))
        state.statuses[static_cast<std::size_t>(i)] = ContactStatus::Open;
    bool searching = false; // an indenter has not reached the body yet
    for (std::size_t m = 0; m < moves.size(); ++m) {
      const auto& [k, c] = moves[m];
      double sum = 0;
      bool any = false;
      for (int i : touching)
        if (points_[static_cast<std::size_t>(i)].indenter == k) {
          sum += f(c, i);
          any = true;
        }
      const auto row = unknowns + static_cast<Eigen::Index>(m);
      right(row) = targets[static_cast<std::size_t>(k)].force_N(c) - sum;
      if (any) continue;
      // Without contact it moves towards the body.
      searching = true;
      matrix(row, row) = 1;
      right(row) = c == 2 ? -targets[static_cast<std::size_t>(k)].longestMove_mm / 4 : 0;
    }
    if (size == 0) return true;
    Eigen::VectorXd change = right;
    if (!solveDense(matrix, change, stop)) return false;
    double share = 1, greatest = smallestTranslation;
    for (std::size_t m = 0; m < moves.size(); ++m) {
      const double move = std::abs(change(unknowns + static_cast<Eigen::Index>(m)));
      const double longest = targets[static_cast<std::size_t>(moves[m].first)].longestMove_mm;
      share = std::min(share, longest / std::max(move, 1e-300));
    }
    for (std::size_t a = 0; a < touching.size(); ++a)
      f.col(touching[a]) += share * change.segment<3>(static_cast<Eigen::Index>(3 * a));
    for (std::size_t m = 0; m < moves.size(); ++m)
      d(moves[m].second, moves[m].first) += share * change(unknowns + static_cast<Eigen::Index>(m));
    for (std::size_t k = 0; k < targets.size(); ++k)
      greatest = std::max(greatest, d.col(static_cast<Eigen::Index>(k)).norm());
    const double residual = unknowns > 0 ? right.head(unknowns).cwiseAbs().maxCoeff() : 0;
    const double step = change.head(unknowns).norm() / stiffness;
    if (!searching && touching == before && statusesHold && share == 1 && residual < 1e-8 * greatest &&
        step < std::sqrt(exactly) * 1e-3 * greatest * std::sqrt(1. + double(touching.size())))
      return true;
  }
  return false;
}

} // namespace palp
