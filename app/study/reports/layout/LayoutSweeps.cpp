#include "app/study/reports/layout/LayoutSweeps.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace palp {

namespace {

constexpr int kPoints = 25;
constexpr int kPointsUnderField = 13;  // each costs a thousand times as much there,
constexpr double kSweepFineness = 0.5; // and a hundredth of a percent is enough to draw
constexpr double kMargins = 20;        // between the layers and to the faces, in the block's height

double margin_mm(const SensorDesign& design) {
  return design.block_mm.z() / kMargins;
}

double middleOf(const std::vector<double>& places) {
  return std::accumulate(places.begin(), places.end(), 0.0) / static_cast<double>(places.size());
}

/// The places on each wire, moved so that their distances grow by the factor and their middle stays.
void stretch(ElectrodeLayer& layer, double factor) {
  for (std::vector<double>& places : layer.along_mm) {
    const double middle = middleOf(places);
    for (double& place : places) place = middle + factor * (place - middle);
  }
}

/// The largest factor that keeps all electrodes of the layer inside (0, length).
double largestFactor(const ElectrodeLayer& layer, double length_mm, double margin) {
  double factor = 1e6;
  for (const std::vector<double>& places : layer.along_mm) {
    const double middle = middleOf(places);
    for (const double place : places) {
      if (place > middle) factor = std::min(factor, (length_mm - margin - middle) / (place - middle));
      if (place < middle) factor = std::min(factor, (middle - margin) / (middle - place));
    }
  }
  return factor;
}

double meanPitch(const ElectrodeLayer& layer) {
  const auto [low, high] = std::minmax_element(layer.along_mm[0].begin(), layer.along_mm[0].end());
  return (*high - *low) / std::max(1, layer.electrodesPerWire() - 1);
}

/// A sweep without its points: from where to where, and what a value changes.
struct LayoutPlan {
  LayoutSweep sweep;
  double low = 0, high = 0;
  std::function<void(SensorDesign&, double)> change;
};

using Layer = ElectrodeLayer SensorDesign::*;

/// All electrodes of a layer at one depth.
LayoutPlan depthPlan(const std::string& file, const std::string& layerName, const std::string& wires, Layer layer,
                     double low, double high) {
  return {{file,
           "Depth of the " + layerName + " layer",
           "Bound against the height of the " + wires,
           "z of the " + wires + " [mm]",
           {}},
          low,
          high,
          [layer](SensorDesign& d, double at) { (d.*layer).z_mm = {{at}}; }};
}

LayoutPlan pitchPlan(const std::string& file, const std::string& layerName, const std::string& wires, Layer layer,
                     const SensorDesign& design, double leastFactor, double length_mm) {
  const double pitch = meanPitch(design.*layer);
  return {{file,
           "Pitch of the " + layerName + " electrodes",
           "Bound against the pitch on the " + wires + ", their middle kept",
           "pitch on the " + wires + " [mm]",
           {}},
          leastFactor * pitch,
          pitch * largestFactor(design.*layer, length_mm, margin_mm(design)),
          [layer, pitch](SensorDesign& d, double at) { stretch(d.*layer, at / pitch); }};
}

std::vector<LayoutPlan> plans(const SensorDesign& design) {
  const double top = design.upperElectrodes_mm().row(2).minCoeff(),
               bottom = design.lowerElectrodes_mm().row(2).maxCoeff();
  std::vector<LayoutPlan> result;
  result.push_back(depthPlan("upper_depth", "upper", "row-wires", &SensorDesign::upper, bottom + margin_mm(design),
                             design.block_mm.z() - margin_mm(design)));
  result.push_back(depthPlan("lower_depth", "lower", "column-wires", &SensorDesign::lower, margin_mm(design),
                             top - margin_mm(design)));
  if (design.electrodesPerRowWire() > 1)
    result.push_back(
        pitchPlan("upper_pitch", "upper", "row-wires", &SensorDesign::upper, design, 0.2, design.block_mm.x()));
  if (design.electrodesPerColumnWire() > 1)
    result.push_back(
        pitchPlan("lower_pitch", "lower", "column-wires", &SensorDesign::lower, design, 0.05, design.block_mm.y()));
  return result;
}

} // namespace

std::vector<LayoutSweep> layoutSweeps(const SensorDesign& design, const AreaResponse& response, int rowWire,
                                      double relativeNoise, int threads, const ReportProgress& progress,
                                      const std::stop_token& stop) {
  std::vector<LayoutSweep> sweeps;
  std::vector<LayoutPlan> planned = plans(design);
  const int points = design.field() ? kPointsUnderField : kPoints;
  for (LayoutPlan& plan : planned) {
    for (int i = 0; i < points; ++i) {
      if (progress)
        progress((static_cast<double>(sweeps.size()) + static_cast<double>(i) / points) /
                     static_cast<double>(planned.size()),
                 plan.sweep.title);
      const double at = plan.low + (plan.high - plan.low) * i / (points - 1);
      SensorDesign changed = design;
      plan.change(changed, at);
      if (!check(changed).empty()) continue; // a layout that cannot be is left out
      plan.sweep.points.push_back(
          {at, layoutBound(changed, response, rowWire, relativeNoise, threads, kSweepFineness, stop).withoutPrior()});
    }
    sweeps.push_back(std::move(plan.sweep));
  }
  return sweeps;
}

} // namespace palp
