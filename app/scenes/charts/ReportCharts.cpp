#include "app/scenes/charts/ReportCharts.h"

#include "app/scenes/Picture.h"
#include "app/scenes/charts/Chart.h"

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

} // namespace

void drawReportChart(const ReportChart& chart, const std::filesystem::path& png) {
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

} // namespace palp
