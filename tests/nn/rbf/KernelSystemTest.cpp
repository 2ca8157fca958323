#include "nn/rbf/KernelSystem.h"

#include "nn/Basis.h"
#include "tests/nn/Touches.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <ostream>

namespace palp {

/// In the names of the tests.
static void PrintTo(Tail tail, std::ostream* out) {
  *out << kTails.name(tail);
}

namespace {

constexpr double kKernelSpread = 1, kKernelRidge = 1e-3;
/// 16 digits less those that a condition of some 1e6 takes.
constexpr double kKernelTolerance = 1e-9;

const test::Touches kKernelSet = test::touches(6, 5, 1);

Eigen::MatrixXd samples() {
  return kKernelSet.samples.array() - 100;
}

Eigen::MatrixXd withoutColumn(const Eigen::MatrixXd& columns, Eigen::Index left) {
  Eigen::MatrixXd rest(columns.rows(), columns.cols() - 1);
  rest << columns.leftCols(left), columns.rightCols(columns.cols() - 1 - left);
  return rest;
}

RbfOptions options(Tail tail) {
  RbfOptions result;
  result.scaling = Scaling::Raw;
  result.tail = tail;
  result.tailVariance = 10;
  return result;
}

Eigen::MatrixXd gaussians(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const double rate = gaussianRate(kKernelSpread, SpreadConvention::Radbas);
  return Eigen::MatrixXd::NullaryExpr(a.cols(), b.cols(), [&](Eigen::Index i, Eigen::Index j) {
    return std::exp(-rate * (a.col(i) - b.col(j)).squaredNorm());
  });
}

/// [inputs, 1] or 1 alone or nothing, one row per sample.
Eigen::MatrixXd kernelRegressors(const Eigen::MatrixXd& x, Tail tail) {
  const Eigen::Index inputs = tail == Tail::Linear ? x.rows() : 0;
  Eigen::MatrixXd p(x.cols(), tail == Tail::Linear || tail == Tail::Bias ? inputs + 1 : 0);
  if (p.cols() == 0) return p;
  p << x.topRows(inputs).transpose(), Eigen::VectorXd::Ones(x.cols());
  return p;
}

/// What the network predicts at `at`, from the dense system [Phi + ridge I, P; P^T, 0] [w; c] = [y; 0], or with the
/// tail as a kernel of its own, Phi + v (X^T X + 1).
Eigen::MatrixXd dense(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, Tail tail, double ridge,
                      const Eigen::MatrixXd& at) {
  const Eigen::MatrixXd p = kernelRegressors(x, tail);
  const Eigen::Index n = x.cols(), extra = p.cols();
  const auto kernel = [&](const Eigen::MatrixXd& a) -> Eigen::MatrixXd {
    if (tail != Tail::LinearPenalised) return gaussians(a, x);
    return gaussians(a, x) + (10 * (1 + (a.transpose() * x).array())).matrix();
  };
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + extra, n + extra);
  system.topLeftCorner(n, n) = kernel(x) + ridge * Eigen::MatrixXd::Identity(n, n);
  system.topRightCorner(n, extra) = p;
  system.bottomLeftCorner(extra, n) = p.transpose();
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + extra, y.rows());
  right.topRows(n) = y.transpose();
  const Eigen::MatrixXd solution = system.fullPivLu().solve(right);
  const Eigen::MatrixXd predicted =
      kernel(at) * solution.topRows(n) + kernelRegressors(at, tail) * solution.bottomRows(extra);
  return predicted.transpose();
}

class KernelSystemWith : public testing::TestWithParam<Tail> {};

TEST_P(KernelSystemWith, ItsNetworkIsThatOfADenseDirectSolve) {
  const KernelSystem system(samples(), kKernelSet.targets, options(GetParam()));
  const RbfSolution solution = system.solve(kKernelSpread, kKernelRidge, {});
  const RbfNetwork network{system.scaler(), system.centers(), kKernelSpread, SpreadConvention::Radbas,
                           solution.form,   solution.weights, solution.tail, solution.bias};
  const Eigen::MatrixXd fresh = test::touches(5, 5, 2).samples.array() - 100;
  // A penalised tail is fitted to what the mean leaves of the targets.
  const Eigen::VectorXd mean = GetParam() == Tail::LinearPenalised
                                   ? Eigen::VectorXd(kKernelSet.targets.rowwise().mean())
                                   : Eigen::VectorXd(Eigen::VectorXd::Zero(3));
  const Eigen::MatrixXd expected =
      dense(samples(), kKernelSet.targets.colwise() - mean, GetParam(), kKernelRidge, fresh).colwise() + mean;
  EXPECT_LT((network.predict(fresh) - expected).cwiseAbs().maxCoeff(), kKernelTolerance);
  EXPECT_EQ(solution.ridge, kKernelRidge);
}

TEST_P(KernelSystemWith, ItsLeaveOneOutErrorsAreThoseOfLeavingEachSampleOut) {
  const KernelSystem system(samples(), kKernelSet.targets, options(GetParam()));
  const LeaveOneOutResult byInverse = system.leaveOneOut(kKernelSpread, {kKernelRidge}, {}).front();
  const LeaveOneOutResult byEigenvalues = system.leaveOneOut(kKernelSpread, {1e-4, kKernelRidge}, {}).back();
  const Eigen::VectorXd mean = GetParam() == Tail::LinearPenalised
                                   ? Eigen::VectorXd(kKernelSet.targets.rowwise().mean())
                                   : Eigen::VectorXd(Eigen::VectorXd::Zero(3));
  const Eigen::MatrixXd targets = kKernelSet.targets.colwise() - mean;
  for (Eigen::Index i = 0; i < targets.cols(); ++i) {
    const Eigen::VectorXd error = targets.col(i) - dense(withoutColumn(samples(), i), withoutColumn(targets, i),
                                                         GetParam(), kKernelRidge, samples().col(i));
    EXPECT_LT((byInverse.residuals.col(i) - error).cwiseAbs().maxCoeff(), kKernelTolerance) << i;
    EXPECT_LT((byEigenvalues.residuals.col(i) - error).cwiseAbs().maxCoeff(), kKernelTolerance) << i;
  }
}

std::string tailName(const testing::TestParamInfo<Tail>& tail) {
  switch (tail.param) {
  case Tail::None:
    return "NoTail";
  case Tail::Bias:
    return "ABias";
  case Tail::Linear:
    return "ALinearTail";
  case Tail::LinearPenalised:
    return "APenalisedTail";
  }
  return "";
}

INSTANTIATE_TEST_SUITE_P(Tails, KernelSystemWith,
                         testing::Values(Tail::None, Tail::Bias, Tail::Linear, Tail::LinearPenalised), tailName);

TEST(KernelSystem, PenalisesALinearTailThatWouldLeaveTooFewSamples) {
  EXPECT_EQ(affordableTail(Tail::Linear, Eigen::MatrixXd::Random(5, 36)), Tail::Linear);
  EXPECT_EQ(affordableTail(Tail::Linear, Eigen::MatrixXd::Random(5, 9)), Tail::Linear); // 3 of 9 are left
  EXPECT_EQ(affordableTail(Tail::Linear, Eigen::MatrixXd::Random(5, 8)), Tail::LinearPenalised);
  EXPECT_EQ(affordableTail(Tail::Bias, Eigen::MatrixXd::Random(5, 2)), Tail::Bias);
}

} // namespace
} // namespace palp
