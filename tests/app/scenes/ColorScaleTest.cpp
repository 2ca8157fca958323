#include "app/scenes/ColorScale.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace palp {
namespace {

/// As far from grey as red and blue are from each other.
double tint(const Color& color) {
  return color[0] - color[2];
}

TEST(DivergingColors, AreWhiteAtZeroWhateverTheRange) {
  for (const auto& [low, high] : {std::pair{-1.0, 1.0}, {-0.04, 0.01}, {-0.001, 5.0}, {0.0, 2.0}, {-3.0, 0.0}}) {
    const ColorScale scale{ColorMap::Diverging, low, high, "stress zz", "MPa"};
    EXPECT_NEAR(tint(scale.color(0)), 0, 0.01) << low << " to " << high;
    EXPECT_GT(scale.color(0)[0], 0.95);
  }
}

TEST(DivergingColors, AreBlueBelowZeroAndRedAboveWithEqualStepsOnBothSides) {
  const ColorScale scale{ColorMap::Diverging, -0.04, 0.01, "stress zz", "MPa"};
  EXPECT_LT(tint(scale.color(-0.04)), -0.25);
  EXPECT_GT(tint(scale.color(0.01)), 0.2);
  const ColorScale wide{ColorMap::Diverging, -0.04, 0.04, "stress zz", "MPa"};
  for (const double value : {-0.03, -0.01, 0.005, 0.01}) EXPECT_EQ(scale.color(value), wide.color(value)) << value;
  EXPECT_EQ(scale.color(0.02), scale.color(0.01)) << "beyond the range is its last colour";
}

TEST(DivergingColors, OfARangeWithOneSignAreOneSideOfTheMap) {
  const ColorScale above{ColorMap::Diverging, 2, 3, "", ""}, below{ColorMap::Diverging, -3, -2, "", ""};
  EXPECT_NEAR(tint(above.color(2)), 0, 0.01);
  EXPECT_GT(tint(above.color(2.5)), 0.2);
  EXPECT_NEAR(tint(below.color(-2)), 0, 0.01);
  EXPECT_LT(tint(below.color(-2.5)), -0.2);
}

} // namespace
} // namespace palp
