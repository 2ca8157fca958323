#include "model/BoxGreen.h"

#include "model/FieldAtRest.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace palp {
namespace {

constexpr int kLower = 100; ///< first lower electrode of the paper's design

const BoxGreen& paperGreen() {
  static const BoxGreen green = boxGreen(paperDesign().block_mm, electrodes_mm(paperDesign()));
  return green;
}

/// Points in a box, no nearer to each other and to the walls than `apart`.
Eigen::Matrix3Xd randomPoints(const Eigen::Vector3d& block, int count, double apart, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Eigen::Matrix3Xd points(3, count);
  for (int p = 0; p < count;) {
    for (int axis = 0; axis < 3; ++axis) points(axis, p) = apart + (block(axis) - 2 * apart) * uniform(engine);
    const bool free = p == 0 || (points.leftCols(p).colwise() - points.col(p)).colwise().norm().minCoeff() > apart;
    p += free ? 1 : 0;
  }
  return points;
}

TEST(BoxGreen, OfThePapersBoxIsThatOfAnIndependentProgram) {
  const BoxGreen& green = paperGreen();
  const double digits = 1e-13; // as many as are known
  EXPECT_NEAR(green.value(0, kLower), 0.14309273633674, digits);
  EXPECT_NEAR(green.value(44, kLower + 16 * 3 + 2), -0.00811945150652, digits);
  EXPECT_NEAR(green.value(0, 0), 0.215916796504, 1e-12);
  EXPECT_NEAR(green.value(44, 44), 0.031199007599, 1e-12);
  EXPECT_NEAR(green.value(kLower, kLower), 0.212979369414, 1e-12);
}

/// An Ewald sum of another program, with ten digits: the potential of a source and a sink.
TEST(BoxGreen, OfASourceAndASinkIsTheEwaldSum) {
  const Eigen::Vector3d block(30, 30, 5);
  Eigen::Matrix3Xd points(3, 3);
  points.col(0) << 13.5, 13.5, 4;
  points.col(1) << 15.5, 15, 1;
  points.col(2) << 15, 15, 2.5;
  const BoxGreen green = boxGreen(block, points);
  EXPECT_NEAR(green.value(2, 0) - green.value(2, 1), -0.0236816921, 1e-10);
}

/// A thin box is a sheet: far from both ends the potential falls by I s / (area) along it.
TEST(BoxGreen, OfALongRodFallsLinearly) {
  const Eigen::Vector3d rod(40, 1, 2);
  Eigen::Matrix3Xd points(3, 4);
  points << 2, 38, 15, 25, 0.3, 0.5, 0.4, 0.7, 1.1, 0.2, 1.3, 0.6;
  const BoxGreen green = boxGreen(rod, points);
  const double fall = (green.value(2, 0) - green.value(2, 1)) - (green.value(3, 0) - green.value(3, 1));
  EXPECT_NEAR(fall, 10 / 2.0, 1e-8); // what varies across the rod falls by exp(-pi x / 2)
}

TEST(BoxGreen, IsSymmetric) {
  const BoxGreen green = boxGreen({7, 20, 3}, randomPoints({7, 20, 3}, 40, 0.2, 1), true);
  EXPECT_LT((green.value - green.value.transpose()).cwiseAbs().maxCoeff(), 1e-15);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      Eigen::MatrixXd other = green.curvature.mixed[3 * j + i].transpose();
      const Eigen::MatrixXd& one = green.curvature.mixed[3 * i + j];
      EXPECT_LT((one - other).cwiseAbs().maxCoeff(), 1e-12 * one.cwiseAbs().maxCoeff());
    }
}

/// Two boxes joined at a wall, with a mirrored source, are one: G of the half box at its sources is the sum of both.
TEST(BoxGreen, OfTheHalfBoxIsThatOfTheWholeWithItsMirrorImage) {
  const Eigen::Vector3d whole(12, 9, 4), half(6, 9, 4);
  const Eigen::Matrix3Xd inHalf = randomPoints(half, 10, 0.3, 2);
  Eigen::Matrix3Xd inWhole(3, 20);
  inWhole << inHalf, inHalf;
  for (int p = 10; p < 20; ++p) inWhole(0, p) = 12 - inWhole(0, p);
  const BoxGreen a = boxGreen(half, inHalf), b = boxGreen(whole, inWhole);
  const Eigen::MatrixXd sum = b.value.topLeftCorner(10, 10) + b.value.topRightCorner(10, 10);
  EXPECT_LT((a.value - sum).cwiseAbs().maxCoeff(), 1e-14);
}

/// x -> s x makes G -> G / s; the regular part as well.
TEST(BoxGreen, FallsWithTheSizeOfTheBox) {
  const Eigen::Vector3d block(5, 8, 2);
  const Eigen::Matrix3Xd points = randomPoints(block, 12, 0.1, 3);
  for (const double s : {1e-2, 7.0, 1e3})
    EXPECT_LT((s * boxGreen(s * block, s * points).value - boxGreen(block, points).value).cwiseAbs().maxCoeff(), 1e-13);
}

/// Derivatives by central differences, those of the regular part (diagonal) among them.
TEST(BoxGreen, SlopesAreDerivatives) {
  const Eigen::Vector3d block(6, 9, 3);
  const Eigen::Matrix3Xd points = randomPoints(block, 8, 0.5, 4);
  const BoxGreen green = boxGreen(block, points, true);
  const double step = 1e-4; // truncation 1e-8 of the third derivatives, rounding 1e-12 over it
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
      Eigen::Matrix3Xd above = points, below = points;
      above(axis, p) += step;
      below(axis, p) -= step;
      const BoxGreen high = boxGreen(block, above), low = boxGreen(block, below);
      const auto i = static_cast<std::size_t>(axis);
      const Eigen::MatrixXd slope = (high.value - low.value) / (2 * step);
      for (Eigen::Index q = 0; q < points.cols(); ++q)
        EXPECT_NEAR(slope(p, q), (p == q ? 2 : 1) * green.slope[i](p, q), 1e-6);
      for (std::size_t j = 0; j < 3; ++j) {
        const Eigen::MatrixXd change = (high.slope[j] - low.slope[j]) / (2 * step);
        constexpr std::size_t kPlace[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
        for (Eigen::Index q = 0; q < points.cols(); ++q) {
          if (p != q) { // slope[j](p, q) is by x_p, slope[j](q, p) by x_q
            EXPECT_NEAR(change(p, q), green.curvature.own[kPlace[j][i]](p, q), 1e-5);
          }
          EXPECT_NEAR(change(q, p), green.curvature.mixed[3 * j + i](q, p), 1e-5);
        }
      }
    }
}

} // namespace
} // namespace palp
