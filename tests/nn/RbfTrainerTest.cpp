#include "nn/RbfTrainer.h"
#include "model/base/Cancelled.h"

#include "nn/LeaveOneOut.h"
#include "nn/NetworkError.h"
#include "nn/NoisyCopies.h"
#include "nn/RbfEvaluator.h"
#include "nn/baselines/PolynomialRidge.h"
#include "nn/linear/Lapack.h"
#include "nn/linear/LinearSolve.h"
#include "nn/rbf/RbfSystem.h"
#include "tests/nn/Touches.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace palp {
namespace {

TEST(RbfTrainer, OneCentreASampleInterpolates) {
  const test::Touches set = test::touches(20, 12, 1);
  for (const Tail tail : {Tail::None, Tail::Bias, Tail::Linear}) {
    RbfOptions options;
    options.spread = 1;
    options.tail = tail;
    const RbfFit fit = trainRbf(set.samples, set.targets, options);
    // Weights of 1e6 and 16 digits leave 1e-10; directions that were dropped cost a little more.
    EXPECT_LT(test::worstRelativeError(fit.network.predict(set.samples), set.targets), 1e-6);
  }
}

TEST(RbfTrainer, TheDefaultBeatsLinearLeastSquaresFiftyTimes) {
  const test::Touches training = test::touches(60, 30, 1), fresh = test::touches(30, 30, 2);
  const RbfFit fit = trainRbf(training.samples, training.targets, {});
  const PolynomialFit linear = trainPolynomial(training.samples, training.targets);
  EXPECT_LT(50 * test::worstRelativeError(fit.network.predict(fresh.samples), fresh.targets),
            test::worstRelativeError(linear.model.predict(fresh.samples), fresh.targets));
}

TEST(RbfTrainer, AllSolversAgreeWhereTheSystemIsSound) {
  const test::Touches set = test::touches(15, 8, 1), fresh = test::touches(10, 8, 2);
  RbfOptions options;
  options.spread = 0.5;
  options.ridge = 1e-4;
  options.tail = Tail::Bias;
  const Eigen::MatrixXd qr = trainRbf(set.samples, set.targets, options).network.predict(fresh.samples);
  for (const LeastSquaresMethod method : {LeastSquaresMethod::Cholesky, LeastSquaresMethod::TruncatedSvd}) {
    options.method = method;
    const RbfFit fit = trainRbf(set.samples, set.targets, options);
    // Condition 1e6: ten digits are left.
    EXPECT_LT((fit.network.predict(fresh.samples) - qr).cwiseAbs().maxCoeff(), 1e-8) << name(method);
  }
}

TEST(RbfTrainer, RecursiveLeastSquaresComesNearLeastSquaresOnFewCentres) {
  const test::Touches set = test::touches(40, 8, 1);
  RbfOptions options;
  options.spread = 1;
  options.centers = CenterChoice::KMeans;
  options.centerCount = 12;
  options.tail = Tail::Bias;
  const Eigen::MatrixXd qr = trainRbf(set.samples, set.targets, options).network.predict(set.samples);
  options.method = LeastSquaresMethod::Recursive;
  const RbfFit fit = trainRbf(set.samples, set.targets, options);
  EXPECT_LT((fit.network.predict(set.samples) - qr).cwiseAbs().maxCoeff(), 1e-2); // its start acts as a ridge of 1e-6
}

TEST(RbfTrainer, EqualSeedsGiveEqualBytes) {
  const test::Touches set = test::touches(15, 8, 1);
  RbfOptions options;
  options.centers = CenterChoice::KMeans;
  options.centerCount = 20;
  options.relativeInputNoise = 1e-3;
  options.tail = Tail::LinearPenalised;
  options.ridge = {};
  const RbfFit a = trainRbf(set.samples, set.targets, options), b = trainRbf(set.samples, set.targets, options);
  EXPECT_EQ(a.network.weights, b.network.weights);
  EXPECT_EQ(a.report.spread, b.report.spread);
}

TEST(RbfTrainer, WideSpreadsDoNotRuinTheNetwork) {
  const test::Touches training = test::touches(60, 30, 1), fresh = test::touches(30, 30, 2);
  for (const double spread : {50.0, 200.0, 1e4}) {
    RbfOptions options;
    options.spread = spread;
    const RbfFit fit = trainRbf(training.samples, training.targets, options);
    EXPECT_LT(test::worstRelativeError(fit.network.predict(fresh.samples), fresh.targets), 1e-2) << spread;
  }
}

TEST(RbfTrainer, LostDigitsAreSaidInWords) {
  const test::Touches set = test::touches(30, 12, 1);
  RbfOptions options;
  options.spread = 5;
  options.tail = Tail::Bias;
  const RbfFit fit = trainRbf(set.samples, set.targets, options);
  ASSERT_FALSE(fit.report.warnings.empty());
  EXPECT_NE(fit.report.warnings.front().find("digits"), std::string::npos);
}

/// Every extreme here can be fitted, if not well: a refusal would be a fault.
void expectFinite(const Eigen::MatrixXd& samples, const Eigen::MatrixXd& targets, const RbfOptions& options,
                  const std::string& what) {
  const std::string how = name(options.method) + ", " + name(options.scaling);
  try {
    const RbfFit fit = trainRbf(samples, targets, options);
    EXPECT_TRUE(fit.network.predict(samples).allFinite()) << what << ", " << how;
    EXPECT_TRUE(fit.report.leaveOneOut.allFinite()) << what << ", " << how;
  } catch (const NetworkError& refusal) {
    ADD_FAILURE() << what << ", " << how << ": " << refusal.what();
  }
}

std::vector<RbfOptions> allKinds() {
  std::vector<RbfOptions> kinds;
  for (const LeastSquaresMethod method : {LeastSquaresMethod::PivotedQr, LeastSquaresMethod::Cholesky,
                                          LeastSquaresMethod::TruncatedSvd, LeastSquaresMethod::Recursive})
    for (const Tail tail : {Tail::None, Tail::Bias, Tail::Linear, Tail::LinearPenalised})
      for (const Scaling scaling : {Scaling::Raw, Scaling::MinMax, Scaling::ZScore, Scaling::Global}) {
        RbfOptions options;
        options.method = method;
        options.tail = tail;
        options.scaling = scaling;
        kinds.push_back(options);
      }
  return kinds;
}

TEST(RbfTrainer, ExtremesOfSpreadAndRidgeStayFinite) {
  const test::Touches set = test::touches(4, 6, 1);
  for (RbfOptions options : allKinds())
    for (const double spread : {1e-3, 0.3, 200.0, 1e4})
      for (const double ridge : {0.0, 1e-13, 10.0}) {
        options.spread = spread;
        options.ridge = ridge;
        expectFinite(set.samples, set.targets, options,
                     "spread " + std::to_string(spread) + ", ridge " + std::to_string(ridge));
      }
}

TEST(RbfTrainer, ExtremesOfTheSamplesStayFinite) {
  const test::Touches set = test::touches(4, 6, 1);
  Eigen::MatrixXd duplicates = set.samples;
  duplicates.rightCols(12) = duplicates.leftCols(12);
  for (RbfOptions options : allKinds()) {
    options.spread = 1;
    expectFinite(duplicates, set.targets, options, "duplicates");
    expectFinite(Eigen::MatrixXd::Constant(6, 24, 3), set.targets, options, "constant inputs");
    expectFinite(set.samples, Eigen::MatrixXd::Zero(3, 24), options, "targets all zero");
    for (const double size : {1e-9, 1e9}) expectFinite(size * set.samples, set.targets, options, "scaled");
    for (const int count : {1, 2, 3})
      expectFinite(set.samples.leftCols(count), set.targets.leftCols(count), options, "few samples");
    options.centers = CenterChoice::KMeans;
    options.centerCount = 100;
    expectFinite(set.samples, set.targets, options, "more centres than samples");
  }
}

TEST(RbfTrainer, AutomaticSpreadCopesWithTheExtremesToo) {
  const test::Touches set = test::touches(4, 6, 1);
  for (const double noise : {0.0, 1e-3}) {
    RbfOptions options;
    options.relativeInputNoise = noise;
    if (noise > 0) {
      options.ridge = {};
      options.tail = Tail::LinearPenalised;
      options.method = LeastSquaresMethod::Cholesky;
    }
    for (const int count : {1, 2, 3, 24})
      expectFinite(set.samples.leftCols(count), set.targets.leftCols(count), options, "few samples");
    expectFinite(Eigen::MatrixXd::Constant(6, 24, 3), set.targets, options, "constant inputs");
  }
}

TEST(RbfTrainer, BadDataAndOptionsAreRefused) {
  const test::Touches set = test::touches(4, 6, 1);
  RbfOptions options;
  options.spread = -1;
  EXPECT_THROW(trainRbf(set.samples, set.targets, options), NetworkError);
  options.spread = 1;
  options.ridge = -1;
  EXPECT_THROW(trainRbf(set.samples, set.targets, options), NetworkError);
  EXPECT_THROW(trainRbf(Eigen::MatrixXd(6, 0), Eigen::MatrixXd(3, 0)), NetworkError);
  EXPECT_THROW(trainRbf(set.samples, set.targets.leftCols(3)), NetworkError);
  EXPECT_THROW(trainRbf(1e101 * set.samples, set.targets), NetworkError); // the sums of its squares are not finite
  Eigen::MatrixXd broken = set.samples;
  broken(2, 5) = std::nan("");
  try {
    static_cast<void>(trainRbf(broken, set.targets));
    FAIL() << "a value that is not a number was accepted";
  } catch (const NetworkError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("input 2 of sample 5"), std::string::npos);
  }
}

