#include "app/gui/DeformationCharts.h"

#include <cstdio>

namespace palp {

namespace {

std::string shortText(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.3g", value);
  return buffer.data();
}

} // namespace

ChartSpec newtonChart(const std::vector<NewtonStep>& steps) {
  ChartSpec spec;
  spec.title = "Newton's method";
  spec.xLabel = "iteration, all load steps";
  spec.yLabel = "relative residual";
  spec.logY = true;
  double fraction = -1;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (steps[k].loadFraction != fraction) {
      fraction = steps[k].loadFraction;
      ChartSeries series;
      series.name = "load fraction " + shortText(fraction);
      series.style = ChartSeries::Style::LineAndPoints;
      spec.series.push_back(std::move(series));
    }
    spec.series.back().x.push_back(static_cast<double>(k));
    spec.series.back().y.push_back(steps[k].relativeResidual);
  }
  if (spec.series.size() > 6)
    for (ChartSeries& series : spec.series) series.name.clear();
  return spec;
}

ChartSpec rowWireChart(const SensorDesign& design, const ElectrodeDisplacements& displacements, int rowWire) {
  constexpr std::array<const char*, 3> kNames{"ux", "uy", "uz"};
  const int count = design.electrodesPerRowWire();
  ChartSpec spec;
  spec.title = "Electrodes of row-wire " + std::to_string(rowWire) + " under the load";
  spec.xLabel = "x at rest [mm]";
  spec.yLabel = "displacement [mm]";
  ChartSeries rest;
  rest.name = "at rest";
  rest.dashed = true;
  rest.color = 6;
  for (int d = 0; d < 3; ++d) {
    ChartSeries curve;
    curve.name = kNames[static_cast<std::size_t>(d)];
    curve.style = ChartSeries::Style::LineAndPoints;
    curve.color = d;
    for (int e = 0; e < count; ++e) {
      curve.x.push_back(design.upper.along(rowWire, e));
      curve.y.push_back(displacements.upper_mm(d, rowWire * count + e));
    }
    spec.series.push_back(std::move(curve));
  }
  rest.x = spec.series.front().x;
  rest.y.assign(rest.x.size(), 0);
  spec.series.push_back(std::move(rest));
  return spec;
}

} // namespace palp
