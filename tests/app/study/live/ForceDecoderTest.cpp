#include "app/study/live/ForceDecoder.h"

#include "app/study/decoding/CalibrationMark.h"
#include "io/DecoderFile.h"
#include "tests/app/study/live/LiveFixture.h"
#include "tests/io/Refusal.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <ostream>

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
  VirtualBoard board = simulatedBoard(shippedSamples(), disturbance, 1000, seed);
  const BoardConfiguration configuration = board.configuration();
  return {std::move(board), configuration};
}

BoardDisturbance noisy(double noise) {
  BoardDisturbance disturbance;
  disturbance.noise = noise;
  return disturbance;
}

/// The network that ships with Palp; it was trained for a good board.
const Decoder& shippedDecoder() {
  static const Decoder decoder =
      readNetwork(std::filesystem::path(PALP_SOURCE_DIR) / "resources" / "board" / "paper-network.json");
  return decoder;
}

struct NoiseCase {
  const char* name;
  double noise;
  bool shipped; ///< else trained for this noise
  int tareFrames;
};
/// In the names of the tests.
void PrintTo(const NoiseCase& one, std::ostream* out) {
  *out << one.name;
}

std::string caseName(const testing::TestParamInfo<NoiseCase>& info) {
  return info.param.name;
}

class ForceDecoderNoise : public testing::TestWithParam<NoiseCase> {
protected:
  const Decoder& network() { return GetParam().shipped ? shippedDecoder() : decoderFor(GetParam().noise); }
};

TEST_P(ForceDecoderNoise, ForcesStayWithinThreeDeviationsOfTheTruth) {
  VirtualStream stream = streamWith(noisy(GetParam().noise));
  ForceDecoder decoder(network(), stream.board().info(), paperDesign());
  if (GetParam().tareFrames > 0) decoder.startTare(GetParam().tareFrames);
  const SimulatedTouch touch(shippedSamples());
  Eigen::Array3i within = Eigen::Array3i::Zero();
  int frames = 0, shown = 0, shownWithin = 0, pressed = 0, rightAreas = 0;
  stream.run(1200, [&](const BoardFrame& frame) { // each area is touched twice
    const DecodedForces forces = decoder.decode(frame);
    ASSERT_TRUE(forces.valid);
    if (decoder.taring()) return;
    const SimulatedTouch::Truth truth = touch.truth(frame.time_s);
    const Eigen::Array3d error = (forces.forces_N.col(0) - truth.force_N).array().abs();
    const Eigen::Array3i good = (error <= 3 * forces.standardDeviation_N.col(0).array()).cast<int>();
    within += good;
    ++frames;
    if (forces.shown[0]) {
      ++shown;
      shownWithin += good.minCoeff(); // all three at once
    }
    if (truth.force_N.norm() < 0.5) return;
    ++pressed;
    rightAreas += forces.area == truth.area;
  });
  for (int axis = 0; axis < 3; ++axis) EXPECT_GE(within(axis), 0.99 * frames) << axis;
  EXPECT_GT(shown, 300);
  // Of three normal errors at once 99.2 % stay within 3 deviations: 99 % less the chance of so few frames.
  EXPECT_GE(shownWithin, 0.985 * shown);
  EXPECT_EQ(rightAreas, pressed);
}

