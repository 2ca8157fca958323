#include "nn/rbf/LeastSquaresSystem.h"

#include "nn/Basis.h"
#include "nn/NoisyCopies.h"
#include "tests/nn/Touches.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr double kSpread = 1, kRidge = 1e-3, kTailVariance = 10;
/// Normal equations keep half of the digits of a condition of some 1e4.
constexpr double kTolerance = 1e-8;

const test::Touches kSet = test::touches(8, 4, 1);

Eigen::MatrixXd leastSquaresSamples() {
  return kSet.samples.array() - 100;
}

struct SystemCase {
  const char* what;
  Tail tail;
  double noise;
  LeastSquaresMethod method = LeastSquaresMethod::PivotedQr;
};

void PrintTo(const SystemCase& one, std::ostream* out) {
  *out << one.what;
}

RbfOptions optionsOf(const SystemCase& one) {
  RbfOptions options;
  options.scaling = Scaling::Raw;
  options.centers = CenterChoice::Random;
  options.centerCount = 10;
  options.tail = one.tail;
  options.tailVariance = kTailVariance;
  options.method = one.method;
  options.relativeInputNoise = one.noise;
  options.noiseCopies = 3;
  return options;
}

/// The same least squares, dense: min |[Phi, P] [w; c] - y|^2 + ridge copies |w|^2, a penalised tail's c too.
struct Dense {
  Eigen::Index copies;
  Eigen::MatrixXd regressors; ///< rows x unknowns
  Eigen::MatrixXd targets;    ///< rows x outputs, less the mean
  Eigen::VectorXd penalty;    ///< of each unknown

  Dense(const SystemCase& one, const Eigen::MatrixXd& centers) : copies(one.noise > 0 ? 3 : 1) {
    const RbfOptions options = optionsOf(one);
    const Eigen::MatrixXd rows = noisyCopies(leastSquaresSamples(), one.noise, static_cast<int>(copies), options.seed);
    const Eigen::MatrixXd basis = gaussians(rows, centers), tail = tailOf(one.tail, rows);
    regressors.resize(rows.cols(), basis.cols() + tail.cols());
    regressors << basis, tail;
    const Eigen::VectorXd mean = kSet.targets.rowwise().mean();
    targets.resize(rows.cols(), 3);
    for (Eigen::Index i = 0; i < rows.cols(); ++i)
      targets.row(i) = (kSet.targets.col(i / copies) - (one.tail == Tail::None ? 0 : 1) * mean).transpose();
    penalty = Eigen::VectorXd::Constant(regressors.cols(), kRidge * static_cast<double>(copies));
    if (one.tail == Tail::LinearPenalised)
      penalty.tail(tail.cols()) /= kTailVariance;
    else
      penalty.tail(tail.cols()).setZero();
  }

  static Eigen::MatrixXd gaussians(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    const double rate = gaussianRate(kSpread, SpreadConvention::Radbas);
    return Eigen::MatrixXd::NullaryExpr(a.cols(), b.cols(), [&](Eigen::Index i, Eigen::Index j) {
      return std::exp(-rate * (a.col(i) - b.col(j)).squaredNorm());
    });
  }

  static Eigen::MatrixXd tailOf(Tail tail, const Eigen::MatrixXd& rows) {
    if (tail == Tail::None) return Eigen::MatrixXd(rows.cols(), 0);
    const Eigen::Index inputs = tail == Tail::Bias ? 0 : rows.rows();
    Eigen::MatrixXd p(rows.cols(), inputs + 1);
    p << rows.topRows(inputs).transpose(), Eigen::VectorXd::Ones(rows.cols());
    return p;
  }

  /// Unknowns from all rows but those of a sample (none: -1).
  [[nodiscard]] Eigen::MatrixXd solution(Eigen::Index left = -1) const {
    Eigen::MatrixXd a = regressors, b = targets;
    if (left >= 0) {
      a.middleRows(left * copies, copies).setZero();
      b.middleRows(left * copies, copies).setZero();
    }
    const Eigen::MatrixXd normal = a.transpose() * a + Eigen::MatrixXd(penalty.asDiagonal());
    return normal.fullPivLu().solve(a.transpose() * b);
  }
};

