#include "app/study/ForceDecoder.h"

#include "model/Error.h"
#include "tests/app/LiveFixture.h"
#include "tests/io/Refusal.h"

#include <gtest/gtest.h>

#include <map>

namespace palp {
namespace {

constexpr double kGood = 5e-6;
constexpr double kPlain = 1e-4;

const Decoder& decoderFor(double noise) {
  static std::map<double, Decoder> decoders;
  if (!decoders.contains(noise)) decoders.emplace(noise, liveDecoder(noise));
  return decoders.at(noise);
}

VirtualStream streamWith(const BoardDisturbance& disturbance, std::uint64_t seed = 3) {
  Board board = simulatedBoard(shippedSamples(), disturbance, 1000, seed);
  const BoardConfiguration configuration = board.configuration();
  return {std::move(board), configuration};
}

BoardDisturbance noisy(double noise) {
  BoardDisturbance disturbance;
  disturbance.noise = noise;
  return disturbance;
}

class ForceDecoderNoise : public testing::TestWithParam<double> {};

TEST_P(ForceDecoderNoise, ForcesStayWithinThreeDeviationsOfTheTruth) {
  VirtualStream stream = streamWith(noisy(GetParam()));
  ForceDecoder decoder(decoderFor(GetParam()), stream.board().info(), paperDesign());
  const SimulatedTouch touch(shippedSamples());
  Eigen::Array3i within = Eigen::Array3i::Zero();
  int frames = 0, pressed = 0, rightAreas = 0;
  stream.run(1200, [&](const BoardFrame& frame) { // each area is touched twice
    const DecodedForces forces = decoder.decode(frame);
    ASSERT_TRUE(forces.valid);
    const SimulatedTouch::Truth truth = touch.truth(frame.time_s);
    const Eigen::Array3d error = (forces.forces_N.col(0) - truth.force_N).array().abs();
    within += (error <= 3 * forces.standardDeviation_N.col(0).array()).cast<int>();
    ++frames;
    if (truth.force_N.norm() < 0.5) return;
    ++pressed;
    rightAreas += forces.area == truth.area;
  });
  for (int axis = 0; axis < 3; ++axis) EXPECT_GE(within(axis), 0.99 * frames) << axis;
  EXPECT_EQ(rightAreas, pressed);
}

INSTANTIATE_TEST_SUITE_P(GoodAndPlainBoard, ForceDecoderNoise, testing::Values(kGood, kPlain));

TEST(ForceDecoder, NoArrowAppearsAtRest) {
  BoardSettings settings;
  const SimulatedTouch touch(shippedSamples());
  const Eigen::MatrixXd rest = touch.resistances_ohm({});
  settings.disturbance.noise = kPlain;
  settings.info.serial = "REST";
  VirtualStream stream(Board(settings, [&](double) -> const Eigen::MatrixXd& { return rest; }), settings.configuration);
  ForceDecoder decoder(decoderFor(kPlain), settings.info, paperDesign());
  int shown = 0;
  stream.run(2000, [&](const BoardFrame& frame) { shown += decoder.decode(frame).shown[0]; });
  EXPECT_EQ(shown, 0);
}

TEST(ForceDecoder, TareTakesAwayWhatABoardHasOfItsOwn) {
  BoardSettings settings;
  const SimulatedTouch touch(shippedSamples());
  const Eigen::MatrixXd factors = (Eigen::MatrixXd::Random(10, 30).array() * 0.02 + 1).matrix(); // 2 % by manufacture
  Eigen::MatrixXd now;
  settings.disturbance.noise = kGood;
  settings.info.serial = "RAW";
  VirtualStream stream(Board(settings,
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

TEST(ForceDecoder, BadWiresGiveAReasonAndNoForces) {
  VirtualStream stream = streamWith(noisy(kGood));
  stream.board().faults().openColumns = {7};
  ForceDecoder decoder(decoderFor(kGood), stream.board().info(), paperDesign());
  stream.run(3, [&](const BoardFrame& frame) {
    const DecodedForces forces = decoder.decode(frame);
    EXPECT_FALSE(forces.valid);
    EXPECT_EQ(forces.reason, "column-wire 7: open");
    EXPECT_EQ(forces.forces_N.size(), 0);
  });
}

TEST(ForceDecoder, IncompleteFramesGiveAReasonAndNoForces) {
  VirtualStream stream = streamWith(noisy(kGood));
  stream.board().faults().dropEvery = 7;
  ForceDecoder decoder(decoderFor(kGood), stream.board().info(), paperDesign());
  stream.run(5, [&](const BoardFrame& frame) {
    const DecodedForces forces = decoder.decode(frame);
    EXPECT_EQ(forces.valid, frame.complete);
    EXPECT_EQ(forces.reason, frame.complete ? "" : "a report of the frame is lost");
  });
}

TEST(ForceDecoder, SaysThatTheBoardDoesNotScanItsRows) {
  Board board = simulatedBoard(shippedSamples(), noisy(kGood), 1000, 3);
  BoardConfiguration single = board.configuration();
  single.mode = BoardMode::SingleRow;
  single.rowMask = 1U << 4;
  ASSERT_TRUE(board.setFeature(encode(single)));
  const BoardConfiguration now = board.configuration();
  VirtualStream stream(std::move(board), now);
  ForceDecoder decoder(decoderFor(kGood), stream.board().info(), paperDesign());
  stream.run(2, [&](const BoardFrame& frame) {
    EXPECT_NE(decoder.decode(frame).reason.find("does not scan row-wire 0"), std::string::npos);
  });
}

TEST(ForceDecoder, WarnsOutsideTheTrainingRange) {
  const SimulatedTouch touch(shippedSamples());
  const Eigen::MatrixXd hard = touch.resistances_ohm({2, {0, 0, -12}});
  BoardSettings settings;
  VirtualStream stream(Board(settings, [&](double) -> const Eigen::MatrixXd& { return hard; }), settings.configuration);
  ForceDecoder decoder(decoderFor(kGood), settings.info, paperDesign());
  stream.run(1, [&](const BoardFrame& frame) { EXPECT_TRUE(decoder.decode(frame).outsideTrainingRange); });
}

TEST(ForceDecoder, RefusesABoardOrADesignThatIsNotTheNetworks) {
  BoardInfo other;
  other.columnWires = 29;
  EXPECT_NE(refusal([&] { ForceDecoder(decoderFor(kGood), other); }).find("10 row-wires x 29"), std::string::npos);
  SensorDesign design = paperDesign();
  design.block_mm.z() = 6;
  EXPECT_NE(refusal([&] { ForceDecoder(decoderFor(kGood), BoardInfo{}, design); }).find("given design"),
            std::string::npos);
  Decoder displacement = decoderFor(kGood);
  displacement.input.kind = InputKind::Displacement;
  EXPECT_NE(refusal([&] { ForceDecoder(displacement, BoardInfo{}); }).find("displacement"), std::string::npos);
  Decoder unknown = decoderFor(kGood);
  unknown.designFingerprint = "0000000000000000";
  ForceDecoder decoder(unknown, BoardInfo{});
  EXPECT_NE(refusal([&] { decoder.startTare(10); }).find("--design"), std::string::npos);
}

} // namespace
} // namespace palp
