// Decoders of force and place, on samples of touches.

#include "app/study/Median.h"
#include "app/study/decoding/DecoderTraining.h"
#include "app/study/decoding/PartialPredictor.h"
#include "app/study/live/ForceDecoder.h"
#include "io/DecoderFile.h"
#include "io/DesignFile.h"
#include "model/RowColumnResistance.h"
#include "model/TouchRange.h"
#include "model/base/Error.h"
#include "tests/app/study/decoding/PrintDecoderKind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <random>
#include <vector>

namespace palp {

namespace {

/// Touches of the paper's design under a smooth stand-in for the block: the electrodes around the place go down.
ElectrodeDisplacements standInFor(const SensorDesign& design, const std::vector<Indenter>& touches) {
  const Eigen::Matrix3Xd electrodes = design.upperElectrodes_mm();
  ElectrodeDisplacements state = ElectrodeDisplacements::atRest(design);
  for (const Indenter& touch : touches)
    for (Eigen::Index e = 0; e < electrodes.cols(); ++e) {
      const Eigen::Vector2d away = (electrodes.col(e).head<2>() - touch.place_mm) / (4 + touch.radius_mm / 3);
      const double near = 0.02 * touch.press()->force_N.z() * std::exp(-away.squaredNorm());
      state.upper_mm.col(e) += Eigen::Vector3d(-0.4 * near * away.x(), -0.4 * near * away.y(), near);
    }
  return state;
}

SampleSet standInTouches(int count, std::uint64_t seed) {
  const SensorDesign design = paperDesign();
  const TouchRange range = touchesOf(design);
  SampleSet set;
  set.origin.designFingerprint = "stand-in";
  set.origin.areas = "touches";
  set.origin.touches = inWords(range);
  set.rowWires = design.rowWires();
  set.electrodesPerRowWire = design.electrodesPerRowWire();
  set.columnWires = design.columnWires();
  set.areaCount = 6;
  set.area.resize(count);
  set.touches.resize(kTouchRows, count);
  set.forces_N.resize(3, count);
  set.displacements_mm.resize(3 * design.upper.electrodes(), count);
  set.resistances_ohm.resize(static_cast<Eigen::Index>(set.rowWires) * set.columnWires, count);
  for (int i = 0; i < count; ++i) {
    const Indenter touch = touchAt(range, seed, static_cast<std::size_t>(i));
    set.area(i) = areaUnder(design, touch.place_mm);
    set.touches.col(i) << static_cast<double>(touch.shape), touch.radius_mm, touch.friction, touch.place_mm;
    set.forces_N.col(i) = touch.press()->force_N;
    const ElectrodeDisplacements state = standInFor(design, {touch});
    set.displacements_mm.col(i) = state.upper_mm.reshaped();
    set.resistances_ohm.col(i) = rowColumnResistances(design, state).transpose().reshaped();
  }
  return set;
}

TrainOptions forceAndPlace(DecoderKind kind) {
  TrainOptions options;
  options.decoder = kind;
  options.target = DecoderTarget::ForceAndPlace;
  options.input = InputKind::Resistance;
  options.rows = "all";
  options.noise = 1e-5;
  options.centers = 150;
  return options;
}

/// Median of the places' errors [mm].
double errorOf(const Prediction& prediction, const SampleSet& samples) {
  std::vector<double> off_mm;
  for (Eigen::Index i = 0; i < samples.size(); ++i)
    off_mm.push_back((prediction.places_mm.col(i) - samples.touchedPlaces_mm().col(i)).norm());
  return median(off_mm);
}

class TouchDecoder : public testing::TestWithParam<DecoderKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, TouchDecoder,
                         testing::Values(DecoderKind::Rbf, DecoderKind::Polynomial2, DecoderKind::GaussianProcess,
                                         DecoderKind::TouchInversion),
                         [](const auto& one) { return name(one.param); });

TEST_P(TouchDecoder, LearnsForceAndPlaceAndComesBackFromItsFile) {
  const SampleSet train = standInTouches(250, 1), fresh = standInTouches(40, 2);
  const Decoder decoder = trainDecoder(train, nullptr, forceAndPlace(GetParam()));
  ASSERT_TRUE(decoder.place);
  EXPECT_EQ(decoder.touches, train.origin.touches);
  EXPECT_NE(decoder.trainedWith.find("--target force+place"), std::string::npos);
  const std::string text = networkText(decoder);
  EXPECT_EQ(networkText(parseNetwork(text, "net.json")), text);
  PredictOptions options;
  options.noise = 1e-5;
  const Prediction prediction = predict(parseNetwork(text, "net.json"), fresh, options);
  EXPECT_TRUE(prediction.warnings.empty());
  ASSERT_EQ(prediction.forces_N.rows(), 3);
  ASSERT_EQ(prediction.places_mm.rows(), 2);
  ASSERT_EQ(prediction.placeDeviation_mm.cols(), 40);
  EXPECT_TRUE((prediction.placeDeviation_mm.array() > 0).all());
  const DecoderError error = decoderError(decoder, prediction, fresh);
  ASSERT_TRUE(error.place);
  // Places are drawn over 24 mm: guessing their middle is 9 mm off in the median, half of that is learnt for sure;
  // forces over 5.5 N: 29 %.
  EXPECT_LT(error.place->median_mm, 4.5);
  EXPECT_LT(error.error.rmsePercentOfRange(2), 10);
  EXPECT_EQ(error.error.rmsePercentOfRange(0), 0) << "frictionless: nothing goes sideways";
}

/// As a board's frames come, noise and all: the place stands beside the force where that stands out of the noise.
TEST(TouchesOfABoard, FramesTellWhereTheTouchIs) {
  const SampleSet train = standInTouches(250, 1), fresh = standInTouches(20, 2);
  Decoder decoder = trainDecoder(train, nullptr, forceAndPlace(DecoderKind::TouchInversion));
  decoder.designFingerprint = designFingerprint(paperDesign()); // whose rest the touches begin from
  ForceDecoder live(std::move(decoder), BoardInfo{});
  std::mt19937 engine(3);
  std::normal_distribution<double> noise(0, 1e-5);
  const auto decoded = [&](const Eigen::MatrixXd& resistances_ohm) {
    BoardFrame frame;
    frame.rowExpected.assign(10, true);
    frame.resistances_ohm = resistances_ohm.unaryExpr([&](double ohm) { return ohm * (1 + noise(engine)); });
    frame.state.setConstant(10, 30, ReadingState::Good);
    frame.complete = true;
    return live.decode(frame);
  };
  const auto touch = [&](Eigen::Index i) -> Eigen::MatrixXd {
    return fresh.resistances_ohm.col(i).reshaped(30, 10).transpose();
  };
  const Eigen::MatrixXd still = rowColumnResistances(paperDesign(), ElectrodeDisplacements::atRest(paperDesign()));
  live.startTare(50); // which also measures the noise
  for (int k = 0; k < 50; ++k) EXPECT_FALSE(decoded(still).place_mm) << "nothing is known before the tare is done";
  std::vector<double> off_mm;
  for (Eigen::Index i = 0; i < fresh.size(); ++i) {
    const DecodedForces forces = decoded(touch(i));
    ASSERT_TRUE(forces.valid) << forces.reason;
    if (!forces.shown.front()) continue;
    ASSERT_TRUE(forces.place_mm && forces.placeDeviation_mm);
    EXPECT_GT(forces.placeDeviation_mm->minCoeff(), 0);
    off_mm.push_back((*forces.place_mm - fresh.touches.col(i).middleRows<2>(kTouchX_mm)).norm());
  }
  ASSERT_GT(off_mm.size(), 10U);
  EXPECT_LT(median(off_mm), 2);
  // Two at once are doubted.
  const Indenter left{IndenterShape::Sphere, 5, 0, {8, 8}, 0, Press{{0, 0, -4}}};
  const Indenter right{IndenterShape::Sphere, 4, 0, {22, 20}, 0, Press{{0, 0, -4}}};
  const Eigen::MatrixXd both = rowColumnResistances(paperDesign(), standInFor(paperDesign(), {left, right}));
  const DecodedForces two = decoded(both);
  EXPECT_TRUE(two.doubted);
  ASSERT_TRUE(two.misfit);
  EXPECT_GT(*two.misfit, 5);
  for (int k = 0; k < 5; ++k) decoded(still);
  EXPECT_FALSE(decoded(still).place_mm) << "nothing touches it";
}

TEST(TouchInversion, KnowsItsErrorWithoutAColumnWireToo) {
  const SampleSet train = standInTouches(400, 1), fresh = standInTouches(80, 12);
  const Decoder decoder = trainDecoder(train, nullptr, forceAndPlace(DecoderKind::TouchInversion));
  PredictOptions options;
  options.noise = decoder.noise;
  const Predictor whole(decoder, options);
  Eigen::MatrixXd readings_ohm = inputsOf(fresh, decoder.input);
  std::mt19937_64 engine(13);
  std::normal_distribution<double> normal(0, options.noise);
  for (double& reading_ohm : readings_ohm.reshaped()) reading_ohm *= 1 + normal(engine);
  PresentReadings readings;
  for (Eigen::Index k = 0; k < readings_ohm.rows(); ++k)
    (k % 30 == 14 ? readings.missing : readings.present).push_back(k);
  Eigen::MatrixXd broken_ohm = readings_ohm;
  broken_ohm(readings.missing, Eigen::all).setConstant(1); // never read
  PartialPredictor fewer(decoder, options);
  const Prediction all = whole(readings_ohm);
  Prediction some = all;
  for (Eigen::Index i = 0; i < fresh.size(); ++i) {
    const Prediction one = fewer(broken_ohm.col(i), readings);
    some.forces_N.col(i) = one.forces_N;
    some.standardDeviation_N.col(i) = one.standardDeviation_N;
    some.places_mm.col(i) = one.places_mm;
  }
  const auto within = [&](const Prediction& prediction) {
    const Eigen::ArrayXd off = (prediction.forces_N.row(2) - fresh.forces_N.row(2)).array().abs().transpose();
    return static_cast<double>((off <= 3 * prediction.standardDeviation_N.row(2).transpose().array()).count()) /
           static_cast<double>(fresh.size());
  };
  EXPECT_GE(within(some), within(all) - 0.05);
  EXPECT_GE(within(some), 0.9);
  EXPECT_GE(some.standardDeviation_N.row(2).mean(), all.standardDeviation_N.row(2).mean()) << "wider";
  EXPECT_LT(errorOf(some, fresh), 2 * errorOf(all, fresh)) << "300 readings less 10";
}

TEST(TouchInversion, IsBetterThanANetworkAndKnowsItsError) {
  const SampleSet train = standInTouches(400, 1);
  SampleSet fresh = standInTouches(80, 2);
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (double& reading : fresh.resistances_ohm.reshaped()) reading *= 1 + 1e-5 * normal(engine); // as it is said below
  const auto errorOf = [&](DecoderKind kind) {
    const Decoder decoder = trainDecoder(train, nullptr, forceAndPlace(kind));
    PredictOptions options;
    options.noise = 1e-5;
    return *decoderError(decoder, predict(decoder, fresh, options), fresh).place;
  };
  const PlaceError touch = errorOf(DecoderKind::TouchInversion);
  EXPECT_LT(touch.median_mm, errorOf(DecoderKind::Rbf).median_mm);
  ASSERT_TRUE(touch.withinOneDeviation);
  // 160 coordinates: 0.68 with a standard error of 0.04.
  EXPECT_GT(*touch.withinOneDeviation, 0.5);
  EXPECT_LT(*touch.withinOneDeviation, 0.85);
}

/// How many of these readings, each with noise, are judged so.
std::ptrdiff_t judged(const Decoder& decoder, Eigen::MatrixXd readings_ohm, Pressing as) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal;
  for (double& reading : readings_ohm.reshaped()) reading *= 1 + 1e-5 * normal(engine);
  PredictOptions options;
  options.noise = 1e-5;
  const std::vector<Pressing> pressing = predict(decoder, readings_ohm, options).pressing;
  return std::count(pressing.begin(), pressing.end(), as);
}

