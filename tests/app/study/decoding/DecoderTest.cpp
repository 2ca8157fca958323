#include "app/study/decoding/Prediction.h"

#include "app/study/decoding/DecoderTraining.h"
#include "app/study/decoding/NoiseBound.h"
#include "app/study/decoding/TwoStep.h"
#include "io/DecoderFile.h"
#include "model/RowColumnResistance.h"
#include "model/base/Error.h"
#include "tests/app/study/decoding/PrintDecoderKind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

namespace palp {

namespace {

/// Samples of the paper's design under a smooth stand-in for the block: each area moves the electrodes around it.
SampleSet standIn(int perArea, std::uint64_t seed) {
  const SensorDesign design = paperDesign();
  const Eigen::Matrix3Xd electrodes = design.upperElectrodes_mm();
  const int samples = 6 * perArea;
  SampleSet set;
  set.origin.designFingerprint = "stand-in";
  set.rowWires = design.rowWires();
  set.electrodesPerRowWire = design.electrodesPerRowWire();
  set.columnWires = design.columnWires();
  set.areaCount = 6;
  set.area.resize(samples);
  set.forces_N.resize(3, samples);
  set.displacements_mm.resize(electrodes.size(), samples);
  set.resistances_ohm.resize(static_cast<Eigen::Index>(set.rowWires) * set.columnWires, samples);
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  for (int i = 0; i < samples; ++i) {
    set.area(i) = i % 6;
    const Eigen::Vector3d force(2 * uniform() - 1, 2 * uniform() - 1, -6 * uniform());
    set.forces_N.col(i) = force;
    const Rectangle area = design.areaRectangle(i % 6);
    const Eigen::Vector2d middle = (area.low_mm + area.high_mm) / 2;
    ElectrodeDisplacements state = ElectrodeDisplacements::atRest(design);
    for (Eigen::Index e = 0; e < electrodes.cols(); ++e) {
      const Eigen::Vector2d away = (electrodes.col(e).head<2>() - middle) / 8;
      const double near = std::exp(-away.squaredNorm());
      state.upper_mm.col(e) = 0.015 * near * (force + 0.02 * force.cwiseProduct(force));
      state.upper_mm.col(e).head<2>() -= 0.008 * near * force.z() * away;
    }
    set.displacements_mm.col(i) = state.upper_mm.reshaped();
    const Eigen::MatrixXd resistances = rowColumnResistances(design, state);
    set.resistances_ohm.col(i) = resistances.transpose().reshaped();
  }
  return set;
}

class DecoderOf : public testing::TestWithParam<DecoderKind> {};

TEST_P(DecoderOf, LearnsFilesAndTellsTheArea) {
  const SensorDesign design = paperDesign();
  const SampleSet training = standIn(50, 1), fresh = standIn(10, 2);
  TrainOptions options;
  options.decoder = GetParam();
  options.input = InputKind::Resistance;
  options.rows = "2,7"; // one row-wire cannot tell the stand-in's areas of one column apart
  const Decoder decoder = trainDecoder(training, &design, options);
  const Prediction prediction = predict(decoder, fresh);
  const DecoderError error = decoderError(decoder, prediction, fresh);
  // Every way beats knowing nothing (28.9 % of range) by far on samples without noise.
  EXPECT_LT(error.error.rmsePercentOfRange.maxCoeff(), 5);
  EXPECT_TRUE(prediction.standardDeviation_N.allFinite());
  ASSERT_TRUE(error.rightAreas.has_value());
  EXPECT_GT(*error.rightAreas, 0.95);
  const Decoder again = parseNetwork(networkText(decoder), "decoder.json");
  EXPECT_EQ(predict(again, fresh).forces_N, prediction.forces_N);
}

INSTANTIATE_TEST_SUITE_P(Kinds, DecoderOf, testing::ValuesIn(decodersWith(&DecoderTraits::ofAreas)),
                         [](const auto& one) {
                           std::string text = name(one.param);
                           std::erase(text, '-');
                           return text;
                         });

TEST_P(DecoderOf, RefusesReadingsThatDoNotVary) {
  const SensorDesign design = paperDesign();
  TrainOptions options;
  options.decoder = GetParam();
  options.input = InputKind::Resistance;
  options.rows = "all";
  SampleSet stuck = standIn(4, 1);
  stuck.resistances_ohm = stuck.resistances_ohm.col(0).replicate(1, stuck.size()).eval();
  for (const SampleSet& set : {stuck, samplesAt(standIn(4, 1), {0})}) {
    try {
      (void)trainDecoder(set, &design, options);
      ADD_FAILURE() << "trained on " << set.size();
    } catch (const Error& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("the readings do not vary"), std::string::npos) << refusal.what();
    }
  }
}

TEST(Decoder, NamesAReadingThatStaysTheSameWhenItLearnsAndWhenItReads) {
  SampleSet set = standIn(10, 1);
  set.resistances_ohm.row(3 * set.columnWires + 5).setConstant(1e9);
  TrainOptions options;
  options.decoder = DecoderKind::Linear;
  options.input = InputKind::Resistance;
  options.rows = "2,3";
  const Decoder decoder = trainDecoder(set, nullptr, options);
  const auto named = [](const std::vector<std::string>& warnings) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& words) { return words.starts_with("reading R_r3_c5 (1e+09 ohm)"); });
  };
  EXPECT_TRUE(named(decoder.report.warnings));
  EXPECT_TRUE(named(predict(decoder, set).warnings));
  EXPECT_FALSE(named(predict(decoder, standIn(10, 2)).warnings));
}

