#include "app/study/touch/DesignMirror.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace palp {

namespace {

constexpr double kSame = 1e-9; // of the length that is reflected

struct ElectrodePlace {
  double along_mm, z_mm;
  int number; ///< on its wire
};

/// In the order of their places.
std::vector<ElectrodePlace> electrodesOf(const ElectrodeLayer& layer, int wire, double length_mm, bool reflected) {
  std::vector<ElectrodePlace> places;
  for (int e = 0; e < layer.electrodesPerWire(); ++e) {
    const double along_mm = layer.along(wire, e);
    places.push_back({reflected ? length_mm - along_mm : along_mm, layer.z(wire, e), e});
  }
  std::sort(places.begin(), places.end(), [](const ElectrodePlace& a, const ElectrodePlace& b) {
    return std::pair(a.along_mm, a.z_mm) < std::pair(b.along_mm, b.z_mm);
  });
  return places;
}

/// Whose place each wire and each electrode takes.
struct Exchanged {
  std::vector<int> wires, electrodes;
};

/// Where wires are reflected across themselves or along.
std::optional<Exchanged> exchanged(const ElectrodeLayer& layer, double length_mm, bool along) {
  const double tolerance_mm = kSame * length_mm;
  const auto same = [&](double a, double b) { return std::abs(a - b) <= tolerance_mm; };
  Exchanged result;
  for (int wire = 0; wire < layer.wires(); ++wire) {
    const double own_mm = layer.wire_mm[static_cast<std::size_t>(wire)];
    const auto there = std::find_if(layer.wire_mm.begin(), layer.wire_mm.end(),
                                    [&](double at_mm) { return same(at_mm, along ? own_mm : length_mm - own_mm); });
    if (there == layer.wire_mm.end()) return {};
    const auto other = static_cast<int>(there - layer.wire_mm.begin());
    const std::vector<ElectrodePlace> image = electrodesOf(layer, wire, length_mm, along),
                                      found = electrodesOf(layer, other, length_mm, false);
    const bool match = std::equal(image.begin(), image.end(), found.begin(), found.end(),
                                  [&](const ElectrodePlace& a, const ElectrodePlace& b) {
                                    return same(a.along_mm, b.along_mm) && same(a.z_mm, b.z_mm);
                                  });
    if (!match) return {};
    result.wires.push_back(other);
    const std::size_t first = result.electrodes.size();
    result.electrodes.resize(first + image.size());
    for (std::size_t e = 0; e < image.size(); ++e)
      result.electrodes[first + static_cast<std::size_t>(image[e].number)] =
          other * layer.electrodesPerWire() + found[e].number;
  }
  return result;
}

} // namespace

std::optional<DesignMirror> mirrorOf(const SensorDesign& design, int axis) {
  const double length_mm = design.block_mm(axis);
  auto rows = exchanged(design.upper, length_mm, axis == 0);
  auto columns = exchanged(design.lower, length_mm, axis == 1);
  if (!rows || !columns) return {};
  return DesignMirror{axis,
                      length_mm,
                      std::move(rows->wires),
                      std::move(columns->wires),
                      std::move(rows->electrodes),
                      std::move(columns->electrodes),
                      design.areas};
}

LoadCase DesignMirror::image(LoadCase load) const {
  for (AreaLoad& each : load.areas) {
    const int i = each.area % areas.columns, j = each.area / areas.columns;
    each.area = axis == 0 ? j * areas.columns + areas.columns - 1 - i : (areas.rows - 1 - j) * areas.columns + i;
    each.force_N(axis) *= -1;
  }
  for (PatchLoad& patch : load.patches) {
    patch.centre_mm(axis) = length_mm - patch.centre_mm(axis);
    patch.force_N(axis) *= -1;
  }
  for (Indenter& indenter : load.indenters) {
    indenter.place_mm(axis) = length_mm - indenter.place_mm(axis);
    if (auto* press = std::get_if<Press>(&indenter.control)) press->force_N(axis) *= -1;
    if (auto* motion = std::get_if<Motion>(&indenter.control)) motion->shift_mm(axis) *= -1;
  }
  return load;
}

ElectrodeDisplacements DesignMirror::image(const ElectrodeDisplacements& moved) const {
  ElectrodeDisplacements result{moved.upper_mm(Eigen::all, upper), moved.lower_mm(Eigen::all, lower),
                                moved.upperPressure_MPa};
  if (moved.upperPressure_MPa.size() > 0) result.upperPressure_MPa = moved.upperPressure_MPa(upper);
  result.upper_mm.row(axis) *= -1;
  result.lower_mm.row(axis) *= -1;
  return result;
}

Eigen::MatrixXd DesignMirror::image(const Eigen::MatrixXd& resistances_ohm) const {
  return resistances_ohm(row, column);
}

} // namespace palp
