// Tare, and what it does and does not remove: drift and hysteresis.

#include "app/study/live/ForceDecoder.h"

#include "tests/app/study/live/DecodedStream.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace palp {
namespace {

TEST(ForceDecoder, TareTakesAwayWhatABoardHasOfItsOwn) {
  BoardSettings settings;
  const SimulatedTouch touch(shippedSamples());
  const Eigen::MatrixXd factors = (Eigen::MatrixXd::Random(10, 30).array() * 0.02 + 1).matrix(); // 2 % by manufacture
  Eigen::MatrixXd now;
  settings.disturbance.noise = kGood;
  settings.info.serial = "RAW";
  VirtualStream stream(VirtualBoard(settings,
                                    [&](double time_s) -> const Eigen::MatrixXd& {
                                      now = touch.resistances_ohm(touch.truth(time_s)).cwiseProduct(factors);
                                      return now;
                                    }),
                       settings.configuration);
  ForceDecoder decoder(decoderFor(kGood), settings.info, paperDesign());
  decoder.startTare(40);
  double worst_N = 0;
  stream.run(100, [&](const BoardFrame& frame) {
    const DecodedForces forces = decoder.decode(frame);
    if (!decoder.tared() || !forces.valid) return;
    worst_N = std::max(worst_N, (forces.forces_N.col(0) - touch.truth(frame.time_s).force_N).norm());
  });
  EXPECT_TRUE(decoder.tared());
  EXPECT_NEAR(decoder.noise(), kGood, 0.05 * kGood); // of 12,000 readings: their rms is known to 0.7 %
  EXPECT_LT(worst_N, 0.05);                          // ten deviations; without tare it is hundreds of newtons
  decoder.clearTare();
  EXPECT_FALSE(decoder.tared());
}

TEST(ForceDecoder, TareRemovesTheConstantPartOfADrift) {
  BoardDisturbance drifting = noisy(kGood);
  drifting.warming_degC = 5;
  drifting.warmingTime_s = 1e-3; // warm from the first frame on: R is 0.5 % off
  VirtualStream stream = streamWith(drifting);
  ForceDecoder decoder(decoderFor(kGood), stream.board().info(), paperDesign());
  double off_N = 0, tared_N = 0;
  stream.run(20, [&](const BoardFrame& frame) { off_N = decoder.decode(frame).forces_N.norm(); });
  decoder.startTare(20);
  stream.run(25, [&](const BoardFrame& frame) { tared_N = decoder.decode(frame).forces_N.norm(); });
  EXPECT_GT(off_N, 1);
  EXPECT_LT(tared_N, 0.02); // a few deviations
}

TEST(ForceDecoder, TareWaitsUntilTheSensorIsAtRest) {
  VirtualStream stream = streamWith(noisy(kGood));
  ForceDecoder decoder(decoderFor(kGood), stream.board().info(), paperDesign());
  double rest_N = 0;
  const auto take = [&](const BoardFrame& frame) { rest_N = decoder.decode(frame).forces_N.norm(); };
  stream.run(60, take); // the press begins after 50 frames
  decoder.startTare(20);
  stream.run(30, take);
  EXPECT_TRUE(decoder.taring());
  EXPECT_FALSE(decoder.tared());
  stream.run(50, take); // and ends after 100
  EXPECT_EQ(decoder.tares(), 1);
  stream.run(8, take);
  EXPECT_LT(rest_N, 0.03); // some deviations
}

TEST(ForceDecoder, AWarmingBoardDriftsAwayFromItsTare) {
  BoardDisturbance warming = noisy(kGood);
  warming.warming_degC = 1;
  warming.warmingTime_s = 10;
  const SimulatedTouch touch(shippedSamples());
  BoardSettings settings;
  const Eigen::MatrixXd rest = touch.resistances_ohm({});
  settings.disturbance = warming;
  VirtualStream stream(VirtualBoard(settings, [&](double) -> const Eigen::MatrixXd& { return rest; }),
                       settings.configuration);
  ForceDecoder decoder(decoderFor(kGood), settings.info, paperDesign());
  decoder.startTare(5);
  double early_N = 0, late_N = 0;
  stream.run(15, [&](const BoardFrame& frame) { early_N = decoder.decode(frame).forces_N.norm(); });
  stream.run(600, [&](const BoardFrame& frame) { late_N = decoder.decode(frame).forces_N.norm(); });
  EXPECT_GT(late_N, 10 * early_N);
  decoder.startTare(20); // takes the drift so far away
  stream.run(21, [&](const BoardFrame& frame) { late_N = decoder.decode(frame).forces_N.norm(); });
  EXPECT_LT(late_N, 0.05);
}

/// Mean of Fz while the press comes, and while it goes: the same truth.
std::array<double, 2> comingAndGoing(const BoardDisturbance& disturbance) {
  VirtualStream stream = streamWith(disturbance);
  ForceDecoder decoder(decoderFor(kGood), stream.board().info(), paperDesign());
  std::array<double, 2> sum{}, count{};
  stream.run(600, [&](const BoardFrame& frame) {
    const double phase = std::fmod(frame.time_s / SimulatedTouch::kTouch_s, 1.0);
    if (phase < 0.6 || phase > 0.9) return;
    const std::size_t going = phase > 0.75 ? 1 : 0;
    sum[going] += decoder.decode(frame).forces_N(2, 0);
    ++count[going];
  });
  return {sum[0] / count[0], sum[1] / count[1]};
}

TEST(ForceDecoder, HysteresisLagsBehindTheTouch) {
  const std::array<double, 2> plain = comingAndGoing(noisy(kGood));
  BoardDisturbance lagging = noisy(kGood);
  lagging.hysteresisShare = 0.5;
  const std::array<double, 2> lag = comingAndGoing(lagging);
  // A press that goes still feels like more: the play gives way late.
  const double loop_N = (lag[0] - lag[1]) - (plain[0] - plain[1]);
  EXPECT_GT(loop_N, 0.05);
  EXPECT_LT(loop_N, 1);
}

} // namespace
} // namespace palp