TEST_P(ForceDecoderNoise, NoArrowAppearsAtRest) {
  BoardSettings settings;
  const SimulatedTouch touch(shippedSamples());
  const Eigen::MatrixXd rest = touch.resistances_ohm({});
  settings.disturbance.noise = GetParam().noise;
  settings.info.serial = "REST";
  VirtualStream stream(VirtualBoard(settings, [&](double) -> const Eigen::MatrixXd& { return rest; }),
                       settings.configuration);
  ForceDecoder decoder(network(), settings.info, paperDesign());
  if (GetParam().tareFrames > 0) decoder.startTare(GetParam().tareFrames);
  int shown = 0;
  stream.run(10'000, [&](const BoardFrame& frame) { shown += decoder.decode(frame).shown[0]; });
  EXPECT_EQ(shown, 0);
  EXPECT_NEAR(decoder.noise(), GetParam().noise, 0.2 * GetParam().noise); // known to a few %, followed in steps of 10 %
}

INSTANTIATE_TEST_SUITE_P(GoodAndPlainBoard, ForceDecoderNoise,
                         testing::Values(NoiseCase{"GoodBoard", kGood, false, 0},
                                         NoiseCase{"GoodBoardTared", kGood, true, 50},
                                         NoiseCase{"PlainBoard", kPlain, false, 0},
                                         NoiseCase{"PlainBoardNetworkOfAGoodOne", kPlain, true, 0},
                                         NoiseCase{"PlainBoardTared", kPlain, true, 20}),
                         caseName);

TEST(ForceDecoder, AnRbfNetworkIsJudgedAtRestToo) {
  const Decoder decoder = liveDecoder(kPlain, DecoderKind::Rbf);
  VirtualStream stream = streamWith(noisy(kPlain));
  ForceDecoder live(decoder, stream.board().info(), paperDesign());
  const SimulatedTouch touch(shippedSamples());
  Eigen::Array3i within = Eigen::Array3i::Zero();
  int frames = 0, arrows = 0;
  stream.run(1200, [&](const BoardFrame& frame) {
    const DecodedForces forces = live.decode(frame);
    const SimulatedTouch::Truth truth = touch.truth(frame.time_s);
    if (truth.force_N.norm() > 0) return;
    const Eigen::Array3d error = (forces.forces_N.col(0) - truth.force_N).array().abs();
    within += (error <= 3 * forces.standardDeviation_N.col(0).array()).cast<int>();
    arrows += forces.shown[0];
    ++frames;
  });
  // It is drawn to the middle of its range by 0.3 N here; without that in the deviation 80 % stay within.
  for (int axis = 0; axis < 3; ++axis) EXPECT_GE(within(axis), 0.97 * frames) << axis;
  EXPECT_EQ(arrows, 0);
}

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

/// What one board with some readings missing and its whole twin, of the same noise, came to.
struct Missing {
  int frames = 0, within = 0, shown = 0, wrongArea = 0, doubted = 0, partial = 0;
  double rms_N = 0, wholeRms_N = 0; ///< of the errors
  double sd_N = 0, wholeSd_N = 0;   ///< rms of the stated deviations
};

Missing decodeWithout(const Decoder& network, const BoardFaults& faults, std::uint64_t seed, double noise,
                      std::uint64_t frames = 400) {
  VirtualStream broken = streamWith(noisy(noise), seed), whole = streamWith(noisy(noise), seed);
  broken.board().faults() = faults;
  ForceDecoder live(network, broken.board().info(), paperDesign());
  ForceDecoder twin(network, whole.board().info(), paperDesign());
  const SimulatedTouch touch(shippedSamples());
  Missing sum;
  const auto add = [&](const BoardFrame& frame, const DecodedForces& forces, double& rms_N, double& sd_N) {
    const SimulatedTouch::Truth truth = touch.truth(frame.time_s);
    const Eigen::Array3d error = (forces.forces_N.col(0) - truth.force_N).array().abs();
    rms_N += error.square().sum();
    sd_N += forces.standardDeviation_N.squaredNorm();
    return (error <= 3 * forces.standardDeviation_N.col(0).array()).all();
  };
  broken.run(frames, [&](const BoardFrame& frame) {
    const DecodedForces forces = live.decode(frame);
    EXPECT_TRUE(forces.valid) << forces.reason;
    if (!forces.valid) return;
    ++sum.frames;
    sum.partial += forces.missingReadings > 0;
    sum.within += add(frame, forces, sum.rms_N, sum.sd_N);
    sum.shown += forces.shown[0];
    sum.doubted += forces.doubted;
    sum.wrongArea += forces.shown[0] && forces.area != touch.truth(frame.time_s).area;
  });
  whole.run(frames, [&](const BoardFrame& frame) { add(frame, twin.decode(frame), sum.wholeRms_N, sum.wholeSd_N); });
  return sum;
}

struct MissingCase {
  const char* name;
  BoardFaults faults;
};
void PrintTo(const MissingCase& one, std::ostream* out) {
  *out << one.name;
}

class MissingReadings : public testing::TestWithParam<MissingCase> {};

/// Of three normal errors at once 99.2 % stay within three deviations.
void expectTruthWithin(const Missing& sum) {
  EXPECT_GT(sum.partial, 0);
  EXPECT_GE(sum.within, 0.97 * sum.frames);
  EXPECT_GT(sum.shown, 100);
  EXPECT_EQ(sum.wrongArea, 0);
  EXPECT_GE(sum.sd_N, sum.wholeSd_N) << "wider";
  EXPECT_LE(sum.doubted, 0.03 * sum.frames);
}

TEST_P(MissingReadings, WidenTheDeviationsOfAMaximumLikelihoodNetwork) {
  expectTruthWithin(decodeWithout(decoderFor(kPlain), GetParam().faults, 71, kPlain));
}

TEST_P(MissingReadings, WidenTheDeviationsOfAnRbfNetwork) {
  static const Decoder decoder = liveDecoder(kPlain, DecoderKind::Rbf);
  expectTruthWithin(decodeWithout(decoder, GetParam().faults, 72, kPlain));
}

BoardFaults openColumn(int column) {
  BoardFaults faults;
  faults.openColumns = {column};
  return faults;
}

BoardFaults openRow(int row) {
  BoardFaults faults;
  faults.openRows = {row};
  return faults;
}

BoardFaults lostReports(int every) {
  BoardFaults faults;
  faults.dropEvery = every;
  return faults;
}

INSTANTIATE_TEST_SUITE_P(OfABoard, MissingReadings,
                         testing::Values(MissingCase{"OneColumn", openColumn(7)}, MissingCase{"OneRow", openRow(4)},
                                         MissingCase{"EveryTwentiethReport", lostReports(20)},
                                         MissingCase{"EverySeventhReport", lostReports(7)}),
                         [](const auto& one) { return one.param.name; });

TEST(ForceDecoder, ATareHoldsWithoutAColumnToo) {
  VirtualStream stream = streamWith(noisy(kGood));
  stream.board().faults().openColumns = {7};
  ForceDecoder decoder(decoderFor(kGood), stream.board().info(), paperDesign());
  decoder.startTare(3);
  stream.run(4, [&](const BoardFrame& frame) { EXPECT_TRUE(decoder.decode(frame).valid); });
  ASSERT_TRUE(decoder.tared());
  EXPECT_LT(decoder.noise(), 10 * kGood);
  EXPECT_TRUE(decoder.tare().rest_ohm.allFinite());
}

TEST(ForceDecoder, LessThanHalfOfTheReadingsGiveAReasonAndNoForces) {
  VirtualStream stream = streamWith(noisy(kGood));
  stream.board().faults().openRows = {0, 1, 2, 3, 4, 5};
  ForceDecoder decoder(decoderFor(kGood), stream.board().info(), paperDesign());
  stream.run(3, [&](const BoardFrame& frame) {
    const DecodedForces forces = decoder.decode(frame);
    EXPECT_FALSE(forces.valid);
    EXPECT_EQ(forces.reason.rfind("row-wire 0: open", 0), 0U) << forces.reason;
    EXPECT_EQ(forces.forces_N.size(), 0);
  });
}

TEST(ForceDecoder, ANetworkWithoutAModelOfItsReadingsNeedsThemAll) {
  Decoder decoder = liveDecoder(kPlain, DecoderKind::Linear);
  decoder.areas.reset();
  decoder.areaOfClass.clear();
  VirtualStream stream = streamWith(noisy(kPlain));
  stream.board().faults().openColumns = {7};
  ForceDecoder live(decoder, stream.board().info(), paperDesign());
  stream.run(3, [&](const BoardFrame& frame) {
    const DecodedForces forces = live.decode(frame);
    EXPECT_FALSE(forces.valid);
    EXPECT_EQ(forces.reason, "column-wire 7: open");
  });
}

TEST(ForceDecoder, ANetworkOfOtherRowWiresReadsABoardWithABrokenOne) {
  TrainOptions options;
  options.input = InputKind::Resistance;
  options.rows = "0,1,2,4,5,6,7,8,9";
  options.noise = kGood;
  options.decoder = DecoderKind::MaximumLikelihood;
  VirtualStream whole = streamWith(noisy(kGood)), broken = streamWith(noisy(kGood));
  broken.board().faults().openRows = {3};
  const Decoder without3 = trainDecoder(manySamples(30), nullptr, options);
  ForceDecoder onWhole(without3, whole.board().info(), paperDesign());
  ForceDecoder onBroken(without3, broken.board().info(), paperDesign());
  ForceDecoder ofAll(decoderFor(kGood), broken.board().info(), paperDesign());
  std::vector<Eigen::Vector3d> truth_N;
  whole.run(120, [&](const BoardFrame& frame) { truth_N.push_back(onWhole.decode(frame).forces_N.col(0)); });
  std::size_t k = 0;
  double most_N = 0;
  broken.run(120, [&](const BoardFrame& frame) {
    EXPECT_EQ(ofAll.decode(frame).missingReadings, 30);
    const DecodedForces forces = onBroken.decode(frame);
    ASSERT_TRUE(forces.valid) << forces.reason;
    most_N = std::max(most_N, forces.forces_N.norm());
    // The same touch with other noise: within a few of its deviations.
    EXPECT_LT((forces.forces_N.col(0) - truth_N.at(k++)).norm(), 0.05 + 6 * forces.standardDeviation_N.maxCoeff());
  });
  EXPECT_GT(most_N, 0.5) << "nothing pressed";
}

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
  EXPECT_NE(said.find("the noise of the readings alone reads as"), std::string::npos) << said;
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
  EXPECT_EQ(
      refusal([&] { ForceDecoder(grounded, floating); }),
      "the network was trained for read-out virtual_ground, the board is of read-out floating: train one for that");
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
