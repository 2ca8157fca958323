#include "app/study/live/SimulatedTouch.h"

#include "app/study/live/simulated/MovingTouch.h"
#include "model/base/Error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

namespace palp {

namespace {

constexpr int kDegree = 3;     // 2e-7 of the displacements in the paper's range
constexpr double kShear = 0.8; // share of the ranges that the touch goes through
constexpr double kPress = 0.9;
constexpr std::size_t kStates = 500; // half a second of a quick board

/// Column of the sample with the smallest force.
Eigen::Index nearestRest(const SampleSet& samples) {
  Eigen::Index nearest = 0;
  samples.forces_N.colwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

} // namespace

SimulatedTouch::SimulatedTouch(const SampleSet& samples)
    : rowWires_(samples.rowWires), columnWires_(samples.columnWires),
      designFingerprint_(samples.origin.designFingerprint) {
  if (samples.together() || samples.size() == 0 || samples.resistances_ohm.rows() == 0)
    throw Error("the simulated touch needs samples with resistances and one area loaded at a time (--areas each)");
  for (int area = 0; area < samples.areaCount; ++area)
    if (!(samples.area.array() == area).any())
      throw Error("the simulated touch needs samples on every area; area " + std::to_string(area) + " has none");
  low_N_ = samples.forces_N.rowwise().minCoeff();
  high_N_ = samples.forces_N.rowwise().maxCoeff();
  // Differences from one sample keep the digits that the small changes of R need.
  const Eigen::VectorXd base_ohm = samples.resistances_ohm.col(nearestRest(samples));
  ForwardModelOptions options;
  options.degree = kDegree;
  response_ = fitForwardModel(samples.resistances_ohm.colwise() - base_ohm, samples.forces_N, samples.area, options);
  rest_ohm_ = base_ohm;
  for (std::size_t area = 0; area < response_.classes(); ++area) // each area's polynomial has a rest of its own
    rest_ohm_ += response_.measurementsOf(area, Eigen::Vector3d::Zero()) / static_cast<double>(response_.classes());
}

SimulatedTouch::Truth SimulatedTouch::truth(double time_s) const {
  const auto touch = static_cast<std::int64_t>(std::floor(time_s / kTouch_s));
  const auto areas = static_cast<std::int64_t>(response_.classes());
  Truth truth;
  truth.area = static_cast<int>((touch % areas + areas) % areas);
  const double phase = time_s / kTouch_s - static_cast<double>(touch); // 0..1; the first half is rest
  if (phase < 0.5) return truth;
  const double press = std::pow(std::sin(2 * std::numbers::pi * phase), 2);
  const double angle = 4 * std::numbers::pi * phase;
  truth.force_N = {kShear * press * std::cos(angle) * high_N_.x(), kShear * press * std::sin(angle) * high_N_.y(),
                   kPress * press * low_N_.z()};
  return truth;
}

Eigen::MatrixXd SimulatedTouch::resistances_ohm(const Truth& truth) const {
  const auto area = static_cast<std::size_t>(truth.area);
  const Eigen::VectorXd change =
      response_.measurementsOf(area, truth.force_N) - response_.measurementsOf(area, Eigen::Vector3d::Zero());
  return (rest_ohm_ + change).reshaped<Eigen::RowMajor>(rowWires_, columnWires_);
}

const Eigen::MatrixXd& SimulatedTouch::at(double time_s) {
  Truth now = truth(time_s);
  if (const auto held = hand_ ? hand_->held() : std::nullopt) {
    now = *held;
    if (now.area < 0 || static_cast<std::size_t>(now.area) >= response_.classes()) now = {}; // not on this sensor
  }
  now_ohm_ = resistances_ohm(now);
  return now_ohm_;
}

void TouchHand::hold(const std::optional<SimulatedTouch::Truth>& touch) {
  const std::lock_guard lock(mutex_);
  touch_ = touch;
}

std::optional<SimulatedTouch::Truth> TouchHand::held() const {
  const std::lock_guard lock(mutex_);
  return touch_;
}

void TouchHand::tell(double time_s, const SimulatedTouch::Truth& now) {
  const std::lock_guard lock(mutex_);
  if (!states_.empty() && time_s < states_.back().first) states_.clear(); // the board was started anew
  states_.emplace_back(time_s, now);
  if (states_.size() > kStates) states_.pop_front();
}

std::optional<SimulatedTouch::Truth> TouchHand::at(double time_s) const {
  const std::lock_guard lock(mutex_);
  if (states_.empty()) return {};
  const auto after = std::lower_bound(states_.begin(), states_.end(), time_s,
                                      [](const auto& one, double wanted_s) { return one.first < wanted_s; });
  return after == states_.end() ? states_.back().second : after->second;
}

namespace {

/// The resistances of the simulated touch over time.
std::function<const Eigen::MatrixXd&(double)> touchOver(const SampleSet& samples, std::shared_ptr<TouchHand> hand) {
  if (samples.hasTouches()) {
    const auto moving = std::make_shared<MovingTouch>(samples);
    moving->follow(std::move(hand));
    return [moving](double time_s) -> const Eigen::MatrixXd& { return moving->at(time_s); };
  }
  const auto touch = std::make_shared<SimulatedTouch>(samples);
  touch->follow(std::move(hand));
  return [touch](double time_s) -> const Eigen::MatrixXd& { return touch->at(time_s); };
}

} // namespace

VirtualBoard simulatedBoard(const SampleSet& samples, const BoardDisturbance& disturbance, int rate_Hz,
                            std::uint64_t seed, std::shared_ptr<TouchHand> hand) {
  auto touch = touchOver(samples, std::move(hand));
  BoardSettings settings;
  settings.info.rowWires = samples.rowWires;
  settings.info.columnWires = samples.columnWires;
  settings.info.electrodesPerRowWire = samples.electrodesPerRowWire;
  settings.info.readout = samples.origin.readout;
  settings.info.serial = "SIMULATED";
  settings.info.model = "VIRTUAL";
  // The lowest bits, one a row-wire; a board with more row-wires than bits is refused by VirtualBoard.
  const int unused = std::clamp(kMostRowWires - samples.rowWires, 0, kMostRowWires - 1);
  settings.configuration.rowMask = ~std::uint32_t{0} >> unused;
  settings.configuration.rate_Hz = rate_Hz;
  settings.disturbance = disturbance;
  settings.seed = seed;
  return {settings, std::move(touch)};
}

} // namespace palp
