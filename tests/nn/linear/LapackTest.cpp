#include "nn/linear/Lapack.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"
#include "nn/linear/RandomNumbers.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <algorithm>

namespace palp {
namespace {

/// Sums of some 200 products of numbers of order 1.
constexpr double kLapackRounding = 1e-12;

Eigen::MatrixXd lapackMatrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed = 1) {
  RandomNumbers random(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](auto, auto) { return random.normal(); });
}

/// Symmetric and positive definite, condition below 100.
Eigen::MatrixXd definite(Eigen::Index size) {
  const Eigen::MatrixXd half = lapackMatrix(size, 2 * size);
  return half * half.transpose() / static_cast<double>(size);
}

Eigen::MatrixXd lapackLower(const Eigen::MatrixXd& a) {
  return a.triangularView<Eigen::Lower>();
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return std::numeric_limits<double>::infinity();
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff();
}

TEST(Lapack, ProductsAreThoseOfEigenWithAndWithoutTransposing) {
  const Eigen::MatrixXd a = lapackMatrix(7, 11), b = lapackMatrix(11, 5, 2);
  EXPECT_LT(distance(lapack::product(a, false, b, false), a * b), kLapackRounding);
  EXPECT_LT(distance(lapack::product(a.transpose(), true, b, false), a * b), kLapackRounding);
  EXPECT_LT(distance(lapack::product(a, false, b.transpose(), true), a * b), kLapackRounding);
  EXPECT_LT(distance(lapack::product(a.transpose(), true, b.transpose(), true), a * b), kLapackRounding);
}

TEST(Lapack, ProductsReadBlocksOfLargerMatrices) {
  const Eigen::MatrixXd a = lapackMatrix(20, 20), b = lapackMatrix(20, 20, 2);
  EXPECT_LT(distance(lapack::product(a.block(3, 4, 7, 11), false, b.block(5, 2, 11, 6), false),
                     a.block(3, 4, 7, 11) * b.block(5, 2, 11, 6)),
            kLapackRounding);
}

TEST(Lapack, AProductOfNothingIsZero) {
  EXPECT_EQ(lapack::product(Eigen::MatrixXd(3, 0), false, Eigen::MatrixXd(0, 2), false), Eigen::MatrixXd::Zero(3, 2));
  EXPECT_EQ(lapack::product(Eigen::MatrixXd(0, 3), false, Eigen::MatrixXd(3, 2), false).size(), 0);
}

/// dgemm itself would read beyond the smaller one.
TEST(Lapack, SizesThatDoNotFitTogetherAreRefused) {
  const Eigen::MatrixXd a = lapackMatrix(4, 3), square = definite(4);
  Eigen::MatrixXd c = lapackMatrix(4, 4);
  EXPECT_THROW(lapack::product(a, false, a, false), NetworkError);
  EXPECT_THROW(lapack::product(a, true, lapackMatrix(3, 2), false), NetworkError);
  EXPECT_THROW(lapack::product(a, false, lapackMatrix(2, 4), true), NetworkError);
  EXPECT_THROW(lapack::subtractProduct(a, lapackMatrix(4, 2), c), NetworkError);
  EXPECT_THROW(lapack::subtractProduct(a, lapackMatrix(5, 3), c), NetworkError);
  EXPECT_THROW(lapack::symmetricProduct(square, lapackMatrix(3, 2)), NetworkError);
  EXPECT_THROW(lapack::symmetricProduct(a, lapackMatrix(4, 2)), NetworkError);
  EXPECT_THROW(lapack::subtractRankTwo(a, lapackMatrix(4, 2), c), NetworkError);
  EXPECT_THROW(lapack::subtractRankTwo(lapackMatrix(5, 3), a, c), NetworkError);
  EXPECT_THROW(lapack::solveLower(square, lapackMatrix(3, 1), false), NetworkError);
  EXPECT_THROW(static_cast<void>(lapack::PivotedQr(a).solve(lapackMatrix(3, 1), 3)), NetworkError);
}

TEST(Lapack, SubtractProductIsAnUpdateInPlace) {
  const Eigen::MatrixXd a = lapackMatrix(6, 4), b = lapackMatrix(5, 4, 2), c = lapackMatrix(9, 9, 3);
  Eigen::MatrixXd updated = c;
  lapack::subtractProduct(a, b, updated.block(2, 3, 6, 5));
  Eigen::MatrixXd expected = c;
  expected.block(2, 3, 6, 5) -= a * b.transpose();
  EXPECT_LT(distance(updated, expected), kLapackRounding);
}

TEST(Lapack, GramHasBothTrianglesInBlocksOfRowsToo) {
  for (const Eigen::Index rows : {Eigen::Index{5}, lapack::kRowsAtOnce, 2 * lapack::kRowsAtOnce + 17}) {
    const Eigen::MatrixXd a = lapackMatrix(rows, 6);
    EXPECT_LT(distance(lapack::gram(a), a.transpose() * a), 1e-15 * static_cast<double>(rows) * 100) << rows;
  }
}