TEST(TouchInversion, TellsNoTouchFromOneAndFromTwo) {
  const SensorDesign design = paperDesign();
  const SampleSet train = standInTouches(400, 1), fresh = standInTouches(200, 2);
  const Decoder decoder =
      parseNetwork(networkText(trainDecoder(train, nullptr, forceAndPlace(DecoderKind::TouchInversion))), "net.json");
  // One in a hundred at most is to be judged wrongly; 3 deviations of a binomial number of 200 are 4 more.
  EXPECT_GE(judged(decoder, fresh.resistances_ohm, Pressing::One), 194);
  const Eigen::VectorXd rest_ohm =
      rowColumnResistances(design, ElectrodeDisplacements::atRest(design)).transpose().reshaped();
  EXPECT_GE(judged(decoder, rest_ohm.replicate(1, 200), Pressing::None), 194);
  const TouchRange range = touchesOf(design);
  Eigen::MatrixXd twos_ohm(rest_ohm.size(), 0);
  for (std::size_t i = 0; i < 100; ++i) {
    const Indenter one = touchAt(range, 7, i), other = touchAt(range, 8, i);
    if ((one.place_mm - other.place_mm).norm() < 8) continue; // mm: nearer ones may pass for a larger one
    twos_ohm.conservativeResize(Eigen::NoChange, twos_ohm.cols() + 1);
    twos_ohm.rightCols<1>() = rowColumnResistances(design, standInFor(design, {one, other})).transpose().reshaped();
  }
  ASSERT_GT(twos_ohm.cols(), 50);
  EXPECT_EQ(judged(decoder, twos_ohm, Pressing::Other), twos_ohm.cols());
}

