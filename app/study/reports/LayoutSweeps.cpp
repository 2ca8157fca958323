#include "app/study/reports/LayoutSweeps.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int kPoints = 25;
constexpr double kMargin_mm = 0.25; // between the layers and to the faces

/// All electrodes at one depth.
void setDepth(ElectrodeLayer& layer, double z_mm) {
  layer.z_mm = {{z_mm}};
}

/// The places on each wire, moved so that their distances grow by the factor and their middle stays.
void stretch(ElectrodeLayer& layer, double factor) {
  for (std::vector<double>& places : layer.along_mm) {
    double middle = 0;
    for (const double place : places) middle += place / static_cast<double>(places.size());
    for (double& place : places) place = middle + factor * (place - middle);
  }
}

/// The largest factor that keeps all electrodes of the layer inside (0, length).
double largestFactor(const ElectrodeLayer& layer, double length_mm) {
  double factor = 1e6;
  for (const std::vector<double>& places : layer.along_mm) {
    const double middle = [&] {
      double sum = 0;
      for (const double place : places) sum += place;
      return sum / static_cast<double>(places.size());
    }();
    for (const double place : places) {
      if (place > middle) factor = std::min(factor, (length_mm - kMargin_mm - middle) / (place - middle));
      if (place < middle) factor = std::min(factor, (middle - kMargin_mm) / (middle - place));
    }
  }
  return factor;
}

double meanPitch(const ElectrodeLayer& layer) {
  const auto [low, high] = std::minmax_element(layer.along_mm[0].begin(), layer.along_mm[0].end());
  return (*high - *low) / std::max(1, layer.electrodesPerWire() - 1);
}

/// Points between two ends; a layout that cannot be is left out.
template <class Change>
void fill(LayoutSweep& sweep, const SensorDesign& design, const AreaResponse& response, int rowWire, double noise,
          double low, double high, Change change) {
  for (int i = 0; i < kPoints; ++i) {
    const double at = low + (high - low) * i / (kPoints - 1);
    SensorDesign changed = design;
    change(changed, at);
    if (!check(changed).empty()) continue;
    sweep.points.push_back({at, layoutBound(changed, response, rowWire, noise).withoutPrior()});
  }
}

} // namespace

std::vector<LayoutSweep> layoutSweeps(const SensorDesign& design, const AreaResponse& response, int rowWire,
                                      double relativeNoise) {
  const Eigen::Matrix3Xd upper = design.upperElectrodes_mm();
  const Eigen::Matrix3Xd lower = design.lowerElectrodes_mm();
  std::vector<LayoutSweep> sweeps;
  sweeps.push_back({"upper_depth",
                    "Depth of the upper layer",
                    "Bound against the height of the row-wires",
                    "z of the row-wires [mm]",
                    {}});
  fill(sweeps.back(), design, response, rowWire, relativeNoise, lower.row(2).maxCoeff() + kMargin_mm,
       design.block_mm.z() - kMargin_mm, [](SensorDesign& d, double at) { setDepth(d.upper, at); });
  sweeps.push_back({"lower_depth",
                    "Depth of the lower layer",
                    "Bound against the height of the column-wires",
                    "z of the column-wires [mm]",
                    {}});
  fill(sweeps.back(), design, response, rowWire, relativeNoise, kMargin_mm, upper.row(2).minCoeff() - kMargin_mm,
       [](SensorDesign& d, double at) { setDepth(d.lower, at); });
  if (design.electrodesPerRowWire() > 1) {
    const double pitch = meanPitch(design.upper);
    sweeps.push_back({"upper_pitch",
                      "Pitch of the upper electrodes",
                      "Bound against the pitch on the row-wires, their middle kept",
                      "pitch on the row-wires [mm]",
                      {}});
    fill(sweeps.back(), design, response, rowWire, relativeNoise, 0.2 * pitch,
         pitch * largestFactor(design.upper, design.block_mm.x()),
         [pitch](SensorDesign& d, double at) { stretch(d.upper, at / pitch); });
  }
  if (design.electrodesPerColumnWire() > 1) {
    const double pitch = meanPitch(design.lower);
    sweeps.push_back({"lower_pitch",
                      "Pitch of the lower electrodes",
                      "Bound against the pitch on the column-wires, their middle kept",
                      "pitch on the column-wires [mm]",
                      {}});
    fill(sweeps.back(), design, response, rowWire, relativeNoise, 0.05 * pitch,
         pitch * largestFactor(design.lower, design.block_mm.y()),
         [pitch](SensorDesign& d, double at) { stretch(d.lower, at / pitch); });
  }
  return sweeps;
}

} // namespace palp
