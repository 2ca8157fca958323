#include "app/study/decoding/Calibration.h"
#include "app/study/decoding/CalibrationMark.h"
#include "app/study/decoding/DecoderTraining.h"
#include "app/study/decoding/Prediction.h"
#include "app/study/decoding/measured/MeasuredWords.h"
#include "app/study/decoding/measured/SampleSplit.h"
#include "app/study/live/ForceDecoder.h"
#include "io/DecoderFile.h"
#include "model/base/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace palp {

namespace {

/// Two readings of a slow sensor under a pressing force and a shear, 20 rows per second; measured by another rig.
SampleSet measuredSamples(Eigen::Index count, unsigned seed) {
  SampleSet set;
  set.origin.designFingerprint = "measured-0123456789abcdef";
  set.origin.mesh = std::string(kImportedFrom) + "rig.csv";
  set.rowWires = 1;
  set.electrodesPerRowWire = 1;
  set.columnWires = 2;
  set.areaCount = 1;
  set.area = Eigen::VectorXi::Zero(count);
  set.times_s.resize(1, count);
  set.forces_N.setZero(3, count);
  set.resistances_ohm.resize(2, count);
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> level(0, 5);
  std::normal_distribution<double> noise(0, 0.3);
  double pressed = 0, target = level(engine), state = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (i % 40 == 0) target = level(engine);
    pressed += std::clamp(target - pressed, -0.3, 0.3);
    state += (pressed - state) * (1 - std::exp(-0.05 / 2));
    const double shear = std::sin(0.11 * static_cast<double>(i));
    set.times_s(0, i) = 0.05 * static_cast<double>(i);
    set.forces_N.col(i) << shear, 0, -pressed;
    const double both = 10 * pressed + 20 * state;
    set.resistances_ohm.col(i) << 200 + both + 8 * shear + noise(engine), 200 + both - 8 * shear + noise(engine);
  }
  for (const auto part : {&SampleSet::runs, &SampleSet::touches, &SampleSet::places_mm, &SampleSet::secondTouch,
                          &SampleSet::displacements_mm})
    (set.*part).resize(0, count);
  return set;
}

TrainOptions ofResistances() {
  TrainOptions options;
  options.input = InputKind::Resistance;
  options.rows = "all";
  return options;
}

TEST(MeasuredTraining, StatesTheErrorOfLaterRowsAndKeepsItsMemoryInTheFile) {
  const SampleSet train = measuredSamples(3000, 1), later = measuredSamples(1500, 2);
  const Decoder decoder = trainDecoder(train, nullptr, ofResistances());
  ASSERT_TRUE(decoder.measured);
  EXPECT_EQ(decoder.measured->dependence.order, RowOrder::Time);
  EXPECT_TRUE(decoder.measured->stage.hasMemory());
  const Decoder read = parseNetwork(networkText(decoder), "network.json");
  const Prediction before = predict(decoder, later), after = predict(read, later);
  EXPECT_EQ(before.forces_N, after.forces_N);
  EXPECT_EQ(before.standardDeviation_N, after.standardDeviation_N);
  EXPECT_EQ(before.outsideTrainingRange, after.outsideTrainingRange);
  const Eigen::MatrixXd error = before.forces_N - later.forces_N;
  for (const Eigen::Index axis : {0, 2}) {
    const double met = std::sqrt(error.row(axis).array().square().mean());
    EXPECT_LT(met, 1.6 * decoder.measured->stated(axis)) << axis;
    EXPECT_GT(met, decoder.measured->stated(axis) / 2) << axis;
  }
  const std::vector<std::string> sentences = measuredSentences(decoder, 3000, true);
  EXPECT_LE(sentences.size(), 10u);
  EXPECT_NE(sentences.front().find("five stretches"), std::string::npos);
}

