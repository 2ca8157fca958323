#pragma once

#include <array>
#include <string>
#include <vector>

namespace palp {

/// Size of a legend as shares of the plot's width and height.
struct LegendShare {
  double width = 0;
  double height = 0;
};
LegendShare legendShare(const std::vector<std::string>& names, double scale, const std::array<double, 2>& chart_px);

/// A corner of the plot; the upper right one first.
struct LegendCorner {
  bool left = false;
  bool bottom = false;
  int covered = 0; ///< points that a legend there covers
};

/// The corner where a legend covers the fewest points; these are shares 0..1 of the axes, one list a curve.
LegendCorner freestCorner(const std::vector<std::vector<std::array<double, 2>>>& curves, const LegendShare& share);

/// Points on the way between two, so that lines count as well.
void addBetween(std::vector<std::array<double, 2>>& curve, std::array<double, 2> from, std::array<double, 2> to);

} // namespace palp
