#include "app/gui/touch/DeformationCharts.h"

#include "model/base/Error.h"
#include "model/base/NumberText.h"

namespace palp {

namespace {

std::string shortText(double value) {
  return withDigits(value, 3);
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

ChartSpec rowWireShapeChart(const SensorDesign& design, const ElectrodeDisplacements& displacements, int rowWire) {
  const int count = design.electrodesPerRowWire();
  const Eigen::Matrix3Xd rest = design.upperElectrodes_mm().middleCols(rowWire * count, count);
  const Eigen::Matrix3Xd moved = displacements.upper_mm.middleCols(rowWire * count, count);
  const double factor = automaticDeformationScale(design, moved);
  ChartSpec spec;
  spec.title =
      "Row-wire " + std::to_string(rowWire) + " seen along y, displacements enlarged " + shortText(factor) + " times";
  spec.xLabel = "x [mm]";
  spec.yLabel = "z [mm]";
  for (const bool loaded : {false, true}) {
    const Eigen::Matrix3Xd places = loaded ? Eigen::Matrix3Xd(rest + factor * moved) : rest;
    ChartSeries wire;
    wire.name = loaded ? "under the load" : "at rest";
    wire.style = ChartSeries::Style::LineAndPoints;
    wire.color = loaded ? 1 : 6;
    wire.dashed = !loaded;
    for (Eigen::Index e = 0; e < count; ++e) {
      wire.x.push_back(places(0, e));
      wire.y.push_back(places(2, e));
    }
    spec.series.push_back(std::move(wire));
  }
  return spec;
}

namespace {

constexpr int kLinePoints = 201;

Eigen::Vector3d vectorOf(const std::array<double, 3>& place) {
  return {place[0], place[1], place[2]};
}

std::string placeText(const std::array<double, 3>& place) {
  return "(" + shortText(place[0]) + ", " + shortText(place[1]) + ", " + shortText(place[2]) + ")";
}

/// Nodal values at the points of the line.
ChartSeries curveAlong(const Mesh& mesh, const PointProbe& probe, const std::vector<double>& values, double length_mm) {
  ChartSeries curve;
  curve.color = 0;
  for (int k = 0; k < kLinePoints; ++k) {
    // Nodal fields: those of the first element that holds the point are as good as those of any other.
    const PointProbe::Host& host = probe.hosts()[static_cast<std::size_t>(k)].front();
    double value = 0;
    for (Eigen::Index n = 0; n < host.shapes.size(); ++n)
      value += host.shapes[n] * values[static_cast<std::size_t>(mesh.elements(n, host.element))];
    curve.x.push_back(length_mm * k / (kLinePoints - 1));
    curve.y.push_back(value);
  }
  return curve;
}

} // namespace

ChartSpec LinePlot::chart(const Mesh& mesh, const NodalFields& fields, const ViewSettings& view,
                          const NodalFields* kept) {
  const Eigen::Vector3d from = vectorOf(view.lineFrom_mm);
  const Eigen::Vector3d to = vectorOf(view.lineTo_mm);
  const std::string unit = quantityUnit(view.quantity);
  ChartSpec spec;
  spec.title = quantityName(view.quantity) + " along the line " + placeText(view.lineFrom_mm) + " to " +
               placeText(view.lineTo_mm) + " mm";
  spec.xLabel = "distance at rest [mm]";
  spec.yLabel = quantityName(view.quantity) + (unit.empty() ? "" : " [" + unit + "]");
  if (!probe_ || ends_ != std::array{view.lineFrom_mm, view.lineTo_mm}) {
    Eigen::Matrix3Xd points(3, kLinePoints);
    for (int k = 0; k < kLinePoints; ++k)
      points.col(k) = from + (to - from) * (static_cast<double>(k) / (kLinePoints - 1));
    try {
      probe_ = std::make_unique<PointProbe>(mesh, points);
      ends_ = {view.lineFrom_mm, view.lineTo_mm};
    } catch (const Error&) {
      probe_.reset();
      spec.title = "The line leaves the block: choose end points inside of it";
      return spec;
    }
  }
  const auto curve = [&](const NodalFields& its) {
    return curveAlong(mesh, *probe_, quantityValues(view.quantity, its), (to - from).norm());
  };
  spec.series = {curve(fields)};
  if (kept == nullptr) return spec;
  spec.series[0].name = "this design";
  spec.series.push_back(curve(*kept));
  spec.series[1].name = "reference design";
  spec.series[1].color = 1;
  spec.series[1].dashed = true;
  return spec;
}

} // namespace palp