TEST(MeasuredTraining, AMemoryNeedsTimesInOrder) {
  const Decoder decoder = trainDecoder(measuredSamples(3000, 1), nullptr, ofResistances());
  SampleSet later = measuredSamples(50, 2);
  std::swap(later.times_s(0, 20), later.times_s(0, 21));
  EXPECT_THROW(static_cast<void>(predict(decoder, later)), Error);
  later.times_s.resize(0, 50);
  EXPECT_THROW(static_cast<void>(predict(decoder, later)), Error);
  EXPECT_EQ(predict(decoder, inputsOf(later, decoder.input)).forces_N.cols(), 50) << "held readings need no time";
}

TEST(MeasuredTraining, RowsAsTheClockNeedNoTimesInTrainingPredictionOrFile) {
  SampleSet train = measuredSamples(3000, 1), later = measuredSamples(500, 2);
  const Eigen::MatrixXd byTime_N = predict(trainDecoder(train, nullptr, ofResistances()), later).forces_N;
  train.times_s.resize(0, 3000);
  later.times_s.resize(0, 500);
  TrainOptions options = ofResistances();
  options.clock = MemoryClock::Rows;
  const Decoder decoder = trainDecoder(train, nullptr, options);
  ASSERT_TRUE(decoder.measured->stage.hasMemory());
  const Decoder read = parseNetwork(networkText(decoder), "network.json");
  EXPECT_TRUE(read.measured->stage.rowsAreClock);
  EXPECT_EQ(predict(read, later).forces_N, predict(decoder, later).forces_N);
  EXPECT_LT((predict(decoder, later).forces_N - byTime_N).cwiseAbs().maxCoeff(), 1e-6) << "as by equal times";
  EXPECT_NE(measuredSentences(decoder, 3000, false)[1].find(" rows"), std::string::npos);
}

TEST(MeasuredTraining, NoisyInputsOfASetKeepItsMemory) {
  const Decoder decoder = trainDecoder(measuredSamples(3000, 1), nullptr, ofResistances());
  const SampleSet later = measuredSamples(200, 2);
  EXPECT_EQ(predict(decoder, later, inputsOf(later, decoder.input), {}).forces_N, predict(decoder, later).forces_N);
}

TEST(MeasuredTraining, LiveForcesAreThoseOfTheSamplesInOrder) {
  const Decoder decoder = trainDecoder(measuredSamples(3000, 1), nullptr, ofResistances());
  const SampleSet later = measuredSamples(200, 2);
  const Eigen::MatrixXd expected_N = predict(decoder, later).forces_N;
  BoardInfo info;
  info.rowWires = 1;
  info.columnWires = 2;
  ForceDecoder live(decoder, info);
  for (Eigen::Index i = 0; i < later.size(); ++i) {
    BoardFrame frame;
    frame.time_s = later.times_s(0, i);
    frame.rowExpected = {true};
    frame.resistances_ohm = later.resistances_ohm.col(i).transpose();
    frame.state.setConstant(1, 2, ReadingState::Good);
    frame.complete = true;
    const DecodedForces forces = live.decode(frame);
    ASSERT_TRUE(forces.valid) << forces.reason;
    ASSERT_LT((forces.forces_N.col(0) - expected_N.col(i)).norm(), 1e-9) << i;
  }
}

/// The limits of predictions are those of the training; a board whose forces are 1.5 times as large has its own.
TEST(MeasuredTraining, ACalibratedNetworkReachesTheForcesOfItsBoard) {
  const Decoder decoder = trainDecoder(measuredSamples(3000, 1), nullptr, ofResistances());
  SampleSet frames = measuredSamples(400, 2);
  frames.forces_N *= 1.5;
  const Calibration calibration = calibrate(decoder, frames);
  EXPECT_TRUE(calibration.report.improved);
  const Decoder read = parseNetwork(networkText(calibration.decoder), "network.json");
  EXPECT_TRUE(calibrated(read));
  const Prediction after = predict(read, frames);
  EXPECT_LT(after.forces_N.row(2).minCoeff(), 1.3 * decoder.low_N(2));
  const Eigen::MatrixXd error_N = after.forces_N - frames.forces_N;
  EXPECT_LT(std::sqrt(error_N.row(2).array().square().mean()), 1.05 * calibration.report.rmseAfter_N(2));
  EXPECT_EQ(after.outsideTrainingRange, predict(decoder, frames).outsideTrainingRange);
  EXPECT_TRUE((after.standardDeviation_N.row(2).array() >= calibration.report.rmseAfter_N(2)).all());
}

