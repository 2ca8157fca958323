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

TEST(LogarithmicColors, GiveEqualFactorsEqualSteps) {
  ColorScale scale{ColorMap::Viridis, 1e-4, 1e-1, "current density", "A/mm2 per A"};
  scale.logarithmic = true;
  EXPECT_NEAR(scale.share(1e-4), 0, 1e-12);
  EXPECT_NEAR(scale.share(1e-3), 1.0 / 3, 1e-12);
  EXPECT_NEAR(scale.share(1e-1), 1, 1e-12);
  for (const double share : {0.0, 0.3, 1.0}) EXPECT_NEAR(scale.share(scale.at(share)), share, 1e-12);
  EXPECT_EQ(scale.color(1e-7), scale.color(1e-4)) << "beyond the range is its last colour";
  const std::vector<double> ticks = decadeTicks(1e-4, 1e-1, 8), wanted{1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1};
  ASSERT_EQ(ticks.size(), wanted.size());
  for (std::size_t k = 0; k < ticks.size(); ++k) EXPECT_NEAR(ticks[k] / wanted[k], 1, 1e-12);
  EXPECT_EQ(decadeTicks(0.9e-3, 2.5e-2, 8).size(), 5u) << "1, 2, 5, 10, 20 thousandths";
}

} // namespace
} // namespace palp