TEST(Lapack, SymmetricProductReadsTheLowerTriangleAlone) {
  const Eigen::MatrixXd a = definite(8), b = lapackMatrix(8, 3, 2);
  EXPECT_LT(distance(lapack::symmetricProduct(lapackLower(a), b), a * b), kLapackRounding);
}

TEST(Lapack, SubtractRankTwoUpdatesTheLowerTriangleAlone) {
  const Eigen::MatrixXd u = lapackMatrix(7, 3), v = lapackMatrix(7, 3, 2), c = definite(7);
  Eigen::MatrixXd updated = c;
  lapack::subtractRankTwo(u, v, updated);
  const Eigen::MatrixXd expected = c - u * v.transpose() - v * u.transpose();
  EXPECT_LT(distance(lapackLower(updated), lapackLower(expected)), kLapackRounding);
  EXPECT_EQ(Eigen::MatrixXd(updated.triangularView<Eigen::StrictlyUpper>()),
            Eigen::MatrixXd(c.triangularView<Eigen::StrictlyUpper>()));
}

TEST(Lapack, SemidefinitePivotsSpanTheRangeAndNoMore) {
  const Eigen::MatrixXd half = lapackMatrix(20, 6);
  const Eigen::MatrixXd a = half * half.transpose();
  Eigen::MatrixXd work = lapackLower(a);
  std::vector<int> pivots = lapack::semidefinitePivots(work);
  ASSERT_EQ(pivots.size(), 6U);
  const Eigen::MatrixXd columns = a(Eigen::all, pivots);
  EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(columns).rank(), 6);
  Eigen::Index first = 0;
  a.diagonal().maxCoeff(&first);
  EXPECT_EQ(pivots[0], first); // the largest diagonal leads
  std::sort(pivots.begin(), pivots.end());
  EXPECT_EQ(std::unique(pivots.begin(), pivots.end()), pivots.end());
}

TEST(Lapack, PivotedQrSolvesAsEigensDoes) {
  const Eigen::MatrixXd a = lapackMatrix(20, 8), b = lapackMatrix(20, 3, 2);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> reference(a);
  const lapack::PivotedQr qr(a);
  EXPECT_EQ(qr.rank(1e-15), 8);
  EXPECT_LT(distance(qr.solve(b, 8), reference.solve(b)), kLapackRounding);
  const Eigen::VectorXd diagonal = reference.matrixR().diagonal().cwiseAbs();
  EXPECT_NEAR(qr.condition(), diagonal.maxCoeff() / diagonal.minCoeff(), 1e-10 * qr.condition());
  EXPECT_LT(distance(qr.r().diagonal().cwiseAbs(), diagonal), kLapackRounding);
}

TEST(Lapack, PivotedQrGivesABasicSolutionWhereColumnsDepend) {
  Eigen::MatrixXd a = lapackMatrix(20, 8);
  a.col(5) = a.col(1) + a.col(2);
  const Eigen::MatrixXd b = a * lapackMatrix(8, 2, 3);
  const lapack::PivotedQr qr(a);
  ASSERT_EQ(qr.rank(1e-13), 7);
  const Eigen::MatrixXd x = qr.solve(b, 7);
  EXPECT_LT(distance(a * x, b), kLapackRounding);
  EXPECT_EQ((x.array() == 0).rowwise().all().count(), 1); // the column that was left out
}

TEST(Lapack, PivotedQrLeavesFixedColumnsInFront) {
  Eigen::MatrixXd a = lapackMatrix(20, 8);
  a.col(7) *= 1000; // would come first
  const lapack::PivotedQr qr(a, 3);
  const Eigen::MatrixXd r = Eigen::HouseholderQR<Eigen::MatrixXd>(a.leftCols(3)).matrixQR().topRows(3);
  EXPECT_LT(distance(qr.r().diagonal().head(3).cwiseAbs(), r.diagonal().cwiseAbs()), kLapackRounding);
  EXPECT_GT(std::abs(qr.r()(3, 3)), 100); // the large one is the first that is free
}

TEST(Lapack, TheBlockReflectorIsTheQOfTheFactorisation) {
  const Eigen::MatrixXd a = lapackMatrix(12, 5);
  const lapack::PivotedQr qr(a);
  const lapack::PivotedQr::BlockReflector reflector = qr.blockReflector();
  const Eigen::MatrixXd q = Eigen::MatrixXd::Identity(12, 12) - reflector.v * reflector.t * reflector.v.transpose();
  EXPECT_LT(distance(q.transpose() * q, Eigen::MatrixXd::Identity(12, 12)), kLapackRounding);
  EXPECT_LT(distance(qr.applyQTransposed(Eigen::MatrixXd::Identity(12, 12)), q.transpose()), kLapackRounding);
  const Eigen::MatrixXd inBasis = q.transpose() * a; // A P = Q R: below R nothing is left
  EXPECT_LT(inBasis.bottomRows(7).cwiseAbs().maxCoeff(), kLapackRounding);
}