TEST(RbfTrainer, StopsWhenAskedTo) {
  const test::Touches set = test::touches(4, 6, 1);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(trainRbf(set.samples, set.targets, {}, stop.get_token()), Cancelled);
}

/// What takes long in a fit with noise looks at the token itself, so that no two looks are far apart.
TEST(RbfTrainer, EachLongStepOfANoisyFitStopsWhenAskedTo) {
  const test::Touches set = test::touches(4, 6, 1);
  RbfOptions options;
  options.relativeInputNoise = 1e-4;
  options.tail = Tail::LinearPenalised;
  options.scaling = Scaling::Whiten;
  std::stop_source source;
  source.request_stop();
  const std::stop_token stop = source.get_token();
  EXPECT_THROW(noisyCopies(set.samples, 1e-4, 10, 1, stop), Cancelled);
  EXPECT_THROW(squaredDistances(set.samples, set.samples, stop), Cancelled);
  EXPECT_THROW(rbfSystem(set.samples, set.targets, options, 10, stop), Cancelled);
  EXPECT_THROW(chooseSpread(set.samples, set.targets, options, stop), Cancelled);
  EXPECT_THROW(lapack::gram(set.samples.transpose(), stop), Cancelled);
  EXPECT_THROW(lapack::svdOfGram(set.samples.transpose(), stop), Cancelled);
  for (const LeastSquaresMethod method : {LeastSquaresMethod::PivotedQr, LeastSquaresMethod::Cholesky}) {
    options.method = method;
    const auto problem = rbfSystem(set.samples, set.targets, options, 10);
    EXPECT_THROW(static_cast<void>(problem->leaveOneOut(1, {1e-6, 1e-3}, stop)), Cancelled);
    EXPECT_THROW(static_cast<void>(problem->solve(1, 1e-6, stop)), Cancelled);
    EXPECT_THROW(solveLeastSquares(set.samples.transpose(), set.targets.transpose(), method, 1e-6, 1e-15, 1, stop),
                 Cancelled);
    EXPECT_TRUE(problem->solve(1, 1e-6, {}).weights.allFinite()); // the same work without a stop request
  }
}

