#include "app/study/decoding/Calibration.h"

#include "app/study/decoding/CalibrationMark.h"
#include "app/study/decoding/DecoderTraining.h"
#include "io/DecoderFile.h"
#include "io/SampleFile.h"
#include "nn/linear/RandomNumbers.h"
#include "tests/app/study/live/LiveFixture.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

/// An RBF network that is quick to train: few samples, spread and ridge given.
const Decoder& quickNetwork() {
  static const Decoder decoder = [] {
    TrainOptions options;
    options.input = InputKind::Resistance;
    options.rows = "4";
    options.spread = 2;
    options.ridge = 1e-6;
    return trainDecoder(manySamples(20), nullptr, options);
  }();
  return decoder;
}

/// Frames of a board whose rubber is 10 % stiffer and whose rig reads 0.1 N too much.
SampleSet frames(int perArea) {
  SampleSet set = manySamples(perArea);
  set.origin.mesh = "measured on a board";
  set.forces_N *= 1.1;
  set.forces_N.row(2).array() += 0.1;
  return set;
}

TEST(Calibration, FindsGainAndOffsetOfTheRealBoard) {
  const Calibration result = calibrate(quickNetwork(), frames(10));
  const CalibrationReport& report = result.report;
  EXPECT_EQ(report.samples, 60);
  EXPECT_EQ(report.samplesPerArea, std::vector<int>(6, 10));
  EXPECT_TRUE(report.improved);
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(report.rmseAfter_N(axis), 0.5 * report.rmseBefore_N(axis)) << axis;
  EXPECT_GE(report.worstError_N, report.rmseAfter_N.maxCoeff());
}

TEST(Calibration, TheRefinedNetworkSaysWhatTheFitSaid) {
  const SampleSet labelled = frames(10);
  const Calibration result = calibrate(quickNetwork(), labelled);
  const Prediction prediction = predict(result.decoder, inputsOf(labelled, result.decoder.input));
  const Eigen::Vector3d rms_N = ((prediction.forces_N - labelled.forces_N).rowwise().squaredNorm() / 60.0).cwiseSqrt();
  for (int axis = 0; axis < 3; ++axis) EXPECT_LE(rms_N(axis), 1.001 * result.report.rmseAfter_N(axis)); // seen: better
}

TEST(Calibration, RefinesMaximumLikelihoodToo) {
  const Decoder decoder = liveDecoder(5e-6);
  const SampleSet labelled = frames(10);
  const Calibration result = calibrate(decoder, labelled);
  EXPECT_TRUE(result.report.improved);
  const Eigen::MatrixXd inputs = inputsOf(labelled, decoder.input);
  const Eigen::MatrixXd before_N = predict(decoder, inputs).forces_N;
  const Eigen::MatrixXd after_N = predict(result.decoder, inputs).forces_N;
  // The labels are 1.1 times what the network says, 0.1 N off in z.
  const double before = (before_N - labelled.forces_N).norm(), after = (after_N - labelled.forces_N).norm();
  EXPECT_LT(after, 0.05 * before);
  EXPECT_EQ(predict(result.decoder, inputs).area, labelled.area);
}

/// Share of the frames' forces that lie within three deviations, all components together.
double withinThree(const Prediction& prediction, const SampleSet& frames) {
  const Eigen::ArrayXXd off = (prediction.forces_N - frames.forces_N).array().abs();
  return static_cast<double>((off <= 3 * prediction.standardDeviation_N.array()).count()) /
         static_cast<double>(off.size());
}

TEST(Calibration, TheDeviationHoldsWhatItLeft) {
  const Decoder decoder = liveDecoder(5e-6);
  SampleSet labelled = frames(10);
  RandomNumbers random(3);
  for (double& force_N : labelled.forces_N.reshaped()) force_N += 0.3 * (2 * random.uniform() - 1); // poor weights
  const Calibration result = calibrate(decoder, labelled);
  EXPECT_EQ(calibrationFrames(result.decoder), 60);
  const Eigen::MatrixXd inputs = inputsOf(labelled, decoder.input);
  const Prediction before = predict(decoder, inputs), after = predict(result.decoder, inputs);
  EXPECT_TRUE((after.standardDeviation_N.array() >= result.report.rmseAfter_N.replicate(1, 60).array()).all());
  EXPECT_LT(withinThree(before, labelled), 0.5) << "noise alone";
  EXPECT_GT(withinThree(after, labelled), 0.98);
  EXPECT_EQ(calibrationFrames(parseNetwork(networkText(result.decoder), "net.json")), 60);
}

