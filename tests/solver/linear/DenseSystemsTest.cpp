#include "solver/linear/DenseSystems.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace palp {
namespace {

Eigen::MatrixXd wellConditioned(Eigen::Index n) {
  std::srand(1);
  return Eigen::MatrixXd::Random(n, n) + 4 * std::sqrt(double(n)) * Eigen::MatrixXd::Identity(n, n);
}

/// Below and above the size from which they are worked through in blocks, which is no multiple of a block's.
class Dense : public testing::TestWithParam<int> {};

TEST_P(Dense, SolvesWithRowPivots) {
  const Eigen::Index n = GetParam();
  Eigen::MatrixXd A = wellConditioned(n);
  A.row(0).swap(A.row(n - 1)); // without pivots this ends badly
  A(0, 0) = 0;
  const Eigen::VectorXd b = Eigen::VectorXd::Random(n);
  Eigen::MatrixXd work = A;
  Eigen::VectorXd x = b;
  ASSERT_TRUE(solveDense(work, x));
  EXPECT_LT((A * x - b).norm(), 1e-11 * b.norm());
  Eigen::MatrixXd singular = A;
  singular.col(n / 2).setZero();
  x = b;
  EXPECT_FALSE(solveDense(singular, x));
}

TEST_P(Dense, InvertsFromACholeskyFactor) {
  const Eigen::Index n = GetParam();
  const Eigen::MatrixXd L = wellConditioned(n).triangularView<Eigen::Lower>();
  Eigen::MatrixXd inverse = L;
  ASSERT_TRUE(invertFromCholesky(inverse));
  const Eigen::VectorXd x = Eigen::VectorXd::Random(n);
  const Eigen::VectorXd there = L * (L.transpose() * x);
  const Eigen::VectorXd back = inverse.selfadjointView<Eigen::Lower>() * there;
  EXPECT_LT((back - x).norm(), 1e-11 * x.norm());
}

INSTANTIATE_TEST_SUITE_P(Sizes, Dense, testing::Values(2, 50, 1000),
                         [](const auto& size) { return "Rows" + std::to_string(size.param); });

TEST(DenseStopped, EndsALargeOne) {
  std::stop_source stop;
  stop.request_stop();
  Eigen::MatrixXd A = wellConditioned(1000), L = A;
  Eigen::VectorXd x = Eigen::VectorXd::Ones(1000);
  EXPECT_FALSE(solveDense(A, x, stop.get_token()));
  EXPECT_FALSE(invertFromCholesky(L, stop.get_token()));
}

} // namespace
} // namespace palp