TEST(LinearSolve, ATallSystemInBlocksOfRowsHasTheSolutionOfOneInOnePiece) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(203, 20), b = Eigen::MatrixXd::Random(203, 3);
  for (const double ridge : {0.0, 0.1}) {
    const LinearSolution blocks = solveLeastSquares(a, b, LeastSquaresMethod::PivotedQr, ridge, 1e-15, 1);
    const LinearSolution whole = solveLeastSquares(a, b, LeastSquaresMethod::TruncatedSvd, ridge, 1e-15, 1);
    EXPECT_LT((blocks.x - whole.x).cwiseAbs().maxCoeff(), 1e-13); // a well-conditioned system of numbers of order 1
    EXPECT_EQ(blocks.rank, 20);
  }
}

TEST(LinearSolve, ASemidefiniteSystemOfLowRankIsSolvedInItsRange) {
  const Eigen::MatrixXd factor = Eigen::MatrixXd::Random(40, 12);
  const Eigen::MatrixXd a = factor * factor.transpose(), truth = a * Eigen::MatrixXd::Random(40, 2);
  Eigen::MatrixXd lower = a.triangularView<Eigen::Lower>(); // the other triangle is not read
  const LinearSolution solution = solveSymmetric(lower, a * truth, LeastSquaresMethod::PivotedQr, 0, 1e-13);
  EXPECT_EQ(solution.rank, 12);
  EXPECT_LT((a * solution.x - a * truth).norm(), 1e-12 * (a * truth).norm());
  EXPECT_FALSE(solution.warnings.empty());
}

