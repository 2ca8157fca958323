#include "model/base/Monomials.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(Monomials, AreAllOfTheDegreesInTheStatedOrder) {
  Eigen::MatrixXi expected(2, 5);
  expected << 1, 0, 2, 1, 0, //
      0, 1, 0, 1, 2;
  EXPECT_EQ(monomialExponents(2, 1, 2), expected);
  const Eigen::MatrixXi three = monomialExponents(3, 0, 4);
  EXPECT_EQ(three.cols(), 35); // 7! / (3! 4!)
  for (Eigen::Index t = 1; t < three.cols(); ++t) EXPECT_LE(three.col(t - 1).sum(), three.col(t).sum()) << t;
}

TEST(Monomials, OfNoVariableAreTheConstantAlone) {
  EXPECT_EQ(monomialExponents(0, 0, 3).cols(), 1);
  EXPECT_EQ(monomialExponents(0, 1, 3).cols(), 0);
}

} // namespace
} // namespace palp
