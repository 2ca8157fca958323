// Noise of the readings: deviations hold it, and nothing is shown at rest.

#include "app/study/live/ForceDecoder.h"

#include "io/DecoderFile.h"
#include "tests/app/study/live/DecodedStream.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <ostream>

namespace palp {
namespace {

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

} // namespace
} // namespace palp