/// Inputs of which a small direction holds what a large one does not; noise on all.
test::Touches hiddenDirection(int count, std::uint64_t seed) {
  RandomNumbers random(seed);
  test::Touches set{Eigen::MatrixXd(8, count), Eigen::MatrixXd(1, count), Eigen::VectorXi::Zero(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double large = 2 * random.uniform() - 1, small = 2 * random.uniform() - 1;
    set.targets(0, i) = std::abs(large) > 0.5 ? std::sin(3 * small) : -std::sin(3 * small);
    for (int d = 0; d < 8; ++d) set.samples(d, i) = 100 * (1 + 1e-2 * std::cos(d) * large + 2e-4 * std::sin(d) * small);
  }
  return set;
}

TEST(RbfTrainer, WhiteningFindsWhatASmallDirectionHoldsUnderNoise) {
  const test::Touches training = hiddenDirection(300, 1), fresh = hiddenDirection(300, 2);
  RbfOptions options;
  options.relativeInputNoise = 2e-6;
  options.ridge = {};
  options.tail = Tail::LinearPenalised;
  options.method = LeastSquaresMethod::Cholesky;
  const auto error = [&](Scaling scaling) {
    options.scaling = scaling;
    const RbfNetwork network = trainRbf(training.samples, training.targets, options).network;
    const Eigen::MatrixXd noisy = noisyCopies(fresh.samples, options.relativeInputNoise, 1, 9);
    return std::sqrt((network.predict(noisy) - fresh.targets).squaredNorm() / 300);
  };
  EXPECT_LT(error(Scaling::Whiten), 0.7 * error(Scaling::Global));
}

TEST(RbfTrainer, GivesTheSameBytesAtAnyNumberOfThreads) {
  const test::Touches set = test::touches(20, 12, 1);
  for (const double noise : {0.0, 1e-4}) {
    RbfOptions options;
    options.relativeInputNoise = noise;
    options.scaling = noise > 0 ? Scaling::Whiten : Scaling::Global;
    if (noise > 0)
      options.ridge = {}, options.tail = Tail::LinearPenalised, options.method = LeastSquaresMethod::Cholesky;
    options.threads = 1;
    const RbfFit one = trainRbf(set.samples, set.targets, options);
    options.threads = 3;
    const RbfFit three = trainRbf(set.samples, set.targets, options);
    EXPECT_EQ(one.report.spread, three.report.spread);
    EXPECT_EQ(one.network.weights, three.network.weights);
  }
}

TEST(RbfNetwork, ItsDerivativeAgreesWithDifferences) {
  const test::Touches set = test::touches(20, 9, 1);
  for (const Tail tail : {Tail::Bias, Tail::Linear, Tail::LinearPenalised}) {
    RbfOptions options;
    options.spread = 1.5;
    options.ridge = 1e-6;
    options.tail = tail;
    const RbfNetwork network = trainRbf(set.samples, set.targets, options).network;
    const Eigen::VectorXd x = set.samples.col(3);
    const Eigen::MatrixXd slope = network.jacobian(x);
    for (int d = 0; d < 9; ++d) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(9, d);
      const Eigen::VectorXd difference = (network.predict(x + step) - network.predict(x - step)) / 2e-5;
      // Central differences: rounding 1e-9 of weights up to 1e4 over the step.
      EXPECT_LT((difference - slope.col(d)).cwiseAbs().maxCoeff(), 1e-4 * (1 + slope.cwiseAbs().maxCoeff()));
    }
  }
}

