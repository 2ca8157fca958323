#include "nn/LeaveOneOut.h"
#include "nn/linear/RandomNumbers.h"

#include "tests/nn/Touches.h"

#include <gtest/gtest.h>

#include <limits>
#include <ostream>

namespace palp {
namespace {

Eigen::MatrixXd without(const Eigen::MatrixXd& columns, Eigen::Index left) {
  Eigen::MatrixXd rest(columns.rows(), columns.cols() - 1);
  rest << columns.leftCols(left), columns.rightCols(columns.cols() - 1 - left);
  return rest;
}

struct Case {
  const char* what;
  CenterChoice centers;
  Tail tail;
  double ridge;
};
/// In the names of the tests.
void PrintTo(const Case& one, std::ostream* out) {
  *out << one.what;
}

class LeaveOneOutOf : public testing::TestWithParam<Case> {};

/// Raw scaling and centres that do not move, so that leaving a sample out changes nothing else.
TEST_P(LeaveOneOutOf, AgreesWithTrainingAgainWithoutEachSample) {
  const test::Touches set = test::touches(6, 5, 3);
  const Eigen::MatrixXd samples = set.samples.array() - 100;
  RbfOptions options;
  options.scaling = Scaling::Raw;
  options.centers = GetParam().centers;
  options.tail = GetParam().tail;
  options.spread = 1.0;
  options.method = LeastSquaresMethod::Cholesky;
  options.ridge = GetParam().ridge;
  const Eigen::MatrixXd closed = leaveOneOut(samples, set.targets, {1.0}, options).front().residuals;
  for (Eigen::Index i = 0; i < samples.cols(); ++i) {
    const RbfFit fit = trainRbf(without(samples, i), without(set.targets, i), options);
    const Eigen::VectorXd residual = set.targets.col(i) - fit.network.predict(samples.col(i));
    // The targets are up to 6; the systems' condition is below 1e8, so that 8 digits are left.
    EXPECT_LT((residual - closed.col(i)).cwiseAbs().maxCoeff(), 1e-6) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LeaveOneOutOf,
                         testing::Values(Case{"plain", CenterChoice::Samples, Tail::None, 1e-3},
                                         Case{"linear", CenterChoice::Samples, Tail::Linear, 1e-3},
                                         Case{"linearSmallRidge", CenterChoice::Samples, Tail::Linear, 1e-6}),
                         [](const auto& one) { return std::string(one.param.what); });

TEST(LeaveOneOut, GoesOnBeyondTheGridWhileItsEndIsTheBest) {
  // A plane over more inputs than there are samples: the flatter the basis, the better.
  RandomNumbers random(5);
  const Eigen::MatrixXd samples = Eigen::MatrixXd::NullaryExpr(20, 18, [&](auto, auto) { return random.normal(); });
  const Eigen::MatrixXd targets = samples.colwise().sum();
  RbfOptions options;
  options.ridge = {};
  const SpreadChoice choice = chooseSpread(samples, targets, options);
  ASSERT_GT(choice.grid.size(), 24U);
  for (std::size_t i = 24; i < choice.grid.size(); ++i) { // each step was taken because the one before was the best yet
    for (std::size_t k = 0; k + 1 < i; ++k) EXPECT_LE(choice.grid[i - 1].score, choice.grid[k].score) << i << " " << k;
    EXPECT_GT(choice.grid[i].spread, choice.grid[i - 1].spread);
  }
  EXPECT_LE(choice.overall.score, choice.grid[23].score);
}

TEST(LeaveOneOut, OfALargerRidgeThanTheNetworksIsNotGivenWithoutAWord) {
  const test::Touches set = test::touches(40, 30, 4);
  const auto said = [&](double spread) {
    RbfOptions options;
    options.tail = Tail::Bias;
    options.spread = spread;
    const std::vector<std::string> warnings = trainRbf(set.samples, set.targets, options).report.warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& text) { return text.find("larger ridge") != std::string::npos; });
  };
  EXPECT_TRUE(said(1000)); // flat: only rounding remains next to the bias
  EXPECT_FALSE(said(1));
}

TEST(LeaveOneOut, ManyRidgesByEigenvaluesAgreeWithOneByInverse) {
  const test::Touches set = test::touches(8, 6, 4);
  RbfOptions options;
  options.ridge = {};
  const SpreadChoice choice = chooseSpread(set.samples, set.targets, options);
  options.ridge = choice.overall.ridge;
  const LeaveOneOutResult one = leaveOneOut(set.samples, set.targets, {choice.overall.spread}, options).front();
  EXPECT_NEAR(one.score / choice.overall.score, 1, 1e-2); // two roundings of a system that is nearly singular
}

TEST(LeaveOneOut, OfTheChosenSpreadPredictsTheErrorOnNewSamples) {
  const test::Touches training = test::touches(60, 30, 1), fresh = test::touches(40, 30, 2);
  RbfOptions options;
  options.spread = {};
  const RbfFit fit = trainRbf(training.samples, training.targets, options);
  const Eigen::VectorXd error =
      (fit.network.predict(fresh.samples) - fresh.targets).array().square().rowwise().mean().sqrt();
  for (int o = 0; o < 3; ++o) { // an estimate, within a factor of 5 either way
    EXPECT_LT(error(o), 5 * fit.report.leaveOneOut(o));
    EXPECT_GT(error(o), fit.report.leaveOneOut(o) / 5);
  }
}

TEST(LeaveOneOut, NamesTheRidgeThatItUsed) {
  const test::Touches set = test::touches(40, 6, 4);
  RbfOptions options;
  options.tail = Tail::None;
  options.ridge = {}; // tried from 1e-13 on; the kernel's trace is the number of samples
  const double least = 4 * std::numeric_limits<double>::epsilon() * static_cast<double>(set.samples.cols());
  ASSERT_GT(least, 1e-13);
  for (const LeaveOneOutResult& result : leaveOneOut(set.samples, set.targets, {1, 10, 100, 1000}, options))
    EXPECT_GE(result.ridge, 0.999 * least);
}

} // namespace
} // namespace palp
