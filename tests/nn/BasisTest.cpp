#include "nn/Basis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

TEST(Basis, RadbasIsOneHalfAtItsSpread) {
  EXPECT_NEAR(std::exp(-gaussianRate(1.7, SpreadConvention::Radbas) * 1.7 * 1.7), 0.5, 1e-15);
}

TEST(Basis, TheConventionsDifferByAFactorOfTheSpreadOnly) {
  const double factor = 1 / std::sqrt(2 * std::log(2.0));
  EXPECT_NEAR(factor, 0.849, 5e-4);
  EXPECT_NEAR(gaussianRate(2, SpreadConvention::Radbas), gaussianRate(2 * factor, SpreadConvention::Sigma), 1e-15);
}

TEST(Basis, TheVectorExponentialAgreesWithTheLibrarys) {
  Eigen::MatrixXd values(1001, 1);
  for (int i = 0; i <= 1000; ++i) values(i) = 0.7 * i;
  const Eigen::MatrixXd arguments = values;
  basisInPlace(values, 1);
  for (int i = 0; i <= 1000; ++i) // 4 ulp; both round
    EXPECT_NEAR(values(i) / std::exp(-arguments(i)), 1, 9e-16) << arguments(i);
}

TEST(Basis, FarAwayTheGaussianIsZeroAndNoNumberGoesWrong) {
  Eigen::MatrixXd values(3, 1);
  values << 1e4, 1e300, std::numeric_limits<double>::infinity();
  basisInPlace(values, 1);
  EXPECT_EQ(values.cwiseAbs().maxCoeff(), 0);
}

TEST(Basis, TheRemainderKeepsItsDigitsForSmallArguments) {
  for (const double t : {1e-9, 1e-4, 0.1, 0.999, 1.001, 3.0, 50.0}) {
    Eigen::MatrixXd value = Eigen::MatrixXd::Constant(1, 1, t);
    basisInPlace(value, 1, BasisForm::Remainder);
    const long double wide = t; // with 19 digits the plain sum is good from 0.05 on
    const long double exact =
        t < 0.05L ? wide * wide / 2 * (1 - wide / 3 * (1 - wide / 4 * (1 - wide / 5))) : std::exp(-wide) - 1 + wide;
    EXPECT_NEAR(value(0) / static_cast<double>(exact), 1, 1e-14) << t; // a few roundings
  }
}

TEST(Basis, TheRemainderIsTheSameAloneAndAmongLargeAndSmallOnes) {
  Eigen::MatrixXd values(203, 1); // full groups of 64, full vectors of 8, and a remainder
  for (int i = 0; i < values.size(); ++i) values(i) = i < 64 ? i / 64.0 : i < 128 ? i : 0.1 * (i % 23);
  Eigen::MatrixXd together = values;
  basisInPlace(together, 1, BasisForm::Remainder);
  for (int i = 0; i < values.size(); ++i) {
    Eigen::MatrixXd alone = Eigen::MatrixXd::Constant(1, 1, values(i));
    basisInPlace(alone, 1, BasisForm::Remainder);
    EXPECT_EQ(together(i), alone(0)) << values(i);
  }
}

TEST(Basis, SquaredDistancesAreThoseOfTheColumns) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(7, 19), b = Eigen::MatrixXd::Random(7, 5);
  const Eigen::MatrixXd distances = squaredDistances(a, b);
  for (int i = 0; i < 19; ++i)
    for (int j = 0; j < 5; ++j) EXPECT_NEAR(distances(i, j), (a.col(i) - b.col(j)).squaredNorm(), 1e-14);
  const Eigen::MatrixXd lower = squaredDistances(a, a).triangularView<Eigen::Lower>();
  EXPECT_LT((squaredDistances(a) - lower).cwiseAbs().maxCoeff(), 1e-14);
}

} // namespace
} // namespace palp