TEST(TouchInversion, GivesTheSameBytesWithAnyNumberOfThreads) {
  const SampleSet train = standInTouches(120, 1);
  TrainOptions one = forceAndPlace(DecoderKind::TouchInversion), many = one;
  one.threads = 1;
  many.threads = 3;
  Decoder first = trainDecoder(train, nullptr, one), second = trainDecoder(train, nullptr, many);
  first.report.seconds = second.report.seconds = 0;
  EXPECT_EQ(networkText(first), networkText(second));
}

TEST(TouchInversion, RefusesWhatHasNoPlace) {
  const SampleSet train = standInTouches(60, 1);
  TrainOptions options = forceAndPlace(DecoderKind::MaximumLikelihood);
  EXPECT_THROW(trainDecoder(train, nullptr, options), Error);
  options = forceAndPlace(DecoderKind::TouchInversion);
  options.target = DecoderTarget::Force;
  EXPECT_THROW(trainDecoder(train, nullptr, options), Error);
  SampleSet areas = train;
  areas.touches.resize(0, 0);
  areas.origin.touches.clear();
  EXPECT_THROW(trainDecoder(areas, nullptr, forceAndPlace(DecoderKind::Rbf)), Error);
}

TEST(TouchInversion, SaysWhereTouchesMeetADecoderOfAreasAndTheOtherWayRound) {
  const SampleSet touches = standInTouches(60, 1);
  SampleSet areas = touches;
  areas.touches.resize(0, 0);
  areas.origin.touches.clear();
  TrainOptions options;
  options.decoder = DecoderKind::Linear;
  const Decoder ofAreas = trainDecoder(areas, nullptr, options), ofTouches = trainDecoder(touches, nullptr, options);
  EXPECT_TRUE(otherSamples(ofAreas, areas).empty());
  EXPECT_TRUE(otherSamples(ofTouches, touches).empty());
  ASSERT_EQ(otherSamples(ofAreas, touches).size(), 1U);
  EXPECT_NE(otherSamples(ofAreas, touches)[0].find("train on touches"), std::string::npos);
  ASSERT_EQ(otherSamples(ofTouches, areas).size(), 1U);
}

} // namespace
} // namespace palp
