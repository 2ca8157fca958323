#include "app/study/live/Plausibility.h"

#include "app/study/decoding/Prediction.h"
#include "io/DecoderFile.h"
#include "tests/app/study/live/LiveFixture.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace palp {
namespace {

constexpr double kGoodNoise = 5e-6;

const Decoder& paperDecoder() {
  static const Decoder decoder =
      readNetwork(std::filesystem::path(PALP_SOURCE_DIR) / "resources" / "board" / "paper-network.json");
  return decoder;
}

/// Of good samples with noise, the share that is doubted; each is read `draws` times.
double doubtedShare(const Decoder& decoder, const SampleSet& samples, double noise, int draws) {
  PredictOptions options;
  options.noise = noise;
  const Predictor predictor(decoder, options);
  Plausibility plausibility(decoder);
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd clean_ohm = inputsOf(samples, decoder.input);
  int doubted = 0;
  for (Eigen::Index i = 0; i < clean_ohm.cols() * draws; ++i) {
    PlausibilityInput input;
    input.readings_ohm = clean_ohm.col(i % clean_ohm.cols());
    for (double& reading_ohm : input.readings_ohm) reading_ohm *= 1 + noise * normal(engine);
    const Prediction prediction = predictor(input.readings_ohm);
    input.forces_N = prediction.forces_N;
    input.standardDeviation_N = prediction.standardDeviation_N;
    input.chiSquare = prediction.chiSquare(0);
    if (prediction.likely_N.size() > 0) input.likely_N = prediction.likely_N.col(0);
    input.predictedNoise = input.noise = noise;
    doubted += plausibility.judge(input).doubted;
  }
  return static_cast<double>(doubted) / static_cast<double>(clean_ohm.cols() * draws);
}

/// Three deviations of a share of `count` independent frames that is 1 % in truth.
double binomial(double count) {
  return 3 * std::sqrt(Plausibility::kFalseAlarms * (1 - Plausibility::kFalseAlarms) / count);
}

/// Other forces than those of the training.
SampleSet heldOut(int perArea) {
  SampleSet samples = manySamples(2 * perArea);
  const SampleSet all = samples;
  samples.area = all.area.tail(perArea * all.areaCount);
  samples.forces_N = all.forces_N.rightCols(samples.area.size());
  samples.resistances_ohm = all.resistances_ohm.rightCols(samples.area.size());
  samples.displacements_mm.resize(0, samples.area.size());
  return samples;
}

class PlausibilityOf : public testing::TestWithParam<DecoderKind> {};

TEST_P(PlausibilityOf, DoubtsOneInAHundredOfGoodSamplesThatItHasNotSeen) {
  const Decoder decoder = liveDecoder(kGoodNoise, GetParam());
  const SampleSet samples = heldOut(100);
  const double share = doubtedShare(decoder, samples, kGoodNoise, 10);
  EXPECT_NEAR(share, Plausibility::kFalseAlarms, binomial(10.0 * static_cast<double>(samples.size())));
}

INSTANTIATE_TEST_SUITE_P(Networks, PlausibilityOf, testing::Values(DecoderKind::MaximumLikelihood, DecoderKind::Rbf),
                         [](const auto& kind) { return name(kind.param); });

/// What was said of each frame of a board.
struct Said {
  int frames = 0, pressed = 0, doubted = 0, spoken = 0;
  int wrong = 0, wrongDoubted = 0; ///< forces off by more than 10 deviations and 0.1 N
  int changes = 0;                 ///< of what is said
};

Said listen(VirtualBoard board, const std::function<SimulatedTouch::Truth(double)>& truth, int frames = 1200) {
  const BoardConfiguration configuration = board.configuration();
  ForceDecoder decoder(paperDecoder(), board.info(), paperDesign());
  VirtualStream stream(std::move(board), configuration);
  Said said;
  bool spoke = false;
  stream.run(static_cast<std::uint64_t>(frames), [&](const BoardFrame& frame) {
    const DecodedForces forces = decoder.decode(frame);
    if (!forces.misfit) return; // the noise is not known yet
    const Eigen::Array3d error_N = (forces.forces_N.col(0) - truth(frame.time_s).force_N).array().abs();
    const bool wrong = (error_N > 10 * forces.standardDeviation_N.col(0).array()).any() && (error_N > 0.1).any();
    const bool speaks = !forces.doubt.empty();
    ++said.frames;
    said.doubted += forces.doubted;
    said.spoken += speaks;
    said.changes += speaks != spoke;
    said.wrong += wrong;
    said.wrongDoubted += wrong && forces.doubted;
    spoke = speaks;
  });
  return said;
}

BoardDisturbance withNoise(double noise = kGoodNoise) {
  BoardDisturbance disturbance;
  disturbance.noise = noise;
  return disturbance;
}

TEST(Plausibility, SaysThatReadingsFarFromAllTouchesAreOfAnotherDesign) {
  const Decoder& decoder = paperDecoder();
  const auto saidAt = [&](double misfit) {
    Plausibility plausibility(decoder);
    PlausibilityInput input;
    input.readings_ohm = (decoder.input.low + decoder.input.high) / 2;
    input.forces_N = (decoder.low_N + decoder.high_N) / 2;
    input.standardDeviation_N = Eigen::VectorXd::Constant(input.forces_N.size(), 0.01);
    input.predictedNoise = input.noise = kGoodNoise;
    input.chiSquare = misfit * misfit;
    std::string said;
    for (input.time_s = 0; input.time_s < 1; input.time_s += 0.05) said = plausibility.judge(input).reason;
    return said;
  };
  EXPECT_EQ(saidAt(0.5), "");
  EXPECT_TRUE(saidAt(10).starts_with("no known touch: misfit ")) << saidAt(10);
  EXPECT_EQ(saidAt(10).find("another design"), std::string::npos) << "a foreign touch";
  EXPECT_NE(saidAt(3e4).find("the network is of another design"), std::string::npos) << saidAt(3e4);
}

TEST(Plausibility, SaysNothingOfTheUntouchedDemo) {
  const SimulatedTouch touch(shippedSamples());
  const Said said = listen(simulatedBoard(shippedSamples(), withNoise(), 1000, 3),
                           [&](double time_s) { return touch.truth(time_s); });
  EXPECT_GT(said.frames, 1100);
  EXPECT_EQ(said.spoken, 0);
  EXPECT_LE(static_cast<double>(said.doubted) / said.frames,
            Plausibility::kFalseAlarms + binomial(static_cast<double>(said.frames)));
}

TEST(Plausibility, DoubtsADriftingBoardBeforeItsForcesAreWrong) {
  BoardDisturbance drifting = withNoise();
  drifting.warming_degC = 2;
  const SimulatedTouch touch(shippedSamples());
  const Said said =
      listen(simulatedBoard(shippedSamples(), drifting, 1000, 3), [&](double time_s) { return touch.truth(time_s); });
  EXPECT_GT(said.wrong, 300);
  EXPECT_EQ(said.wrongDoubted, said.wrong);
  EXPECT_LE(said.changes, 1) << "it flickers";
}

TEST(Plausibility, DoubtsTheForcesOfASensorWithHysteresis) {
  BoardDisturbance lagging = withNoise();
  lagging.hysteresisShare = 0.5;
  const SimulatedTouch touch(shippedSamples());
  const Said said =
      listen(simulatedBoard(shippedSamples(), lagging, 1000, 3), [&](double time_s) { return touch.truth(time_s); });
  EXPECT_GT(said.wrong, 50);
  EXPECT_GE(said.wrongDoubted, 0.99 * said.wrong);
}

TEST(Plausibility, DoubtsATouchThatTheNetworkHasNeverSeen) {
  const SimulatedTouch touch(shippedSamples());
  const Eigen::MatrixXd rest = touch.resistances_ohm({});
  const Eigen::MatrixXd two = touch.resistances_ohm({0, {0, 0, -2}}) + touch.resistances_ohm({4, {0, 0, -2}}) - rest;
  BoardSettings settings;
  settings.disturbance = withNoise();
  const Said said = listen(
      VirtualBoard(settings, [&](double) -> const Eigen::MatrixXd& { return two; }),
      [](double) {
        return SimulatedTouch::Truth{0, {0, 0, -2}};
      },
      200);
  EXPECT_EQ(said.doubted, said.frames);
  EXPECT_GT(said.spoken, 0.9 * said.frames);
  EXPECT_EQ(said.changes, 1);
}

TEST(Plausibility, SaysThatTheForceLiesOutsideOfTheTraining) {
  const SimulatedTouch touch(shippedSamples());
  const Eigen::MatrixXd hard = touch.resistances_ohm({2, {0, 0, -9}});
  BoardSettings settings;
  settings.disturbance = withNoise();
  ForceDecoder decoder(paperDecoder(), settings.info, paperDesign());
  VirtualStream stream(VirtualBoard(settings, [&](double) -> const Eigen::MatrixXd& { return hard; }),
                       settings.configuration);
  std::string last;
  stream.run(100, [&](const BoardFrame& frame) { last = decoder.decode(frame).doubt; });
  EXPECT_NE(last.find("outside the network's training range: F"), std::string::npos) << last;
  EXPECT_NE(last.find(", trained for "), std::string::npos) << last;
}

/// The solved samples first..last-1 of each area.
SampleSet solved(int first, int last) {
  const SampleSet& all = shippedSamples();
  std::vector<Eigen::Index> members;
  std::map<int, int> count;
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    const int number = count[all.area(i)]++;
    if (number >= first && number < last) members.push_back(i);
  }
  SampleSet some = all;
  some.area = all.area(members);
  some.forces_N = all.forces_N(Eigen::all, members);
  some.resistances_ohm = all.resistances_ohm(Eigen::all, members);
  some.displacements_mm.resize(0, some.area.size());
  return some;
}

TEST(Plausibility, DoubtsOneInAHundredOfSolvedSamplesThatItHasNotSeen) {
  TrainOptions options;
  options.input = InputKind::Resistance;
  options.rows = "all";
  options.noise = kGoodNoise;
  options.decoder = DecoderKind::MaximumLikelihood;
  const Decoder decoder = trainDecoder(solved(0, 20), nullptr, options);
  constexpr int kDraws = 400; // of the noise
  const SampleSet unseen = solved(20, 24);
  EXPECT_NEAR(doubtedShare(decoder, unseen, kGoodNoise, kDraws), Plausibility::kFalseAlarms,
              binomial(kDraws * static_cast<double>(unseen.size())));
}

TEST(Plausibility, TheLimitIsTheQuantileOfChiSquare) {
  // 99 % of chi-square: 21.67 for 9 degrees of freedom, 356.4 for 297 (tables).
  EXPECT_NEAR(std::pow(Plausibility::limit(12, 0), 2) * 9, 21.67, 0.1);
  EXPECT_NEAR(std::pow(Plausibility::limit(300, 0), 2) * 297, 356.4, 1);
  EXPECT_GT(Plausibility::limit(300, 0.02), Plausibility::limit(300, 0));
}

} // namespace
} // namespace palp
