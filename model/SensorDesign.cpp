#include "model/SensorDesign.h"

#include "model/DesignError.h"
#include "model/MaterialCheck.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "model/field/FieldLawCheck.h"

#include <array>
#include <cmath>
#include <functional>
#include <unordered_map>

namespace palp {

namespace {

constexpr double kLargestLength_mm = 1e4;
constexpr double kLargestModulus_MPa = 1e9;
constexpr int kMostAreasAlong = 50;
constexpr int kMostWires = 255; // the board's protocol counts wires in a byte
constexpr double kSamePlace_mm = 1e-6;

using Problems = std::vector<DesignFault>;

void requirePositive(Problems& problems, const std::string& key, double value, double largest, const char* unit) {
  if (value > 0 && value <= largest) return; // false for NaN
  problems.push_back({key, gotExpected(value, unit, "above 0 up to " + shortText(largest) + unit)});
}

void requireBetween(Problems& problems, const std::string& key, double value, double least, double largest,
                    const char* unit) {
  if (value >= least && value <= largest) return; // false for NaN
  problems.push_back({key, gotExpected(value, unit, shortText(least) + " to " + shortText(largest) + unit)});
}

void requireNotNegative(Problems& problems, const std::string& key, double value, double largest, const char* unit) {
  if (value >= 0 && value <= largest) return; // false for NaN
  problems.push_back({key, gotExpected(value, unit, "0 up to " + shortText(largest) + unit)});
}

void checkAreas(Problems& problems, const LoadAreas& areas) {
  for (const auto& [key, value] : {std::pair{"areas.columns", areas.columns}, std::pair{"areas.rows", areas.rows}})
    if (value < 1 || value > kMostAreasAlong)
      problems.push_back({key, gotExpected(std::to_string(value), "1 to " + std::to_string(kMostAreasAlong))});
}

/// What a layer's parts are called in the design file.
struct LayerNames {
  std::string layer, wire, along, wireName;
};

/// Wrong counts, which make the positions meaningless; true where they are right.
bool checkLayerShape(Problems& problems, const ElectrodeLayer& layer, const LayerNames& names) {
  const std::size_t before = problems.size();
  const std::size_t wires = layer.wire_mm.size();
  if (wires < 1 || wires > kMostWires)
    problems.push_back({names.layer + "." + names.wire,
                        gotExpected(std::to_string(wires) + " wires", "1 to " + std::to_string(kMostWires))});
  if (layer.along_mm.size() != 1 && layer.along_mm.size() != wires)
    problems.push_back({names.layer + "." + names.along,
                        gotExpected(std::to_string(layer.along_mm.size()) + " lists",
                                    "one list, or one for each of the " + std::to_string(wires) + " wires")});
  const std::size_t electrodes = layer.along_mm.empty() ? 0 : layer.along_mm[0].size();
  for (std::size_t wire = 0; wire < layer.along_mm.size(); ++wire) {
    const std::size_t count = layer.along_mm[wire].size();
    if (count < 1 || count > kMostWires || count != electrodes)
      problems.push_back({names.layer + "." + names.along, gotExpected(std::to_string(count) + " electrodes on " +
                                                                           names.wireName + " " + std::to_string(wire),
                                                                       "1 to 255, the same number on every wire")});
  }
  const bool one = layer.z_mm.size() == 1 && layer.z_mm[0].size() == 1;
  bool each = layer.z_mm.size() == wires;
  for (const std::vector<double>& list : layer.z_mm) each = each && list.size() == electrodes;
  if (!one && !each)
    problems.push_back(
        {names.layer + ".z_mm", gotExpected(std::to_string(layer.z_mm.size()) + " lists of other lengths",
                                            "one depth, or a list per wire with one depth per electrode")});
  return problems.size() == before;
}

void checkInside(Problems& problems, const Eigen::Matrix3Xd& positions_mm, int perWire, const Eigen::Vector3d& block_mm,
                 bool mayTouchBottom, const LayerNames& names) {
  const std::string keys[3] = {names.wireName == "row-wire" ? names.along : names.wire,
                               names.wireName == "row-wire" ? names.wire : names.along, "z_mm"};
  for (Eigen::Index i = 0; i < positions_mm.cols(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double value = positions_mm(axis, i);
      const bool aboveLow = axis == 2 && mayTouchBottom ? value >= 0 : value > 0;
      if (aboveLow && value < block_mm(axis)) continue;
      problems.push_back({names.layer + "." + keys[axis],
                          "electrode " + std::to_string(i % perWire) + " of " + names.wireName + " " +
                              std::to_string(i / perWire) + " lies outside the block: " +
                              gotExpected(std::string(1, "xyz"[axis]) + " = " + shortText(value) + " mm",
                                          "inside 0 to " + shortText(block_mm(axis)) + " mm")});
      return; // one sentence a layer: the rest follows from the same slip
    }
}

using Cell = std::array<double, 3>;
struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::size_t all = 0;
    for (const double index : cell) all = all * 1000003 + std::hash<double>()(index);
    return all;
  }
};

/// The first two points, in the order of their columns, that are less than a distance apart. Points are looked for in
/// cubes much wider than that, of which one point's surroundings seldom touch more than one: the time grows with the
/// points and not with their pairs.
std::optional<std::array<Eigen::Index, 2>> firstAtOnePlace(const Eigen::Matrix3Xd& points, double distance) {
  const double width = 16 * distance;
  const auto cellOf = [width](const Eigen::Vector3d& p) -> Cell {
    return {std::floor(p.x() / width), std::floor(p.y() / width), std::floor(p.z() / width)};
  };
  std::unordered_map<Cell, std::vector<Eigen::Index>, CellHash> cells;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite()) cells[cellOf(points.col(i))].push_back(i);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d p = points.col(i);
    const Cell low = cellOf(p.array() - distance), high = cellOf(p.array() + distance);
    Eigen::Index first = points.cols();
    for (int corner = 0; corner < 8; ++corner) { // of the surroundings; mostly all in one cube
      Cell cell = low;
      bool again = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if ((corner >> axis) % 2 == 1) {
          again = again || high[axis] == low[axis];
          cell[axis] = high[axis];
        }
      const auto found = again ? cells.end() : cells.find(cell);
      if (found == cells.end()) continue;
      for (const Eigen::Index j : found->second)
        if (j > i && j < first && (points.col(j) - p).norm() < distance) first = j;
    }
    if (first < points.cols()) return std::array{i, first};
  }
  return {};
}