class LeastSquaresSystemOf : public testing::TestWithParam<SystemCase> {};

TEST_P(LeastSquaresSystemOf, ItsNetworkIsThatOfTheDenseNormalEquations) {
  const LeastSquaresSystem system(leastSquaresSamples(), kSet.targets, optionsOf(GetParam()), 3, {});
  ASSERT_EQ(system.centers().cols(), 10);
  const RbfSolution solution = system.solve(kSpread, kRidge, {});
  const RbfNetwork network{system.scaler(), system.centers(), kSpread,       SpreadConvention::Radbas,
                           solution.form,   solution.weights, solution.tail, solution.bias};
  const Eigen::MatrixXd fresh = test::touches(5, 4, 2).samples.array() - 100;
  Eigen::MatrixXd basis(fresh.cols(), 0);
  const Eigen::MatrixXd tail = Dense::tailOf(GetParam().tail, fresh);
  basis.resize(fresh.cols(), 10 + tail.cols());
  basis << Dense::gaussians(fresh, system.centers()), tail;
  Eigen::MatrixXd expected = (basis * Dense(GetParam(), system.centers()).solution()).transpose();
  if (GetParam().tail != Tail::None) expected.colwise() += kSet.targets.rowwise().mean();
  EXPECT_LT((network.predict(fresh) - expected).cwiseAbs().maxCoeff(), kTolerance);
  EXPECT_NEAR(solution.ridge, kRidge, 1e-12 * kRidge);
}

/// A sample is left out with all of its noisy copies.
TEST_P(LeastSquaresSystemOf, ItsLeaveOneOutErrorsAreThoseOfLeavingEachSampleOut) {
  const LeastSquaresSystem system(leastSquaresSamples(), kSet.targets, optionsOf(GetParam()), 3, {});
  const Eigen::MatrixXd residuals = system.leaveOneOut(kSpread, {1e-2, kRidge}, {}).back().residuals;
  const Dense dense(GetParam(), system.centers());
  ASSERT_EQ(residuals.cols(), kSet.samples.cols() * dense.copies);
  for (Eigen::Index i = 0; i < kSet.samples.cols(); ++i) {
    const auto rows = dense.regressors.middleRows(i * dense.copies, dense.copies);
    const Eigen::MatrixXd error = dense.targets.middleRows(i * dense.copies, dense.copies) - rows * dense.solution(i);
    EXPECT_LT((residuals.middleCols(i * dense.copies, dense.copies) - error.transpose()).cwiseAbs().maxCoeff(),
              10 * kTolerance)
        << i; // the errors are up to ten times the fit's
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, LeastSquaresSystemOf,
    testing::Values(SystemCase{"NoTail", Tail::None, 0}, SystemCase{"Bias", Tail::Bias, 0},
                    SystemCase{"Linear", Tail::Linear, 0}, SystemCase{"Penalised", Tail::LinearPenalised, 0},
                    SystemCase{"NoisyBias", Tail::Bias, 1e-3}, SystemCase{"NoisyLinear", Tail::Linear, 1e-3},
                    SystemCase{"NoisyPenalised", Tail::LinearPenalised, 1e-3},
                    SystemCase{"ByCholesky", Tail::LinearPenalised, 1e-3, LeastSquaresMethod::Cholesky},
                    SystemCase{"BySvd", Tail::Bias, 1e-3, LeastSquaresMethod::TruncatedSvd}),
    [](const auto& one) { return std::string(one.param.what); });

TEST(LeastSquaresSystem, TakesNoMoreCentresThanThereAreSamples) {
  RbfOptions options = optionsOf({"", Tail::Bias, 0});
  options.centerCount = 1000;
  const LeastSquaresSystem system(leastSquaresSamples(), kSet.targets, options, 1, {});
  EXPECT_EQ(system.centers(), leastSquaresSamples());
}

} // namespace
} // namespace palp
