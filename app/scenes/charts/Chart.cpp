#include "app/scenes/charts/Chart.h"

#include "app/scenes/charts/AxisMarks.h"
#include "app/scenes/charts/ChartLegend.h"
#include "app/scenes/charts/ChartRenderer.h"
#include "app/scenes/charts/TextStyle.h"
#include "app/scenes/gl/OffscreenWindow.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp {

namespace {

// Labels of 12 px: estimates, a little large.
constexpr double kLetter_px = 7.5;
constexpr double kGap_px = 8;
constexpr double kAxisLine_px = 16;
constexpr double kBesidePlot_px = 70;  ///< on one side, by which the plot is off the middle
constexpr double kMostLegend = 0.4;    ///< of the height or width that a legend may take from the curves
constexpr double kAroundPlot_px = 100; ///< of the picture along an axis

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool empty() const { return low > high; }
};

bool shown(double value, bool logarithmic) {
  return std::isfinite(value) && (!logarithmic || value > 0);
}

/// The pairs of a series that the axes can show.
struct Points {
  std::vector<double> x, y;
};

Points shownPoints(const ChartSeries& series, const ChartSpec& spec) {
  Points points;
  for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
    if (!shown(series.x[k], spec.logX) || !shown(series.y[k], spec.logY)) continue;
    points.x.push_back(series.x[k]);
    points.y.push_back(series.y[k]);
  }
  return points;
}

/// All values and a little more; a single value gets room around it.
Range padded(Range range, bool logarithmic) {
  if (range.empty()) return logarithmic ? Range{1, 10} : Range{0, 1};
  if (logarithmic) {
    const double factor = std::max(std::pow(range.high / range.low, 0.05), 1.15);
    return {range.low / factor, range.high * factor};
  }
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  const double margin =
      range.high - range.low > 1e-12 * size ? 0.04 * (range.high - range.low) : (size > 0 ? 0.1 * size : 1);
  return {range.low - margin, range.high + margin};
}

std::array<unsigned char, 4> bytes(const Color& color, double opacity = 1) {
  const auto byte = [](double value) { return static_cast<unsigned char>(std::lround(255 * value)); };
  return {byte(color[0]), byte(color[1]), byte(color[2]), byte(opacity)};
}

/// Custom marks; positions as the axis has them, logarithms on a logarithmic one.
void setTicks(vtkAxis& axis, const AxisMarks& ticks, bool logarithmic) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const auto& [at, text] : ticks) {
    positions->InsertNextValue(logarithmic ? std::log10(at) : at);
    labels->InsertNextValue(text);
  }
  axis.SetCustomTickPositions(positions, labels);
}

/// The size of a text that is centred over a plot: smaller where a picture of this length would cut it, yet never
/// so small that nobody reads it.
double fittingSize(const std::string& text, double size_px, double length_px, double scale) {
  constexpr double kLetterShare = 0.58; // mean width of a letter, of the size
  constexpr double kSmallest = 0.65;
  const double room_px = length_px - kBesidePlot_px * scale;
  const double needed_px = kLetterShare * size_px * static_cast<double>(text.size());
  return size_px * std::clamp(room_px / std::max(needed_px, 1.0), kSmallest, 1.0);
}

/// `length_px` of the picture along the axis.
void setAxis(vtkAxis& axis, const std::string& label, const Range& range, bool logarithmic, const Palette& colors,
             double scale, double length_px) {
  axis.SetTitle(label);
  axis.SetLogScale(logarithmic);
  axis.SetBehavior(vtkAxis::FIXED);
  axis.SetUnscaledRange(range.low, range.high);
  const bool upright = axis.GetPosition() == vtkAxis::LEFT;
  const AxisRoom room{length_px - kAroundPlot_px * scale, upright ? 0 : kLetter_px * scale,
                      (upright ? kAxisLine_px : kGap_px) * scale};
  setTicks(axis, axisMarks(range.low, range.high, logarithmic, room), logarithmic);
  setTextStyle(*axis.GetTitleProperties(), colors.text, fittingSize(label, 13 * scale, length_px, scale));
  setTextStyle(*axis.GetLabelProperties(), colors.text, 12 * scale);
  axis.GetPen()->SetColor(bytes(colors.text).data());
  axis.GetGridPen()->SetColor(bytes(colors.grid).data());
  axis.GetPen()->SetWidth(static_cast<float>(scale));
}

vtkSmartPointer<vtkTable> table(const Points& points, const std::string& name) {
  vtkNew<vtkDoubleArray> x;
  vtkNew<vtkDoubleArray> y;
  x->SetName("x");
  y->SetName(name.c_str());
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    x->InsertNextValue(points.x[k]);
    y->InsertNextValue(points.y[k]);
  }
  auto result = vtkSmartPointer<vtkTable>::New();
  result->AddColumn(x);
  result->AddColumn(y);
  return result;
}

void addSeries(vtkChartXY& chart, const ChartSeries& series, const Points& points, const Color& color, double scale) {
  if (points.x.empty()) return;
  // A line needs two points.
  const bool cloud = series.style == ChartSeries::Style::Points || points.x.size() == 1;
  auto* plot = vtkPlotPoints::SafeDownCast(chart.AddPlot(cloud ? vtkChart::POINTS : vtkChart::LINE));
  plot->SetInputData(table(points, series.legendWords().empty() ? "y" : series.legendWords()), 0, 1);
  plot->SetLegendVisibility(!series.legend || !series.legend->empty());
  plot->GetPen()->SetColor(bytes(color).data());
  plot->GetPen()->SetWidth(static_cast<float>(2 * scale));
  if (series.dashed) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  plot->GetBrush()->SetColor(bytes(color).data());
  const int marker = series.dashed ? vtkPlotPoints::DIAMOND : vtkPlotPoints::CIRCLE; // points have no dashes
  plot->SetMarkerStyle(series.style == ChartSeries::Style::Line && !cloud ? vtkPlotPoints::NONE : marker);
  plot->SetMarkerSize(static_cast<float>((cloud ? 9 : 7) * scale));
}

