#include "app/study/live/ForceDecoder.h"

#include "app/study/decoding/CalibrationMark.h"
#include "tests/app/study/live/DecodedStream.h"
#include "tests/io/Refusal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

TEST(ForceDecoder, SaysThatTheBoardDoesNotScanItsRows) {
  VirtualBoard board = simulatedBoard(shippedSamples(), noisy(kGood), 1000, 3);
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

TEST(ForceDecoder, SaysThatANetworkDrownsInTheNoise) {
  TrainOptions options;
  options.input = InputKind::Resistance;
  options.rows = "4";
  options.decoder = DecoderKind::Rbf; // without noise, of one row: it follows every change of the readings
  VirtualStream stream = streamWith(noisy(kPlain));
  ForceDecoder deaf(trainDecoder(manySamples(20), nullptr, options), stream.board().info(), paperDesign());
  ForceDecoder good(decoderFor(kPlain), stream.board().info(), paperDesign());
  std::string said;
  bool doubted = false;
  stream.run(200, [&](const BoardFrame& frame) {
    said = deaf.decode(frame).doubt;
    doubted = doubted || good.decode(frame).doubt.find("alone") != std::string::npos;
  });
  EXPECT_NE(said.find("the noise of the readings alone gives"), std::string::npos) << said;
  EXPECT_FALSE(doubted);
}

TEST(ForceDecoder, AComponentThatNeverVariedInTheTrainingIsNotMeasured) {
  Decoder decoder = decoderFor(kPlain);
  decoder.low_N.head<2>().setZero();
  decoder.high_N.head<2>().setZero();
  VirtualStream stream = streamWith(noisy(kPlain));
  ForceDecoder live(decoder, stream.board().info(), paperDesign());
  stream.run(1, [&](const BoardFrame& frame) {
    const DecodedForces forces = live.decode(frame);
    EXPECT_FALSE(forces.measures(0, 0) || forces.measures(1, 0));
    EXPECT_TRUE(forces.measures(2, 0));
    const Eigen::Matrix3Xd kept_N = forces.measuredAlone(forces.forces_N);
    EXPECT_TRUE(std::isnan(kept_N(0, 0)) && std::isnan(kept_N(1, 0)));
    EXPECT_EQ(kept_N(2, 0), forces.forces_N(2, 0));
  });
}

TEST(ForceDecoder, WhatACalibrationLeftHidesNoForce) {
  Decoder calibrated = decoderFor(kGood);
  calibrated.trainedWith = withCalibrationMark(calibrated.trainedWith, 8);
  calibrated.residual_N = Eigen::Vector3d(0.1, 0.1, 0.5).replicate(1, calibrated.residual_N.cols());
  VirtualStream stream = streamWith(noisy(kGood));
  ForceDecoder plain(decoderFor(kGood), stream.board().info(), paperDesign());
  ForceDecoder live(calibrated, stream.board().info(), paperDesign());
  int shown = 0;
  stream.run(200, [&](const BoardFrame& frame) {
    const DecodedForces before = plain.decode(frame), after = live.decode(frame);
    EXPECT_EQ(after.shown, before.shown);
    EXPECT_GE(after.standardDeviation_N(2, 0), 0.5);
    shown += after.shown[0];
  });
  EXPECT_GT(shown, 50);
}

TEST(ForceDecoder, WarnsOutsideTheTrainingRange) {
  const SimulatedTouch touch(shippedSamples());
  const Eigen::MatrixXd hard = touch.resistances_ohm({2, {0, 0, -12}});
  BoardSettings settings;
  VirtualStream stream(VirtualBoard(settings, [&](double) -> const Eigen::MatrixXd& { return hard; }),
                       settings.configuration);
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
  Decoder grounded = decoderFor(kGood);
  grounded.readout = Readout::VirtualGround;
  BoardInfo floating;
  floating.readout = Readout::Floating;
  EXPECT_EQ(refusal([&] { ForceDecoder(grounded, floating); }),
            "the network was trained for read-out virtual_ground, the board is of read-out floating; train a network "
            "for this read-out");
  ForceDecoder(decoderFor(kGood), floating); // Eq. (1) has no read-out
  ForceDecoder(grounded, BoardInfo{});       // the board does not say its own
  floating.readout = Readout::VirtualGround;
  ForceDecoder(grounded, floating);
  Decoder unknown = decoderFor(kGood);
  unknown.designFingerprint = "0000000000000000";
  ForceDecoder decoder(unknown, BoardInfo{});
  EXPECT_NE(refusal([&] { decoder.startTare(10); }).find("give that design"), std::string::npos);
}

} // namespace
} // namespace palp
