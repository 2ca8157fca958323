#include "nn/rbf/TailSpace.h"

#include "nn/linear/RandomNumbers.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr Eigen::Index kSamples = 30, kInputs = 4;
/// Sums of 30 products of numbers of order 1.
constexpr double kRounding = 1e-12;

Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed = 1) {
  RandomNumbers random(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](auto, auto) { return random.normal(); });
}

Eigen::MatrixXd inputs() {
  return randomMatrix(kInputs, kSamples);
}

Eigen::MatrixXd symmetric() {
  const Eigen::MatrixXd half = randomMatrix(kSamples, kSamples, 2);
  return half + half.transpose();
}

/// P = [inputs, 1], one row per sample.
Eigen::MatrixXd regressors() {
  Eigen::MatrixXd p(kSamples, kInputs + 1);
  p << inputs().transpose(), Eigen::VectorXd::Ones(kSamples);
  return p;
}

/// Q2 as a matrix.
Eigen::MatrixXd q2(const TailSpace& space) {
  const Eigen::Index rest = space.samples() - space.rank();
  return space.embed(Eigen::MatrixXd::Identity(rest, rest));
}

Eigen::MatrixXd lowerOf(const Eigen::MatrixXd& a) {
  return a.triangularView<Eigen::Lower>();
}

TEST(TailSpace, ItsBasesAreOrthonormalAndTheSecondIsOrthogonalToTheRegressors) {
  const TailSpace space(inputs(), Tail::Linear);
  ASSERT_EQ(space.rank(), kInputs + 1);
  Eigen::MatrixXd q(kSamples, kSamples);
  q << space.tailBasis(), q2(space);
  EXPECT_LT((q.transpose() * q - Eigen::MatrixXd::Identity(kSamples, kSamples)).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_LT((q2(space).transpose() * regressors()).cwiseAbs().maxCoeff(), kRounding);
}

TEST(TailSpace, ProjectingIsTheProductWithTheTransposedBasis) {
  const TailSpace space(inputs(), Tail::Linear);
  const Eigen::MatrixXd b = randomMatrix(kSamples, 3, 3);
  EXPECT_LT((space.project(b) - q2(space).transpose() * b).cwiseAbs().maxCoeff(), kRounding);
}

TEST(TailSpace, ProjectsASymmetricMatrixOnBothSidesAlsoInPlace) {
  const TailSpace space(inputs(), Tail::Linear);
  const Eigen::Index rest = kSamples - space.rank();
  const Eigen::MatrixXd expected = lowerOf(q2(space).transpose() * symmetric() * q2(space));
  const Eigen::MatrixXd copied = space.projectBothSides(lowerOf(symmetric()));
  EXPECT_LT((lowerOf(copied) - expected).cwiseAbs().maxCoeff(), kRounding);
  Eigen::MatrixXd inPlace = lowerOf(symmetric());
  space.projectInPlace(inPlace);
  EXPECT_LT((lowerOf(inPlace.bottomRightCorner(rest, rest)) - expected).cwiseAbs().maxCoeff(), kRounding);
}

TEST(TailSpace, SolvesForTheProjectionInPlace) {
  const TailSpace space(inputs(), Tail::Linear);
  const Eigen::Index rest = kSamples - space.rank();
  const Eigen::MatrixXd half = randomMatrix(rest, 2 * rest, 4);
  const Eigen::MatrixXd l = Eigen::LLT<Eigen::MatrixXd>(half * half.transpose() / static_cast<double>(rest)).matrixL();
  Eigen::MatrixXd a = randomMatrix(kSamples, kSamples, 5); // what is not the factor does not matter
  a.bottomRightCorner(rest, rest) = l;
  space.solveProjectionInPlace(a);
  const Eigen::MatrixXd expected = l.triangularView<Eigen::Lower>().solve(q2(space).transpose());
  EXPECT_LT((a.bottomRows(rest) - expected).cwiseAbs().maxCoeff(), 1e-11); // the factor's condition is below 10
}

TEST(TailSpace, CoefficientsAreThoseOfLeastSquaresTheBiasLast) {
  const TailSpace space(inputs(), Tail::Linear);
  const Eigen::MatrixXd b = randomMatrix(kSamples, 2, 3);
  const Eigen::MatrixXd expected = regressors().colPivHouseholderQr().solve(b);
  EXPECT_LT((space.coefficients(b) - expected).cwiseAbs().maxCoeff(), kRounding);
}

TEST(TailSpace, OfABiasAloneIsTheSpaceOfZeroMean) {
  const TailSpace space(inputs(), Tail::Bias);
  EXPECT_EQ(space.rank(), 1);
  EXPECT_LT(q2(space).colwise().sum().cwiseAbs().maxCoeff(), kRounding);
  const Eigen::VectorXd b = randomMatrix(kSamples, 1, 3);
  EXPECT_NEAR(space.coefficients(b)(0, 0), b.mean(), kRounding);
}

TEST(TailSpace, WithoutAnExactTailChangesNothing) {
  for (const Tail tail : {Tail::None, Tail::LinearPenalised}) {
    const TailSpace space(inputs(), tail);
    const Eigen::MatrixXd b = randomMatrix(kSamples, 2, 3);
    EXPECT_EQ(space.rank(), 0);
    EXPECT_EQ(space.project(b), b);
    EXPECT_EQ(space.embed(b), b);
    EXPECT_EQ(space.projectBothSides(symmetric()), symmetric());
    EXPECT_EQ(space.tailBasis().cols(), 0);
    EXPECT_EQ(space.coefficients(b).rows(), 0);
  }
}

TEST(TailSpace, InputsThatDependOnOthersTakeNoDimension) {
  Eigen::MatrixXd scaled = inputs();
  scaled.row(3) = scaled.row(0) - 2 * scaled.row(1);
  scaled.row(2).setConstant(0.5); // the bias has it already
  const TailSpace space(scaled, Tail::Linear);
  EXPECT_EQ(space.rank(), 3);
  EXPECT_LT((q2(space).transpose() * scaled.transpose()).cwiseAbs().maxCoeff(), kRounding);
}

} // namespace
} // namespace palp