/// The curves as shares 0..1 of the axes, for the legend.
std::vector<std::vector<std::array<double, 2>>> shares(const std::vector<Points>& all, const Range& x, const Range& y,
                                                       const ChartSpec& spec) {
  const auto share = [](double value, const Range& range, bool logarithmic) {
    if (logarithmic) return std::log(value / range.low) / std::log(range.high / range.low);
    return (value - range.low) / (range.high - range.low);
  };
  std::vector<std::vector<std::array<double, 2>>> curves;
  for (std::size_t k = 0; k < all.size(); ++k) {
    curves.emplace_back();
    for (std::size_t p = 0; p < all[k].x.size(); ++p) {
      const std::array<double, 2> point{share(all[k].x[p], x, spec.logX), share(all[k].y[p], y, spec.logY)};
      if (p > 0 && spec.series[k].style != ChartSeries::Style::Points)
        addBetween(curves.back(), curves.back().back(), point);
      curves.back().push_back(point);
    }
  }
  return curves;
}

Range withRoomAbove(const Range& range, double share, bool logarithmic) {
  const double factor = 1 / (1 - share);
  if (logarithmic) return {range.low, range.low * std::pow(range.high / range.low, factor)};
  return {range.low, range.low + (range.high - range.low) * factor};
}

void setLegend(vtkChartXY& chart, const LegendCorner& corner, const Palette& colors, double scale) {
  vtkChartLegend& legend = *chart.GetLegend();
  legend.SetHorizontalAlignment(corner.left ? vtkChartLegend::LEFT : vtkChartLegend::RIGHT);
  legend.SetVerticalAlignment(corner.bottom ? vtkChartLegend::BOTTOM : vtkChartLegend::TOP);
  legend.SetLabelSize(static_cast<int>(std::lround(12 * scale)));
  legend.SetSymbolWidth(static_cast<int>(std::lround(28 * scale)));
  legend.SetPadding(static_cast<int>(std::lround(6 * scale)));
  setTextStyle(*legend.GetLabelProperties(), colors.text, 12 * scale);
  legend.GetBrush()->SetColor(bytes(colors.ground).data());
  legend.GetBrush()->SetOpacityF(0.85);
  legend.GetPen()->SetColor(bytes(colors.grid).data());
}

} // namespace

void fillChart(vtkChartXY& chart, const ChartSpec& spec, Theme theme, double scale,
               const std::array<double, 2>& size_px) {
  const Palette& colors = palette(theme);
  chart.ClearPlots();
  Range x;
  Range y;
  std::vector<Points> all;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < spec.series.size(); ++k) {
    const ChartSeries& series = spec.series[k];
    Points points = shownPoints(series, spec);
    for (const double value : points.x) x.add(value);
    for (const double value : points.y) y.add(value);
    addSeries(chart, series, points, seriesColor(series.color < 0 ? static_cast<int>(k) : series.color, theme), scale);
    if (!points.x.empty() && !series.legendWords().empty()) names.push_back(series.legendWords());
    all.push_back(std::move(points));
  }
  const Range xShown = spec.xRange ? Range{(*spec.xRange)[0], (*spec.xRange)[1]} : padded(x, spec.logX);
  Range yShown = spec.yRange ? Range{(*spec.yRange)[0], (*spec.yRange)[1]} : padded(y, spec.logY);
  chart.SetShowLegend(!names.empty());
  if (!names.empty()) {
    const LegendShare share = legendShare(names, scale, size_px);
    LegendCorner corner = freestCorner(shares(all, xShown, yShown, spec), share);
    const bool covers = corner.covered > 0 && !spec.yRange;
    const bool beside = covers && share.height > kMostLegend && share.width <= kMostLegend;
    if (covers && !beside) yShown = withRoomAbove(yShown, std::min(share.height, kMostLegend), spec.logY);
    if (covers) corner = {};
    setLegend(chart, corner, colors, scale);
    chart.GetLegend()->SetInline(!beside); // the plot makes room for it
  }
  setAxis(*chart.GetAxis(vtkAxis::BOTTOM), spec.xLabel, xShown, spec.logX, colors, scale, size_px[0]);
  setAxis(*chart.GetAxis(vtkAxis::LEFT), spec.yLabel, yShown, spec.logY, colors, scale, size_px[1]);
  vtkAxis& top = *chart.GetAxis(vtkAxis::TOP);
  chart.SetAutoAxes(spec.topTicks.empty()); // else the chart hides axes that no curve belongs to
  chart.GetAxis(vtkAxis::RIGHT)->SetVisible(false);
  top.SetVisible(!spec.topTicks.empty());
  if (!spec.topTicks.empty()) {
    setAxis(top, spec.topLabel, xShown, spec.logX, colors, scale, size_px[0]);
    top.SetGridVisible(false);
    setTicks(top, spec.topTicks, spec.logX);
  }
  chart.SetTitle(spec.title);
  setTextStyle(*chart.GetTitleProperties(), colors.text, fittingSize(spec.title, 14 * scale, size_px[0], scale), true);
}

Picture drawChart(const ChartSpec& spec, int width, int height, Theme theme) {
  vtkNew<vtkChartXY> chart;
  fillChart(*chart, spec, theme, 1, {static_cast<double>(width), static_cast<double>(height)});
  return drawOnce(chartRenderer(*chart, theme), width, height);
}

} // namespace palp