TEST(MeasuredTraining, OptionsOverruleTheChoice) {
  const SampleSet train = measuredSamples(1000, 1);
  TrainOptions options = ofResistances();
  options.memory = "none";
  options.order = RowOrder::Independent;
  options.transform = ReadingTransform::Logarithm;
  const Decoder decoder = trainDecoder(train, nullptr, options);
  EXPECT_FALSE(decoder.measured->stage.hasMemory());
  EXPECT_EQ(decoder.measured->stage.transform, ReadingTransform::Logarithm);
  EXPECT_EQ(decoder.measured->dependence.order, RowOrder::Independent);
  options.memory = "1,x";
  EXPECT_THROW(static_cast<void>(trainDecoder(train, nullptr, options)), Error);
  options = ofResistances();
  options.noise = 1e-3;
  EXPECT_FALSE(trainDecoder(train, nullptr, options).measured) << "noise is trained for as before";
}

TEST(MeasuredTraining, OtherDecodersStateTheErrorOfLaterRowsToo) {
  const SampleSet train = measuredSamples(1000, 1), later = measuredSamples(1500, 2);
  for (const DecoderKind kind : {DecoderKind::Linear, DecoderKind::Polynomial2}) {
    TrainOptions options = ofResistances();
    options.decoder = kind;
    const Decoder decoder = trainDecoder(train, nullptr, options);
    EXPECT_NE(decoder.report.leftOut.find("five stretches"), std::string::npos);
    const double met = std::sqrt((predict(decoder, later).forces_N - later.forces_N).row(2).array().square().mean());
    EXPECT_LT(met, 1.5 * decoder.report.leaveOneOut(2)) << name(kind);
    options.order = RowOrder::Independent;
    EXPECT_LE(trainDecoder(train, nullptr, options).report.leaveOneOut(2), 1.01 * decoder.report.leaveOneOut(2));
  }
}

TEST(SampleSplit, KeepsTheLastRowsOrTheLastRuns) {
  SampleSet set = measuredSamples(100, 1);
  const SplitSamples byTime = split(set, *sampleSplit("time:0.7"));
  EXPECT_EQ(byTime.training.size(), 70);
  EXPECT_EQ(byTime.test.times_s(0, 0), set.times_s(0, 70));
  EXPECT_EQ(laterRows(set).by, SplitBy::Time);
  EXPECT_THROW(static_cast<void>(split(set, {SplitBy::Runs, 0.5})), Error) << "it has one run";
  set.runs.resize(1, 100);
  for (Eigen::Index i = 0; i < 100; ++i) set.runs(0, i) = static_cast<double>(i / 15); // 7 runs, the last of 10 rows
  EXPECT_EQ(laterRows(set).by, SplitBy::Runs);
  EXPECT_EQ(split(set, *sampleSplit("runs")).test.size(), 10);
  EXPECT_EQ(split(set, *sampleSplit("runs:0.01")).training.size(), 15) << "at least one on both sides";
  for (const char* wrong : {"", "time:", "time:0", "time:1", "rows", "runs:x", "time:0,5"})
    EXPECT_FALSE(sampleSplit(wrong)) << wrong;
}

TEST(MeasuredTraining, InputAndRowWiresAreThoseOfTheFile) {
  TrainOptions options;
  takeDefaultsOf(measuredSamples(3, 1), false, false, options);
  EXPECT_EQ(options.input, InputKind::Resistance);
  EXPECT_EQ(options.rows, "all");
}

} // namespace

} // namespace palp
