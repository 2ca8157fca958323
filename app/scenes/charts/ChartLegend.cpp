#include "app/scenes/charts/ChartLegend.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

// As vtkChartLegend lays out a label of 12 px: estimates, a little large.
constexpr double kNameLetter_px = 7.5;
constexpr double kNameLine_px = 21;
constexpr double kFrame_px = 48; ///< symbol and padding
constexpr double kAxes_px = 90;  ///< of the chart outside the plot, in each direction

} // namespace

LegendShare legendShare(const std::vector<std::string>& names, double scale, const std::array<double, 2>& chart_px) {
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  const double width = scale * (kFrame_px + kNameLetter_px * static_cast<double>(longest));
  const double height = scale * (12 + kNameLine_px * static_cast<double>(names.size()));
  const auto share = [scale](double part, double whole) {
    return std::clamp(part / std::max(whole - scale * kAxes_px, 1.0), 0.0, 0.6);
  };
  return {share(width, chart_px[0]), share(height, chart_px[1])};
}

LegendCorner freestCorner(const std::vector<std::vector<std::array<double, 2>>>& curves, const LegendShare& share) {
  LegendCorner best;
  best.covered = -1;
  for (const bool bottom : {false, true})
    for (const bool left : {false, true}) {
      LegendCorner corner{left, bottom, 0};
      for (const auto& curve : curves)
        for (const auto& [x, y] : curve)
          if ((left ? x : 1 - x) < share.width && (bottom ? y : 1 - y) < share.height) ++corner.covered;
      if (best.covered < 0 || corner.covered < best.covered) best = corner;
    }
  return best;
}

void addBetween(std::vector<std::array<double, 2>>& curve, std::array<double, 2> from, std::array<double, 2> to) {
  constexpr double kStep = 0.04;
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  if (!std::isfinite(length)) return;
  const int steps = std::min(static_cast<int>(length / kStep), 50);
  for (int k = 1; k < steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    curve.push_back({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
  }
}

} // namespace palp
