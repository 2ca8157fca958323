#include "solver/field/TetRule.h"

#include "solver/element/ElementGeometry.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <random>

namespace palp {
namespace {

using Values = Eigen::Matrix<double, 10, 1>;

/// Share of a tetrahedron in which what is linear between these values at its corners is positive (all different):
/// sum over the positive ones of v^3 / product of (v - the others), by divided differences of max(v, 0)^3.
double positiveShare(const Eigen::Vector4d& v) {
  double share = 0;
  for (int i = 0; i < 4; ++i) {
    double product = 1;
    for (int j = 0; j < 4; ++j)
      if (j != i) product *= v(i) - v(j);
    if (v(i) > 0) share += v(i) * v(i) * v(i) / product;
  }
  return share;
}

Values atNodes(const Eigen::Vector4d& corners) {
  Values values;
  for (int n = 0; n < 10; ++n) values(n) = corners.dot(tetNode(n));
  return values;
}

} // namespace

TEST(TetPointsAroundKink, AreThoseOfTheRuleWhereNoSignChanges) {
  for (const double sign : {-1., 1.}) {
    const std::vector<TetPoint> points = tetPointsAroundKink(sign * Values::Ones());
    ASSERT_EQ(points.size(), std::size_t(TetRule::points));
    for (std::size_t q = 0; q < points.size(); ++q) {
      EXPECT_EQ(points[q].barycentric, tetRule().barycentric[q]);
      EXPECT_EQ(points[q].weight, tetRule().weights[q]);
    }
  }
}

TEST(TetPointsAroundKink, HaveTheVolumeOnEitherSideOfAPlane) {
  std::mt19937 engine(5);
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::Vector4d corners;
    for (double& v : corners) v = engine() / 2147483648. - 1;
    double positive = 0, all = 0;
    for (const TetPoint& point : tetPointsAroundKink(atNodes(corners))) {
      EXPECT_GE(point.barycentric.minCoeff(), 0);
      EXPECT_NEAR(point.barycentric.sum(), 1, 1e-12);
      EXPECT_GE(point.weight, 0);
      all += point.weight;
      if (corners.dot(point.barycentric) > 0) positive += point.weight;
    }
    EXPECT_NEAR(all, 1, 1e-12);
    EXPECT_NEAR(positive, positiveShare(corners), 1e-9) << corners.transpose();
  }
}

TEST(TetPointsAroundKink, FillTheTetrahedronWhateverNodesArePositive) {
  // Exact to degree 2 on each piece, so on the whole: the integral of the product of two coordinates is 1/20, of a
  // square 1/10 of the volume.
  const Eigen::Matrix4d exact = (Eigen::Matrix4d::Ones() + Eigen::Matrix4d::Identity()) / 20;
  for (unsigned pattern = 0; pattern < 1024; ++pattern) {
    Values values;
    for (int n = 0; n < 10; ++n) values(n) = (pattern >> unsigned(n)) % 2 == 1 ? 1 + n : -2. / (1 + n);
    Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
    for (const TetPoint& point : tetPointsAroundKink(values)) {
      EXPECT_GE(point.barycentric.minCoeff(), 0) << pattern;
      moments += point.weight * point.barycentric * point.barycentric.transpose();
    }
    EXPECT_LT((moments - exact).norm(), 1e-12) << pattern;
  }
}

TEST(TetPointsAroundKink, AZeroAtANodeLeavesNothingOut) {
  for (const Eigen::Vector4d& corners : {Eigen::Vector4d(1, 0, 0, 0), Eigen::Vector4d(0, 0, -1, 1),
                                         Eigen::Vector4d(0, -1, 0, 0), Eigen::Vector4d(1, 1, 0, 0)}) {
    double all = 0;
    for (const TetPoint& point : tetPointsAroundKink(atNodes(corners))) {
      EXPECT_TRUE(point.barycentric.allFinite()) << corners.transpose();
      all += point.weight;
    }
    EXPECT_NEAR(all, 1, 1e-12) << corners.transpose();
  }
}

} // namespace palp