TEST(RbfEvaluator, OneByOneAndInBatchesGiveWhatTheDefinitionSays) {
  const test::Touches set = test::touches(9, 7, 1);
  RbfOptions options;
  options.spread = 0.8;
  options.tail = Tail::LinearPenalised;
  const RbfNetwork network = trainRbf(set.samples, set.targets, options).network;
  const Eigen::MatrixXd scaled = network.scaler.apply(set.samples);
  Eigen::MatrixXd expected = network.tail * scaled;
  for (Eigen::Index i = 0; i < scaled.cols(); ++i) {
    expected.col(i) += network.bias;
    for (Eigen::Index c = 0; c < network.centers.cols(); ++c)
      expected.col(i) += network.weights.col(c) * std::exp(-gaussianRate(0.8, SpreadConvention::Radbas) *
                                                           (scaled.col(i) - network.centers.col(c)).squaredNorm());
  }
  const double tolerance = 1e-14 * network.weights.cwiseAbs().sum(); // a rounding of every term
  EXPECT_LT((network.predict(set.samples) - expected).cwiseAbs().maxCoeff(), tolerance);
  const RbfEvaluator evaluator(network);
  std::vector<double> output(3), scratch(evaluator.scratchSize());
  for (Eigen::Index i = 0; i < scaled.cols(); ++i) {
    evaluator.evaluate({set.samples.col(i).data(), 7}, output, scratch);
    for (int o = 0; o < 3; ++o) EXPECT_NEAR(output[static_cast<std::size_t>(o)], expected(o, i), tolerance);
  }
}

TEST(RbfEvaluator, ABatchHoldsTheBytesOfOneByOne) {
  const test::Touches set = test::touches(27, 7, 1); // 162 centres: 11 blocks of 16, the last one not full
  for (const Tail tail : {Tail::Linear, Tail::Bias}) {
    RbfOptions options;
    options.spread = 0.8;
    options.tail = tail;
    const RbfNetwork network = trainRbf(set.samples, set.targets, options).network;
    const RbfEvaluator evaluator(network);
    const Eigen::MatrixXd batch = network.predict(set.samples);
    std::vector<double> output(3), scratch(evaluator.scratchSize());
    for (Eigen::Index i = 0; i < set.samples.cols(); ++i) {
      evaluator.evaluate({set.samples.col(i).data(), 7}, output, scratch);
      for (int o = 0; o < 3; ++o) EXPECT_EQ(output[static_cast<std::size_t>(o)], batch(o, i));
    }
  }
}

/// scipy_rbf.csv is written by tests/benchmarks/scipy_reference.py: RBFInterpolator, gaussian, degree 1.
TEST(RbfTrainer, AgreesWithScipysRbfInterpolator) {
  std::ifstream file(PALP_SOURCE_DIR "/tests/reference/scipy_rbf.csv");
  ASSERT_TRUE(file) << "tests/reference/scipy_rbf.csv is missing";
  std::string line;
  std::getline(file, line); // what the columns are
  constexpr int inputs = 4, outputs = 2, training = 80, fresh = 40;
  Eigen::MatrixXd rows(inputs + outputs, training + fresh);
  for (Eigen::Index i = 0; i < rows.cols(); ++i) {
    ASSERT_TRUE(std::getline(file, line));
    std::istringstream numbers(line);
    for (Eigen::Index k = 0; k < rows.rows(); ++k) {
      std::string number;
      std::getline(numbers, number, ',');
      rows(k, i) = std::stod(number);
    }
  }
  RbfOptions options;
  options.scaling = Scaling::Raw;
  options.spread = 0.6;
  options.convention = SpreadConvention::Sigma;
  const RbfFit fit = trainRbf(rows.topLeftCorner(inputs, training), rows.bottomLeftCorner(outputs, training), options);
  const Eigen::MatrixXd ours = fit.network.predict(rows.topRightCorner(inputs, fresh));
  // Both are well-conditioned there (1e6); the values' range is about 3.
  EXPECT_LT((ours - rows.bottomRightCorner(outputs, fresh)).cwiseAbs().maxCoeff(), 3e-6);
}

} // namespace
} // namespace palp