void checkDuplicates(Problems& problems, const Eigen::Matrix3Xd& positions_mm, int perWire, const LayerNames& names) {
  const auto twins = firstAtOnePlace(positions_mm, kSamePlace_mm);
  if (!twins) return;
  const auto [i, j] = *twins;
  const auto name = [&](Eigen::Index k) {
    return "electrode " + std::to_string(k % perWire) + " of " + names.wireName + " " + std::to_string(k / perWire);
  };
  const bool sameWire = i / perWire == j / perWire;
  problems.push_back({names.layer + "." + (sameWire ? names.along : names.wire),
                      "duplicate electrode: " +
                          gotExpected(name(j) + " at the position of " + name(i), "one electrode per position")});
}

void checkElectrodes(Problems& problems, const SensorDesign& design) {
  const LayerNames upper{"upper_layer", "row_wire_y_mm", "electrode_x_mm", "row-wire"};
  const LayerNames lower{"lower_layer", "column_wire_x_mm", "electrode_y_mm", "column-wire"};
  const bool upperShape = checkLayerShape(problems, design.upper, upper);
  const bool lowerShape = checkLayerShape(problems, design.lower, lower);
  if (upperShape) {
    checkInside(problems, design.upperElectrodes_mm(), design.electrodesPerRowWire(), design.block_mm, false, upper);
    checkDuplicates(problems, design.upperElectrodes_mm(), design.electrodesPerRowWire(), upper);
  }
  if (lowerShape) {
    checkInside(problems, design.lowerElectrodes_mm(), design.electrodesPerColumnWire(), design.block_mm, true, lower);
    checkDuplicates(problems, design.lowerElectrodes_mm(), design.electrodesPerColumnWire(), lower);
  }
  if (!upperShape || !lowerShape) return;
  const double lowest = design.upperElectrodes_mm().row(2).minCoeff();
  const double highest = design.lowerElectrodes_mm().row(2).maxCoeff();
  if (!(highest < lowest))
    problems.push_back(
        {"lower_layer.z_mm",
         "the layers cross: " + gotExpected("the highest lower electrode at z = " + shortText(highest) + " mm",
                                            "below the lowest upper electrode at z = " + shortText(lowest) + " mm")});
}

/// `placed`: the block has a size and the electrodes have places in it.
void checkResistance(Problems& problems, const SensorDesign& design, bool placed) {
  if (const auto* pairs = std::get_if<PairsLaw>(&design.resistance))
    return requirePositive(problems, "resistance.rate_ohm_per_mm", pairs->rate_ohm_per_mm, 1e12, " ohm/mm");
  const FieldLaw& law = *design.field();
  // Below a metal's resistivity, a sphere's radius of a nanometre and a pascal numbers overflow, or are lost next to
  // the wires'.
  requireBetween(problems, "resistance.resistivity_ohm_mm", law.resistivity_ohm_mm, 1e-6, 1e12, " ohm mm");
  requireNotNegative(problems, "resistance.contact_ohm_mm2", law.contact_ohm_mm2, 1e12, " ohm mm2");
  requireNotNegative(problems, "resistance.wire_ohm", law.wire_ohm, 1e9, " ohm");
  const std::size_t before = problems.size();
  requireBetween(problems, "resistance.electrode_radius_mm", law.electrodeRadius_mm, 1e-6, kLargestLength_mm, " mm");
  if (!placed || problems.size() > before) return;
  if (const auto fault = sphereFault(design)) problems.push_back(*fault);
}

