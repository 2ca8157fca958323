#include "app/study/live/simulated/MovingTouch.h"

#include "model/base/Error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr double kForceShare = 0.3; // of the rectangle's side, that the range of the press counts as: it bends less
constexpr Eigen::Index kDrift = 5;  // rest, and the spline's linear part times the press
constexpr double kMostPress = 0.8;  // share of the samples' largest, of the automatic motion
constexpr double kAround_s = 11, kAlong_s = 17; // of the way along x and y

} // namespace

MovingTouch::MovingTouch(const SampleSet& touches) : rowWires_(touches.rowWires), columnWires_(touches.columnWires) {
  constexpr Eigen::Index kLeast = 20;
  if (!touches.hasTouches() || touches.size() < kLeast || touches.resistances_ohm.rows() == 0)
    throw Error("the moving indenter needs " + std::to_string(kLeast) +
                " or more samples of touches with resistances (palp sample --touch)");
  for (const TouchRow row : {kTouchShape, kTouchSize_mm, kTouchFriction})
    if ((touches.touches.row(row).array() != touches.touches(row, 0)).any())
      throw Error("the moving indenter needs touches of one shape, size and friction; these differ");
  if (!touches.forces_N.topRows<2>().isZero(1e-6))
    throw Error("the moving indenter needs touches without tangential force; some of these have one");
  const Eigen::Matrix2Xd places = touches.touchedPlaces_mm();
  low_mm_ = places.rowwise().minCoeff();
  high_mm_ = places.rowwise().maxCoeff();
  const Eigen::VectorXd press_N = -touches.forces_N.row(2).transpose();
  most_N_ = press_N.maxCoeff();
  // ln R = rest + press s(place, press), s the spline: it bends least over all, and so finds what rest is.
  const Eigen::MatrixXd logs = touches.resistances_ohm.array().log();
  const Eigen::Index count = touches.size();
  nodes_.resize(3, count);
  for (Eigen::Index k = 0; k < count; ++k) nodes_.col(k) = scaled(places.col(k), press_N(k));
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + kDrift, count + kDrift);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      system(i, j) = press_N(i) * press_N(j) * std::pow((nodes_.col(i) - nodes_.col(j)).norm(), 3);
  system.block(0, count, count, 1).setOnes();
  system.block(0, count + 1, count, 1) = press_N;
  system.block(0, count + 2, count, 3) = press_N.asDiagonal() * nodes_.transpose();
  system.bottomLeftCorner(kDrift, count) = system.topRightCorner(count, kDrift).transpose();
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(count + kDrift, logs.rows());
  wanted.topRows(count) = logs.transpose();
  const Eigen::MatrixXd found = system.partialPivLu().solve(wanted).transpose();
  rest_ohm_ = found.col(count).array().exp();
  weights_.resize(logs.rows(), count + kDrift - 1);
  weights_.leftCols(count) = found.leftCols(count) * press_N.asDiagonal();
  weights_.rightCols<kDrift - 1>() = found.rightCols<kDrift - 1>();
  now_ohm_ = rest_ohm_.reshaped<Eigen::RowMajor>(rowWires_, columnWires_);
}

Eigen::Vector3d MovingTouch::scaled(const Eigen::Vector2d& place_mm, double press_N) const {
  const double side = (high_mm_ - low_mm_).maxCoeff();
  return {(place_mm.x() - low_mm_.x()) / side, (place_mm.y() - low_mm_.y()) / side, kForceShare * press_N / most_N_};
}

SimulatedTouch::Truth MovingTouch::truth(double time_s) const {
  SimulatedTouch::Truth now;
  const auto share = [&](double period_s) { return 0.5 + 0.45 * std::sin(2 * std::numbers::pi * time_s / period_s); };
  now.place_mm = low_mm_ + Eigen::Vector2d(share(kAround_s), share(kAlong_s)).cwiseProduct(high_mm_ - low_mm_);
  const double in_s = time_s - kPress_s * std::floor(time_s / kPress_s) - kRest_s;
  if (in_s > 0)
    now.force_N.z() = -kMostPress * most_N_ * std::pow(std::sin(std::numbers::pi * in_s / (kPress_s - kRest_s)), 2);
  return now;
}

Eigen::MatrixXd MovingTouch::resistances_ohm(const SimulatedTouch::Truth& truth) const {
  const Eigen::Vector2d place =
      truth.place_mm.value_or(0.5 * (low_mm_ + high_mm_)).cwiseMax(low_mm_).cwiseMin(high_mm_);
  const double press_N = std::clamp(-truth.force_N.z(), 0.0, 2 * most_N_);
  const Eigen::Vector3d at = scaled(place, press_N);
  const Eigen::Index count = nodes_.cols();
  Eigen::VectorXd basis(count + 4);
  basis.head(count) = (nodes_.colwise() - at).colwise().norm().array().cube().transpose();
  basis.tail<4>() << 1, at;
  const Eigen::VectorXd ohm = rest_ohm_.array() * (press_N * (weights_ * basis)).array().exp();
  return ohm.reshaped<Eigen::RowMajor>(rowWires_, columnWires_);
}

const Eigen::MatrixXd& MovingTouch::at(double time_s) {
  SimulatedTouch::Truth now = truth(time_s);
  if (const auto held = hand_ ? hand_->held() : std::nullopt; held && held->place_mm) now = *held;
  now.force_N.head<2>().setZero(); // nothing holds it tangentially
  if (hand_) hand_->tell(time_s, now);
  now_ohm_ = resistances_ohm(now);
  return now_ohm_;
}

} // namespace palp