TEST(Decoder, AnInputFarFromTheTrainingRangeIsFlagged) {
  const SampleSet training = standIn(20, 1);
  const Decoder decoder = trainDecoder(training, nullptr, {});
  Eigen::MatrixXd inputs = inputsOf(training, decoder.input);
  inputs(3, 1) += decoder.input.high(3) - decoder.input.low(3) + 1;
  const Prediction prediction = predict(decoder, inputs);
  EXPECT_FALSE(prediction.outsideTrainingRange[0]);
  EXPECT_TRUE(prediction.outsideTrainingRange[1]);
}

TEST(Decoder, RowsAreNamedAndRefusedWithWhatIsAllowed) {
  EXPECT_EQ(rowsNamed("7,1,4,1", 10), (std::vector<int>{1, 4, 7}));
  EXPECT_EQ(rowsNamed("all", 3), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(rowsNamed("0-2,4,8-9", 10), (std::vector<int>{0, 1, 2, 4, 8, 9}));
  EXPECT_EQ(rowsNamed("3-3", 10), std::vector<int>{3});
  for (const char* wrong : {"", "10", "-1", "1,", "four", "1;2", "5-3", "3-10", "2-", "-", "1-2-3"})
    EXPECT_THROW(rowsNamed(wrong, 10), Error) << wrong;
}

TEST(TwoStep, GaussNewtonInvertsEquationOne) {
  const SampleSet set = standIn(2, 3);
  const Inversion inversion = invertRowResistances(paperDesign(), 4, set.resistances_ohm.middleRows(4 * 30, 30));
  EXPECT_EQ(inversion.rank, 30);
  EXPECT_GT(inversion.condition, 1e5); // the paper's layout: 2.1e6
  // R to 1e-13 and a condition of 2e6: 1e-6 mm of displacements up to 0.1 mm are left.
  EXPECT_LT((inversion.displacements_mm - set.displacements_mm.middleRows(4 * 30, 30)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(TwoStep, RefusesALayoutThatIsNotSquare) {
  SensorDesign design = paperDesign();
  design.lower.wire_mm.pop_back();
  EXPECT_THROW(invertRowResistances(design, 4, Eigen::MatrixXd::Ones(29, 1)), Error);
}

TEST(NoiseBound, ThePriorOnlyHelpsAndTheBoundGrowsWithTheNoise) {
  const SampleSet set = standIn(50, 1);
  const NoiseBound small = noiseBound(set, InputKind::Resistance, {4}, 1e-7);
  const NoiseBound large = noiseBound(set, InputKind::Resistance, {4}, 1e-6);
  // Without prior the bound is proportional to the noise.
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(large.withoutPriorPercent(d) / small.withoutPriorPercent(d), 10, 1e-6);
    EXPECT_LE(large.withPriorPercent(d), large.withoutPriorPercent(d));
    EXPECT_LT(noiseBound(set, InputKind::Resistance, {4}, 0.5).withPriorPercent(d), 28.9);
  }
}

} // namespace
} // namespace palp
