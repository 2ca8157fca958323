#include "app/study/decoding/BlockInversion.h"

#include "app/study/decoding/DecoderTraining.h"
#include "app/study/decoding/Prediction.h"
#include "app/study/decoding/TwoStep.h"
#include "app/study/paper/PaperProtocol.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/SignalComparison.h"
#include "app/study/touch/SampleGenerator.h"
#include "io/DecoderFile.h"
#include "model/DesignError.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "tests/app/study/decoding/PrintDecoderKind.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace palp {
namespace {

/// The paper's block with two areas and few electrodes, which all follow the rubber; read by virtual ground.
SensorDesign fieldDesign() {
  SensorDesign design = paperDesign();
  design.areas = {2, 1};
  design.upper.wire_mm = {6, 15, 24};
  design.upper.along_mm = {{6, 15, 24}};
  design.lower.wire_mm = {3, 9, 15, 21, 27};
  design.lowerFollowsRubber = true;
  FieldLaw law;
  law.readout = Readout::VirtualGround;
  design.resistance = law;
  return design;
}

SampleSet fieldSamples(int perArea, std::uint64_t seed) {
  SampleRequest request;
  request.perArea = perArea;
  request.seed = seed;
  request.surrogate = true;
  request.mesh.mapped = std::array<int, 3>{6, 6, 3};
  SampleGenerator generator(fieldDesign(), request);
  SampleSet set;
  generator.generate({0, generator.total()}, [&](const SampleSet& block) { append(set, block); });
  return set;
}

TEST(BlockInversion, GivesTheDisplacementsOfForcesSoSmallThatAllIsLinear) {
  const SensorDesign design = fieldDesign();
  StageLog stages;
  const auto response = AreaResponse::atRest(design, {}, 0, stages, {}, {});
  const FieldResponse field(design, *design.field(), *response, 0);
  const LogSensitivity slopes = field.logSensitivity(Readout::VirtualGround);
  const std::vector<ElectrodeResponse> electrodes = response->read(design, -1);
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(3, 5); // of ln R
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, 9);
  const Eigen::Vector3d forces_N[2]{{0.1, -0.05, -0.4}, {-0.08, 0.1, -0.2}}; // on both areas at once
  for (std::size_t area = 0; area < 2; ++area)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double force_N = forces_N[area](static_cast<Eigen::Index>(axis));
      change += force_N * slopes[area][axis];
      moved += force_N * electrodes[area].perNewton[axis].upper_mm;
    }
  const Eigen::MatrixXd read = field.resistances_ohm(Readout::VirtualGround).array() * change.array().exp();
  FitReport report;
  const BlockInversion all = blockInversion(design, {0, 1, 2}, 0, 0, {}, report);
  EXPECT_EQ(report.rank, 6); // three forces on each area
  EXPECT_GT(report.condition, 1);
  const Eigen::VectorXd rows = read.reshaped<Eigen::RowMajor>();
  // Readings without noise are taken as if they had 1e-6: the prior pulls the weakest direction by that.
  EXPECT_LT((all.displacements_mm(rows) - moved.reshaped()).norm(), 1e-3 * moved.norm());
  // One row-wire's five readings cannot tell six forces: the prior decides, and nothing explodes.
  const BlockInversion one = blockInversion(design, {1}, 1e-4, 0, {}, report);
  EXPECT_LT(report.rank, 6);
  EXPECT_LT(one.displacements_mm(read.row(1).transpose()).norm(), 2 * moved.norm());
}

/// Everything that palp offers learns the field; the inversion among it.
class DecoderOfTheField : public testing::TestWithParam<DecoderKind> {};

TEST_P(DecoderOfTheField, LearnsAndComesBackFromItsFile) {
  static const SampleSet training = fieldSamples(60, 1), fresh = fieldSamples(15, testSeed(1));
  const SensorDesign design = fieldDesign();
  TrainOptions options;
  options.decoder = GetParam();
  options.input = InputKind::Resistance;
  options.rows = "all";
  options.noise = 1e-5;
  const Decoder decoder = trainDecoder(training, &design, options);
  PredictOptions noisy;
  noisy.noise = 1e-5;
  const Prediction prediction = predict(decoder, fresh, noisy);
  const DecoderError error = decoderError(decoder, prediction, fresh);
  // Far from saying the mean (28.9 % of range), though fifteen readings are few.
  EXPECT_LT(error.error.rmsePercentOfRange.maxCoeff(), 15);
  EXPECT_TRUE(prediction.standardDeviation_N.allFinite());
  ASSERT_TRUE(error.rightAreas.has_value());
  EXPECT_GT(*error.rightAreas, 0.9);
  const Decoder again = parseNetwork(networkText(decoder), "decoder.json");
  EXPECT_EQ(predict(again, fresh, noisy).forces_N, prediction.forces_N);
}

INSTANTIATE_TEST_SUITE_P(Kinds, DecoderOfTheField, testing::ValuesIn(decodersWith(&DecoderTraits::ofAreas)),
                         [](const auto& one) {
                           std::string text = name(one.param);
                           std::erase(text, '-');
                           return text;
                         });

TEST(BlockInversion, SaysThatTheSamplesAreOfAnotherDesignAndRefusesWhatItCannotRead) {
  const SampleSet samples = fieldSamples(20, 1);
  SensorDesign other = fieldDesign();
  FieldLaw law = *other.field();
  law.electrodeRadius_mm = 0.3;
  other.resistance = law;
  TrainOptions options;
  options.decoder = DecoderKind::TwoStepGaussNewton;
  options.input = InputKind::Resistance;
  options.rows = "all";
  const auto warned = [&](const SensorDesign& design) {
    const auto warnings = trainDecoder(samples, &design, options).report.warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& text) { return text.find("of another design") != std::string::npos; });
  };
  EXPECT_TRUE(warned(other));
  EXPECT_FALSE(warned(fieldDesign()));
  other.pressureLaw = PressureLaw{};
  EXPECT_THROW(trainDecoder(samples, &other, options), DesignError);
  SensorDesign fewer = fieldDesign();
  fewer.lower.wire_mm.pop_back();
  EXPECT_THROW(trainDecoder(samples, &fewer, options), Error);
  const SensorDesign own = fieldDesign();
  const Decoder decoder = trainDecoder(samples, &own, options);
  EXPECT_THROW(displacementsOf(std::get<TwoStep>(decoder.model), Eigen::MatrixXd::Zero(15, 1)), Error);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(trainDecoder(samples, &own, options, source.get_token()), Cancelled);
}

} // namespace
} // namespace palp