TEST(Calibration, SaysThatALabelDoesNotBelongToItsFrame) {
  const Decoder decoder = liveDecoder(5e-6);
  SampleSet good = manySamples(10);
  good.origin.mesh = "measured on a board";
  const CalibrationReport right = calibrate(decoder, frames(10)).report;
  EXPECT_TRUE(warningsOf(right).empty()) << warningsOf(right)[0];
  EXPECT_LT(right.modelMismatch.value(), 0.2); // the labels are 10 % off
  SampleSet mixed = good;                      // each frame under the label of another
  for (Eigen::Index i = 0; i < mixed.size(); ++i) {
    mixed.forces_N.col(i) = good.forces_N.col((i + 17) % mixed.size());
    mixed.area(i) = good.area((i + 17) % mixed.size());
  }
  const CalibrationReport wrong = calibrate(decoder, mixed).report;
  EXPECT_GT(wrong.modelMismatch.value(), 0.5);
  std::string all;
  for (const std::string& warning : warningsOf(wrong)) all += warning + "; ";
  EXPECT_NE(all.find("the model under these labels"), std::string::npos) << all;
  EXPECT_NE(all.find("of their change apart"), std::string::npos) << all;
}

TEST(Calibration, SaysThatTheLabelsHaveTheOppositeSign) {
  EXPECT_EQ(calibrate(quickNetwork(), frames(10)).report.opposed, "");
  SampleSet turned = frames(10);
  turned.forces_N.row(2) *= -1; // as a load cell gives a push
  const CalibrationReport report = calibrate(quickNetwork(), turned).report;
  EXPECT_EQ(report.opposed, "z");
  EXPECT_NE(warningsOf(report).front().find("opposite sign of Fz"), std::string::npos) << warningsOf(report).front();
}

TEST(Calibration, RefusesWhatItCannotUse) {
  EXPECT_NE(refusal([] { calibrate(quickNetwork(), frames(1)); }).find("6 labelled frames"), std::string::npos);
  SampleSet other = frames(10);
  other.origin.designFingerprint = "0000000000000000";
  EXPECT_NE(refusal([&] { calibrate(quickNetwork(), other); }).find("design"), std::string::npos);
  Decoder linear = liveDecoder(5e-6, DecoderKind::Linear);
  EXPECT_NE(refusal([&] { calibrate(linear, frames(10)); }).find("rbf, ml or touch"), std::string::npos);
}

TEST(Calibration, AveragedFramesGoIntoOneFile) {
  const TemporaryFolder folder;
  DecodedForces forces;
  forces.valid = true;
  for (int area = 0; area < 3; ++area) {
    FrameAverage average(quickNetwork(), paperDesign(), {{area, {0, 0, -1.0 * area}}});
    for (const double value : {300.0, 302.0}) {
      forces.resistances_ohm = Eigen::MatrixXd::Constant(10, 30, value);
      average.add(forces);
    }
    EXPECT_EQ(average.count(), 2);
    appendFrames(folder / "frames.csv", average.sample());
  }
  const SampleSet all = loadSamples(folder / "frames.csv");
  EXPECT_EQ(all.area, Eigen::Vector3i(0, 1, 2));
  EXPECT_EQ(all.forces_N(2, 2), -2);
  EXPECT_TRUE((all.resistances_ohm.array() == 301).all());
  DecodedForces bad;
  FrameAverage none(quickNetwork(), paperDesign(), {{0, {0, 0, -1}}});
  none.add(bad); // frames that are not valid do not count
  EXPECT_EQ(none.count(), 0);
}

} // namespace
} // namespace palp