TEST(Lapack, CholeskyIsEigensAndRefusesAnIndefiniteMatrix) {
  const Eigen::MatrixXd a = definite(9);
  Eigen::MatrixXd factor = a;
  ASSERT_TRUE(lapack::choleskyInPlace(factor));
  EXPECT_LT(distance(factor, Eigen::LLT<Eigen::MatrixXd>(a).matrixL()), kLapackRounding);
  factor = a;
  factor(4, 4) = -1;
  EXPECT_FALSE(lapack::choleskyInPlace(factor));
  factor = a;
  factor(8, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lapack::choleskyInPlace(factor));
}

TEST(Lapack, SolveLowerSolvesWithTheFactorAndWithItsTranspose) {
  const Eigen::MatrixXd l = Eigen::LLT<Eigen::MatrixXd>(definite(9)).matrixL(), b = lapackMatrix(9, 4, 2);
  EXPECT_LT(distance(lapack::solveLower(l, b, false), l.triangularView<Eigen::Lower>().solve(b)), kLapackRounding);
  EXPECT_LT(distance(lapack::solveLower(l, b, true), l.transpose().triangularView<Eigen::Upper>().solve(b)),
            kLapackRounding);
}

TEST(Lapack, InvertLowerWorksInHalvesAndLeavesTheUpperTriangle) {
  for (const Eigen::Index size : {1, 5, 64, 65, 200}) {
    const Eigen::MatrixXd l = Eigen::LLT<Eigen::MatrixXd>(definite(size)).matrixL();
    Eigen::MatrixXd inverse = l;
    inverse.triangularView<Eigen::StrictlyUpper>().setConstant(7);
    lapack::invertLowerInPlace(inverse);
    EXPECT_LT(distance(l * lapackLower(inverse), Eigen::MatrixXd::Identity(size, size)), kLapackRounding) << size;
    if (size > 1) {
      EXPECT_EQ(inverse(0, size - 1), 7);
    }
  }
}

TEST(Lapack, SymmetricEigenIsEigensAndReadsTheLowerTriangleAlone) {
  const Eigen::MatrixXd a = definite(10) - 2 * Eigen::MatrixXd::Identity(10, 10); // of both signs
  const lapack::SymmetricEigen ours = lapack::symmetricEigen(lapackLower(a));
  EXPECT_LT(distance(ours.values, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues()), kLapackRounding);
  EXPECT_LT(distance(ours.vectors * ours.values.asDiagonal() * ours.vectors.transpose(), a), kLapackRounding);
}

TEST(Lapack, ThinSvdIsEigensForTallAndForWideMatrices) {
  for (const auto& [rows, columns] : {std::pair{12, 5}, {5, 12}, {6, 6}, {1, 4}}) {
    const Eigen::MatrixXd a = lapackMatrix(rows, columns);
    const lapack::ThinSvd ours = lapack::thinSvd(a);
    const Eigen::JacobiSVD<Eigen::MatrixXd> reference(a);
    EXPECT_LT(distance(ours.values, reference.singularValues()), kLapackRounding);
    EXPECT_LT(distance(ours.u * ours.values.asDiagonal() * ours.vTransposed, a), kLapackRounding);
  }
  EXPECT_EQ(lapack::thinSvd(Eigen::MatrixXd(4, 0)).values.size(), 0);
}

TEST(Lapack, SvdOfGramIsTheSvdOfATallMatrixWithoutItsSmallestValues) {
  Eigen::MatrixXd a = lapackMatrix(lapack::kRowsAtOnce + 100, 6);
  a.col(5) = a.col(0) + 1e-9 * a.col(5); // below 1e-7 of the largest
  const lapack::ThinSvd ours = lapack::svdOfGram(a);
  const Eigen::JacobiSVD<Eigen::MatrixXd> reference(a);
  ASSERT_EQ(ours.values.size(), 5);
  // Half of the digits go where a^T a is formed.
  EXPECT_LT(distance(ours.values, reference.singularValues().head(5)), 1e-7 * reference.singularValues()(0));
  EXPECT_LT(distance(ours.u * ours.values.asDiagonal() * ours.vTransposed, a), 1e-7 * reference.singularValues()(0));
  EXPECT_LT(distance(ours.u.transpose() * ours.u, Eigen::MatrixXd::Identity(5, 5)), 1e-7);
}

} // namespace
} // namespace palp
