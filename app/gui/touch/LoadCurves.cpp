#include "app/gui/touch/LoadCurves.h"

#include <algorithm>
#include <array>
#include <string>

namespace palp {

namespace {

constexpr std::size_t kFewSteps = 3; ///< too few for the shape of a curve

/// What the points are, and how much a line between them means.
std::string stepWords(const Solution& solution) {
  const std::size_t steps = solution.increments.size() - 1;
  return ", " + std::to_string(steps) + (steps == 1 ? " load step" : " load steps") +
         (steps < kFewSteps ? ": line interpolated" : "");
}

Eigen::Vector3d loadForce_N(const Touch& touch, const LoadIncrement& state) {
  return std::min(state.loadFraction, 1.) * touch.load().totalForce_N(); // held on the steps of a path
}

Eigen::Vector3d topForce_N(const Touch& touch, const LoadIncrement& state) {
  Eigen::Vector3d sum = loadForce_N(touch, state);
  for (const IndenterState& its : state.indenters) sum += its.force_N;
  return sum;
}

ChartSeries loadCurve(const std::string& name, int color) {
  ChartSeries curve;
  curve.name = name;
  curve.style = ChartSeries::Style::LineAndPoints;
  curve.color = color;
  return curve;
}

} // namespace

ChartSpec reactionChart(const Touch& touch) {
  ChartSpec spec;
  spec.title = "Reaction along the load";
  spec.xLabel = "load fraction (0 to 1), then path step";
  spec.yLabel = "reaction at the bottom [N]";
  const Solution* solution = touch.solution();
  if (solution == nullptr) return spec;
  spec.title += stepWords(*solution);
  constexpr std::array<const char*, 3> kNames{"Rx", "Ry", "Rz"}; // "x" is the column of the table that it is drawn from
  for (int d = 0; d < 3; ++d) {
    ChartSeries curve = loadCurve(kNames[static_cast<std::size_t>(d)], d);
    for (const LoadIncrement& state : solution->increments) {
      curve.x.push_back(state.loadFraction);
      curve.y.push_back(0 - topForce_N(touch, state)(d)); // no -0 at rest
    }
    spec.series.push_back(std::move(curve));
  }
  return spec;
}

ChartSpec forceDisplacementChart(const Touch& touch) {
  ChartSpec spec;
  spec.title = "Force against displacement";
  spec.xLabel = "displacement [mm]";
  spec.yLabel = "force [N]";
  const Solution* solution = touch.solution();
  if (solution == nullptr) return spec;
  spec.title += stepWords(*solution);
  if (!touch.load().areas.empty() || !touch.load().patches.empty()) {
    ChartSeries curve = loadCurve("total of areas and discs, largest displacement", 0);
    for (const LoadIncrement& state : solution->increments) {
      curve.x.push_back(state.displacements_mm.colwise().norm().maxCoeff());
      curve.y.push_back(loadForce_N(touch, state).norm());
    }
    spec.series.push_back(std::move(curve));
  }
  for (std::size_t k = 0; k < touch.load().indenters.size(); ++k) {
    const std::string number = touch.load().indenters.size() > 1 ? " " + std::to_string(k) : "";
    ChartSeries curve = loadCurve("indenter" + number + ", its depth", static_cast<int>(k) + 1);
    for (const LoadIncrement& state : solution->increments) {
      const IndenterState its = k < state.indenters.size() ? state.indenters[k] : IndenterState{}; // at rest none
      curve.x.push_back(0 - its.translation_mm.z());
      curve.y.push_back(its.force_N.norm());
    }
    spec.series.push_back(std::move(curve));
  }
  return spec;
}

} // namespace palp
