#include "nn/NetworkError.h"
#include "nn/NoisyCopies.h"
#include "nn/RelativeError.h"
#include "nn/SpreadSweep.h"
#include "nn/baselines/BackPropagation.h"
#include "nn/baselines/ForwardModel.h"
#include "nn/baselines/GaussianProcess.h"
#include "nn/baselines/PolynomialRidge.h"
#include "nn/baselines/RecursiveLeastSquares.h"
#include "tests/nn/Touches.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace palp {
namespace {

const test::Touches training = test::touches(50, 20, 1), fresh = test::touches(30, 20, 2);

/// Share of errors within one standard deviation.
double within(const Eigen::MatrixXd& error, const Eigen::MatrixXd& deviation) {
  return (error.array().abs() < deviation.array()).cast<double>().mean();
}

TEST(PolynomialRidge, DegreeOneIsPlainLeastSquares) {
  Eigen::MatrixXd regressors(20 + 1, training.samples.cols());
  regressors << training.samples, Eigen::RowVectorXd::Ones(training.samples.cols());
  const Eigen::MatrixXd coefficients =
      (regressors * regressors.transpose()).ldlt().solve(regressors * training.targets.transpose());
  const Eigen::MatrixXd ours = trainPolynomial(training.samples, training.targets).model.predict(training.samples);
  // Normal equations keep half of the digits.
  EXPECT_LT((ours - (regressors.transpose() * coefficients).transpose()).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(PolynomialRidge, HigherDegreesFollowTheCurvature) {
  PolynomialOptions options;
  const test::Touches many = test::touches(200, 20, 3); // 1200: enough for the cubic terms of 18 directions
  double before =
      test::worstRelativeError(trainPolynomial(many.samples, many.targets).model.predict(fresh.samples), fresh.targets);
  for (const int degree : {2, 3}) {
    options.degree = degree;
    const PolynomialFit fit = trainPolynomial(many.samples, many.targets, options);
    const double error = test::worstRelativeError(fit.model.predict(fresh.samples), fresh.targets);
    EXPECT_LT(error, 0.8 * before) << degree; // the map has terms of all degrees: each takes its share
    before = error;
    const Eigen::VectorXd x = fresh.samples.col(0), step = 1e-5 * Eigen::VectorXd::Unit(20, 4);
    const Eigen::VectorXd slope = (fit.model.predict(x + step) - fit.model.predict(x - step)) / 2e-5;
    EXPECT_LT((slope - fit.model.jacobian(x).col(4)).cwiseAbs().maxCoeff(), 1e-3 * (1 + slope.norm()));
  }
}

TEST(GaussianProcess, ItsDeviationHoldsWhereTheNoiseIs) {
  GaussianProcessOptions options;
  options.relativeInputNoise = 1e-4;
  const GaussianProcessFit fit = trainGaussianProcess(training.samples, training.targets, options);
  const Eigen::MatrixXd noisy = noisyCopies(fresh.samples, 1e-4, 1, 7);
  const double share = within(fit.process.predict(noisy) - fresh.targets, fit.process.standardDeviation(noisy));
  EXPECT_GT(share, 0.55); // 0.68 for a Gaussian; the noise differs from place to place
  EXPECT_LT(share, 0.9);
}

TEST(BackPropagation, LearnsTheMap) {
  const test::Touches many = test::touches(200, 20, 3);
  const BackPropagationOptions options;
  const BackPropagationFit fit = trainBackPropagation(many.samples, many.targets, options);
  EXPECT_LT(test::worstRelativeError(fit.network.predict(fresh.samples), fresh.targets), 0.1);
  EXPECT_LT(fit.trainingError.back(), fit.trainingError.front());
  EXPECT_EQ(fit.heldOutResiduals.cols(), fit.heldOut.size());
}

/// The map's directions reach from the parameters down to rounding; those below the noise must not be blown up to the
/// size of the others.
TEST(BackPropagation, LearnsTheMapThroughNoise) {
  const test::Touches many = test::touches(100, 60, 3), others = test::touches(20, 60, 4);
  BackPropagationOptions options;
  options.relativeInputNoise = 3e-4; // 3 % of the largest signals
  const BackPropagationFit fit = trainBackPropagation(many.samples, many.targets, options);
  const Eigen::MatrixXd noisy = noisyCopies(others.samples, options.relativeInputNoise, 1, 5);
  EXPECT_LT(test::worstRelativeError(fit.network.predict(noisy), others.targets), 0.5); // 1: the mean
}

TEST(BackPropagation, PassesOnWhatItsCallerThrowsAndNeedsReadingsThatVary) {
  const test::Touches few = test::touches(5, 6, 1);
  const auto fail = [](double) { throw NetworkError("the disk is full"); };
  EXPECT_THROW(trainBackPropagation(few.samples, few.targets, {}, {}, fail), NetworkError);
  const Eigen::MatrixXd stuck = few.samples.col(0).replicate(1, few.samples.cols());
  EXPECT_THROW(trainBackPropagation(stuck, few.targets), NetworkError);
}

TEST(BackPropagation, RefusesTargetsWhoseErrorIsNeverFinite) {
  Eigen::MatrixXd targets = training.targets;
  targets *= 1e-310; // 1 / (half their range) is infinite
  EXPECT_THROW(trainBackPropagation(training.samples, targets), NetworkError);
}

TEST(ForwardModel, ItsDerivativeAgreesWithDifferences) {
  const ForwardModel model = fitForwardModel(training.samples, training.targets, training.places, {});
  const Eigen::Vector3d y(0.3, -0.2, -2);
  Eigen::MatrixXd slope;
  static_cast<void>(model.measurementsOf(2, y, &slope));
  for (int d = 0; d < 3; ++d) {
    const Eigen::VectorXd step = 1e-6 * Eigen::VectorXd::Unit(3, d);
    const Eigen::VectorXd difference = (model.measurementsOf(2, y + step) - model.measurementsOf(2, y - step)) / 2e-6;
    EXPECT_LT((difference - slope.col(d)).cwiseAbs().maxCoeff(), 1e-6); // rounding of 100 over the step is 1e-8
  }
}

TEST(MaximumLikelihood, FindsPlaceAndCausesAndKnowsItsDeviation) {
  constexpr double noise = 2e-4;
  ForwardModelOptions options;
  options.relativeNoise = noise;
  const ForwardModel model = fitForwardModel(training.samples, training.targets, training.places, options);
  const Eigen::MatrixXd noisy = noisyCopies(fresh.samples, noise, 1, 9);
  Eigen::MatrixXd error(3, noisy.cols()), deviation(3, noisy.cols());
  int right = 0;
  for (Eigen::Index i = 0; i < noisy.cols(); ++i) {
    const LikelihoodEstimate estimate = maximumLikelihood(model, noisy.col(i));
    right += estimate.classIndex == fresh.places(i);
    EXPECT_GT(estimate.confidence, 1.0 / 6 - 1e-12);
    error.col(i) = estimate.parameters - fresh.targets.col(i);
    deviation.col(i) = estimate.standardDeviation;
  }
  EXPECT_GT(right, 0.95 * static_cast<double>(noisy.cols()));
  // 540 values: the share's own deviation is 0.02.
  EXPECT_NEAR(within(error, deviation), 0.68, 0.08);
}

TEST(RecursiveLeastSquares, ReachesTheLeastSquaresSolution) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(40, 5), b = Eigen::MatrixXd::Random(40, 2);
  RecursiveLeastSquares recursive(5, 2, 1e8);
  for (int i = 0; i < 40; ++i) recursive.update(a.row(i).transpose(), b.row(i).transpose());
  const Eigen::MatrixXd exact = (a.transpose() * a).inverse() * a.transpose() * b;
  EXPECT_LT((recursive.weights() - exact).cwiseAbs().maxCoeff(), 1e-6); // the start acts as a ridge of 1e-8
}

TEST(RecursiveLeastSquares, ForgettingFollowsAChange) {
  RecursiveLeastSquares recursive(1, 1, 1e6, 0.9);
  for (int i = 0; i < 200; ++i)
    recursive.update(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Constant(1, i < 100 ? 1 : 3));
  EXPECT_NEAR(recursive.weights()(0), 3, 1e-3); // 0.9^100 of the old is left
}

TEST(RelativeError, IsThePapersEquationWithAndWithoutFloor) {
  Eigen::MatrixXd truth(1, 3), predicted(1, 3);
  truth << 1, -2, 0.01;
  predicted << 1.1, -2, 0.02;
  const PredictionError error = predictionError(predicted, truth, Eigen::VectorXd::Constant(1, 6));
  EXPECT_EQ(error.floor, 0.05);
  EXPECT_NEAR(error.eq13Percent(0), (10 + 0 + 100) / 3.0, 1e-9);
  EXPECT_NEAR(error.eq13FlooredPercent(0), (10 + 0 + 20) / 3.0, 1e-9);
  EXPECT_NEAR(error.meanAbsolute(0), 0.11 / 3, 1e-12);
  EXPECT_NEAR(error.rmsePercentOfRange(0), 100 * std::sqrt((0.01 + 0.0001) / 3) / 6, 1e-9);
}

TEST(RelativeError, InPercentIsTheSameInAnyUnitOfForce) {
  Eigen::MatrixXd truth(1, 3), predicted(1, 3);
  truth << 1, -2, 0.01;
  predicted << 1.1, -2, 0.02;
  const Eigen::VectorXd range = Eigen::VectorXd::Constant(1, 6);
  const double own = predictionError(predicted, truth, range).eq13FlooredPercent(0);
  for (const double unit : {1e-3, 10., 1e3})
    EXPECT_NEAR(predictionError(unit * predicted, unit * truth, unit * range).eq13FlooredPercent(0), own, 1e-9);
}

TEST(RelativeError, AForceThatNeverVariesLeavesTheFloorToTheOthers) {
  Eigen::MatrixXd truth(2, 2), predicted(2, 2);
  truth << 0, 0, 0.001, -0.002;
  predicted << 0, 0, 0.0011, -0.002;
  const Eigen::VectorXd range = Eigen::Vector2d(0, 0.006); // newtons of a small sensor that is pushed along one axis
  EXPECT_NEAR(predictionError(predicted, truth, range).floor, 0.006 / 120, 1e-15);
  EXPECT_NEAR(predictionError(predicted, truth, range).eq13FlooredPercent(1), 5, 1e-9);
}

TEST(SpreadSweep, GoesThroughTheSpreadsAndStopsWhenAsked) {
  const SweepInput input{training.samples, training.targets, fresh.samples, fresh.targets, Eigen::Vector3d(2, 2, 6)};
  std::stop_source stop;
  const auto rows = sweepSpreads(
      input, {0.5, 1, 2}, {},
      [&](std::size_t done) {
        if (done == 2) stop.request_stop();
      },
      stop.get_token());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].spread, 1);
  EXPECT_EQ(rows[1].predicted.cols(), fresh.targets.cols());
  EXPECT_TRUE(rows[1].error.rmsePercentOfRange.allFinite());
}

TEST(SpreadSweep, IsStoppedWithinItsFirstFit) {
  const test::Touches many = test::touches(100, 30, 1);
  const SweepInput input{many.samples, many.targets, many.samples, many.targets, Eigen::Vector3d(2, 2, 6)};
  RbfOptions options; // a fit of seconds, that looks at the token all the while
  options.relativeInputNoise = 1e-3;
  options.noiseCopies = 40;
  options.ridge = {};
  options.tail = Tail::LinearPenalised;
  std::stop_source stop;
  const std::jthread user([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  EXPECT_TRUE(sweepSpreads(input, {1, 2}, options, {}, stop.get_token()).empty());
}

} // namespace
} // namespace palp
