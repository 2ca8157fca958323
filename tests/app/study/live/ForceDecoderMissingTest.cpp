// Readings that are missing: an open wire, lost reports.

#include "app/study/live/ForceDecoder.h"

#include "tests/app/study/live/DecodedStream.h"

#include <gtest/gtest.h>

#include <limits>
#include <ostream>

namespace palp {
namespace {

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

TEST(ForceDecoder, AFrameThatDoesNotDetermineTheForceHasAReasonAndEndsNothing) {
  VirtualStream stream = streamWith(noisy(kGood));
  stream.board().faults().openColumns = {7};
  Decoder network = liveDecoder(kGood, DecoderKind::Rbf);
  for (Eigen::MatrixXd& ofArea : network.areas.value().coefficients)
    ofArea.col(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  ForceDecoder decoder(network, stream.board().info(), paperDesign());
  int frames = 0;
  stream.run(3, [&](const BoardFrame& frame) {
    const DecodedForces forces = decoder.decode(frame);
    EXPECT_FALSE(forces.valid);
    EXPECT_NE(forces.reason.find("do not determine the force"), std::string::npos) << forces.reason;
    ++frames;
  });
  EXPECT_EQ(frames, 3);
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

} // namespace
} // namespace palp
