#include "app/study/live/drift/DriftMonitor.h"

#include "app/study/live/RestReference.h"
#include "model/RowColumnResistance.h"
#include "tests/app/study/live/LiveFixture.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr double kDriftNoise = 5e-6;

/// The drift after some frames of the demo's touch on a board that warms up by this much at once.
std::optional<double> driftOf(double warming_degC, std::uint64_t frames) {
  BoardDisturbance disturbance;
  disturbance.noise = kDriftNoise;
  disturbance.warming_degC = warming_degC;
  disturbance.warmingTime_s = 1e-3;
  VirtualBoard board = simulatedBoard(shippedSamples(), disturbance, 1000, 3);
  const BoardConfiguration configuration = board.configuration();
  VirtualStream stream(std::move(board), configuration);
  RestReference rest;
  rest.reset(SimulatedTouch(shippedSamples()).resistances_ohm({}));
  DriftMonitor monitor;
  stream.run(frames, [&](const BoardFrame& frame) {
    rest.add(frame);
    monitor.add(rest.change(frame), kDriftNoise, frame.time_s);
  });
  return monitor.drift();
}

TEST(DriftMonitor, MeasuresWhatWarmingDoesAndNoTouch) {
  // 0.1 % a degree; the median of 300 readings is known to 1.25 / sqrt(300) of their noise. The last 50 frames are a
  // press.
  EXPECT_NEAR(driftOf(0, 600).value(), 0, kDriftNoise);
  EXPECT_NEAR(driftOf(0.05, 600).value(), 5e-5, kDriftNoise);
  EXPECT_NEAR(driftOf(-1, 600).value(), -1e-3, 2 * kDriftNoise);
}

TEST(DriftMonitor, SaysNothingBeforeTheSensorWasSeenAtRest) {
  DriftMonitor monitor;
  monitor.add(Eigen::MatrixXd::Random(10, 30), kDriftNoise, 1);
  EXPECT_FALSE(monitor.drift());
  monitor.add(Eigen::MatrixXd::Constant(10, 30, 1e-4), kDriftNoise, 2);
  EXPECT_NEAR(monitor.drift().value(), 1e-4, 1e-12);
}

} // namespace
} // namespace palp
