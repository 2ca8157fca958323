#include "app/scenes/charts/ReportCharts.h"

#include "app/scenes/Picture.h"
#include "app/scenes/charts/Chart.h"
#include "app/scenes/charts/Heatmap.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

ChartSeries::Style style(ReportCurve::Style style) {
  switch (style) {
  case ReportCurve::Style::Line:
    return ChartSeries::Style::Line;
  case ReportCurve::Style::Points:
    return ChartSeries::Style::Points;
  case ReportCurve::Style::LineAndPoints:
    return ChartSeries::Style::LineAndPoints;
  }
  return ChartSeries::Style::Line;
}

constexpr int kMapWidth_px = 760, kMapAround_px = 230, kMapBeside_px = 90; // with axes, title and legend

/// The labels at the cells of a map along one side.
std::vector<std::string> places(double low_mm, double high_mm, Eigen::Index count) {
  std::vector<std::string> words;
  for (Eigen::Index i = 0; i < count; ++i)
    words.push_back(text(std::round(100 * (low_mm + (high_mm - low_mm) * double(i) / double(count - 1))) / 100));
  return words;
}

} // namespace

void drawReport(const ReportChart& chart, const std::filesystem::path& png) {
  ChartSpec spec;
  spec.title = chart.title;
  spec.xLabel = chart.xLabel;
  spec.yLabel = chart.yLabel;
  spec.logX = chart.logX;
  spec.logY = chart.logY;
  for (const ReportCurve& curve : chart.curves)
    spec.series.push_back({curve.name, curve.x, curve.y, style(curve.style), curve.dashed, curve.color});
  spec.topLabel = chart.topLabel;
  spec.topTicks = chart.topTicks;
  writePng(drawChart(spec), png);
}

void drawReport(const ReportMap& map, const std::filesystem::path& png) {
  HeatmapSpec spec;
  spec.title = map.title;
  spec.values = map.values;
  const auto numbers = map.values.reshaped();
  spec.colors = fittingScale(ColorMap::Viridis, {numbers.begin(), numbers.end()}, map.quantity, map.unit);
  spec.columnLabel = "x [mm]";
  spec.rowLabel = "y [mm]";
  spec.columnTicks = places(map.low_mm.x(), map.high_mm.x(), map.values.cols());
  spec.rowTicks = places(map.low_mm.y(), map.high_mm.y(), map.values.rows());
  const double share = (map.high_mm - map.low_mm).y() / (map.high_mm - map.low_mm).x(); // cells nearly square
  writePng(drawHeatmap(spec, kMapWidth_px,
                       std::clamp(static_cast<int>(kMapBeside_px + share * (kMapWidth_px - kMapAround_px)), 240, 1400)),
           png);
}

} // namespace palp
