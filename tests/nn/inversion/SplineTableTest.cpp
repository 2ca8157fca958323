#include "nn/inversion/SplineTable.h"

#include <gtest/gtest.h>

#include <array>

namespace palp {
namespace {

/// f = 2 + a (x^3 - x y) + a b^2 y^2 and its double: cubic in each place, which splines through its values are exactly.
SplineTable cubic() {
  SplineTable table;
  table.place = {1, 3}; // inputs a, x, b, y
  table.low = {-1, 0};
  table.step = {0.5, 0.4};
  table.nodes = {9, 7};
  table.shift = Eigen::Vector4d(3, 0, 0, 0);
  table.exponents.resize(4, 2);
  table.exponents << 1, 1, 0, 0, 0, 2, 0, 0;
  table.rest = Eigen::Vector2d(2, 4);
  Eigen::MatrixXd values(2, 2 * 9 * 7);
  for (int iy = 0; iy < 7; ++iy)
    for (int ix = 0; ix < 9; ++ix) {
      const double x = -1 + 0.5 * ix, y = 0.4 * iy;
      values.col(2 * (ix + 9 * iy)) = (x * x * x - x * y) * Eigen::Vector2d(1, 2);
      values.col(1 + 2 * (ix + 9 * iy)) = y * y * Eigen::Vector2d(1, 2);
    }
  table.interpolate(values);
  return table;
}

TEST(SplineTable, IsExactForCubics) {
  const SplineTable table = cubic();
  Eigen::VectorXd value;
  Eigen::MatrixXd slope;
  for (const auto& [a, x, b, y] : {std::array{0.3, 0.12, -0.7, 1.1}, {-1.0, -0.5, 0.5, 0.4}, {0.0, 2.4, 1.5, 1.95}}) {
    table.evaluate(Eigen::Vector4d(a, x, b, y), value, slope);
    const double s = a + 3;
    EXPECT_NEAR(value(0), 2 + s * (x * x * x - x * y) + s * b * b * y * y, 1e-11);
    EXPECT_NEAR(value(1), 2 * value(0), 1e-11);
    EXPECT_NEAR(slope(0, 0), x * x * x - x * y + b * b * y * y, 1e-10);
    EXPECT_NEAR(slope(0, 1), s * (3 * x * x - y), 1e-10);
    EXPECT_NEAR(slope(0, 2), 2 * s * b * y * y, 1e-10);
    EXPECT_NEAR(slope(1, 3), 2 * (-s * x + 2 * s * b * b * y), 1e-10);
  }
}

TEST(SplineReader, SaysWhatTheRoundedTableSays) {
  SplineTable table = cubic();
  table.coefficients *= 1000; // parts beyond 65536, too
  table.round();
  const SplineReader reader(table);
  Eigen::VectorXd value, same;
  Eigen::MatrixXd slope, sameSlope;
  for (const auto& [a, x, b, y] : {std::array{0.3, 0.12, -0.7, 1.1}, {-1.0, -0.5, 0.5, 0.4}, {0.0, 2.4, 1.5, 1.95}}) {
    table.evaluate(Eigen::Vector4d(a, x, b, y), value, slope);
    reader.evaluate(Eigen::Vector4d(a, x, b, y), same, sameSlope);
    EXPECT_LT((value - same).norm(), 1e-13 * value.norm());
    EXPECT_LT((slope - sameSlope).norm(), 1e-12 * slope.norm());
  }
}

TEST(SplineTable, StaysAsAtItsEdgeBeyondIt) {
  const SplineTable table = cubic();
  Eigen::VectorXd edge, beyond;
  Eigen::MatrixXd slope;
  table.evaluate(Eigen::Vector4d(1, 2.5, 0, 1), edge, slope);
  table.evaluate(Eigen::Vector4d(1, 9, 0, 1), beyond, slope);
  EXPECT_EQ(edge, beyond);
}

} // namespace
} // namespace palp
