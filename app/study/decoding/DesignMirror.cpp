#include "app/study/decoding/DesignMirror.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

namespace {

constexpr double kSame = 1e-9; // of the length that is reflected

using ElectrodePlaces = std::vector<std::pair<double, double>>; // along the wire and z, in order

ElectrodePlaces electrodesOf(const ElectrodeLayer& layer, int wire, double length_mm, bool reflected) {
  ElectrodePlaces places;
  for (int e = 0; e < layer.electrodesPerWire(); ++e) {
    const double along_mm = layer.along(wire, e);
    places.emplace_back(reflected ? length_mm - along_mm : along_mm, layer.z(wire, e));
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// Whose place each wire takes, where wires are reflected across themselves or along.
std::optional<std::vector<int>> exchanged(const ElectrodeLayer& layer, double length_mm, bool along) {
  const double tolerance_mm = kSame * length_mm;
  const auto same = [&](double a, double b) { return std::abs(a - b) <= tolerance_mm; };
  std::vector<int> result;
  for (int wire = 0; wire < layer.wires(); ++wire) {
    const double own_mm = layer.wire_mm[static_cast<std::size_t>(wire)];
    const auto there = std::find_if(layer.wire_mm.begin(), layer.wire_mm.end(),
                                    [&](double at_mm) { return same(at_mm, along ? own_mm : length_mm - own_mm); });
    if (there == layer.wire_mm.end()) return {};
    const auto other = static_cast<int>(there - layer.wire_mm.begin());
    const ElectrodePlaces image = electrodesOf(layer, wire, length_mm, along),
                          found = electrodesOf(layer, other, length_mm, false);
    const bool match =
        std::equal(image.begin(), image.end(), found.begin(), found.end(),
                   [&](const auto& a, const auto& b) { return same(a.first, b.first) && same(a.second, b.second); });
    if (!match) return {};
    result.push_back(other);
  }
  return result;
}

} // namespace

std::optional<DesignMirror> mirrorOf(const SensorDesign& design, int axis) {
  const double length_mm = design.block_mm(axis);
  auto row = exchanged(design.upper, length_mm, axis == 0);
  auto column = exchanged(design.lower, length_mm, axis == 1);
  if (!row || !column) return {};
  return DesignMirror{std::move(*row), std::move(*column)};
}

} // namespace palp