void checkForceRange(Problems& problems, const ForceRange& range) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = range.low_N(axis);
    const double high = range.high_N(axis);
    if (low < high && std::abs(low) <= 1e6 && std::abs(high) <= 1e6) continue;
    problems.push_back(
        {std::string("force_range_N.") + "xyz"[axis], gotExpected("[" + shortText(low) + ", " + shortText(high) + "]",
                                                                  "[low, high] with low < high, up to 1e+06 N")});
  }
}

} // namespace

double ElectrodeLayer::along(int wire, int electrode) const {
  return along_mm[along_mm.size() == 1 ? 0 : static_cast<std::size_t>(wire)][static_cast<std::size_t>(electrode)];
}

double ElectrodeLayer::z(int wire, int electrode) const {
  if (z_mm.size() == 1 && z_mm[0].size() == 1) return z_mm[0][0];
  return z_mm[static_cast<std::size_t>(wire)][static_cast<std::size_t>(electrode)];
}

Eigen::Matrix3Xd SensorDesign::upperElectrodes_mm() const {
  Eigen::Matrix3Xd positions(3, upper.electrodes());
  for (int wire = 0; wire < upper.wires(); ++wire)
    for (int e = 0; e < upper.electrodesPerWire(); ++e)
      positions.col(wire * upper.electrodesPerWire() + e) << upper.along(wire, e),
          upper.wire_mm[static_cast<std::size_t>(wire)], upper.z(wire, e);
  return positions;
}

Eigen::Matrix3Xd SensorDesign::lowerElectrodes_mm() const {
  Eigen::Matrix3Xd positions(3, lower.electrodes());
  for (int wire = 0; wire < lower.wires(); ++wire)
    for (int e = 0; e < lower.electrodesPerWire(); ++e)
      positions.col(wire * lower.electrodesPerWire() + e) << lower.wire_mm[static_cast<std::size_t>(wire)],
          lower.along(wire, e), lower.z(wire, e);
  return positions;
}

Rectangle SensorDesign::areaRectangle(int area) const {
  const Eigen::Vector2d size(block_mm.x() / areas.columns, block_mm.y() / areas.rows);
  const Eigen::Vector2d cell(area % areas.columns, area / areas.columns);
  return {cell.cwiseProduct(size), (cell + Eigen::Vector2d::Ones()).cwiseProduct(size)};
}

SensorDesign paperDesign() {
  SensorDesign design;
  design.upper.z_mm = {{4}};
  design.upper.along_mm.resize(1);
  for (int i = 0; i < 10; ++i) {
    design.upper.wire_mm.push_back(1.5 + 3 * i);
    design.upper.along_mm[0].push_back(1.5 + 3 * i);
  }
  design.lower.z_mm = {{1}};
  design.lower.along_mm = {{5, 15, 25}};
  for (int k = 0; k < 30; ++k) design.lower.wire_mm.push_back(0.5 + k);
  return design;
}

std::vector<DesignFault> check(const SensorDesign& design) {
  Problems problems;
  for (int axis = 0; axis < 3; ++axis)
    requirePositive(problems, "block_mm[" + std::to_string(axis) + "]", design.block_mm(axis), kLargestLength_mm,
                    " mm");
  const bool block = problems.empty();
  const Problems ofMaterial = check(design.material);
  problems.insert(problems.end(), ofMaterial.begin(), ofMaterial.end());
  checkAreas(problems, design.areas);
  const std::size_t before = problems.size();
  checkElectrodes(problems, design);
  checkResistance(problems, design, block && problems.size() == before);
  if (design.pressureLaw) {
    requireBetween(problems, "resistance.pressure_law.p0_MPa", design.pressureLaw->p0_MPa, 1e-6, kLargestModulus_MPa,
                   " MPa");
    if (!(design.pressureLaw->exponent >= 0 && design.pressureLaw->exponent <= 10))
      problems.push_back(
          {"resistance.pressure_law.exponent", gotExpected(design.pressureLaw->exponent, "", "0 to 10")});
  }
  checkForceRange(problems, design.forceRange);
  return problems;
}

std::optional<std::string> whyNotSquare(const SensorDesign& design) {
  const int unknowns = 3 * design.electrodesPerRowWire();
  if (design.columnWires() == unknowns) return {};
  return "Eq. (1) has no unique solution: " +
         gotExpected(std::to_string(design.columnWires()) + " column-wires",
                     "as many as a row-wire has unknowns, 3 x " + std::to_string(design.electrodesPerRowWire()) +
                         " electrodes = " + std::to_string(unknowns));
}

void requireValid(const SensorDesign& design) {
  const Problems problems = check(design);
  if (!problems.empty()) throw DesignError(problems[0].key + ": " + problems[0].sentence);
}

void requirePairs(const SensorDesign& design, const std::string& what) {
  if (design.field())
    throw DesignError(
        what + ": not available under the field law: " + gotExpected("a design with resistance.law field", "pairs"));
}

} // namespace palp
