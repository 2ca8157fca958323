#pragma once

#include "model/Material.h"
#include "model/ResistanceLaw.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// One layer of electrodes on parallel straight wires: row-wires run along x (upper layer), column-wires along y
/// (lower layer).
struct ElectrodeLayer {
  std::vector<double> wire_mm;               ///< one per wire: y of a row-wire, x of a column-wire
  std::vector<std::vector<double>> along_mm; ///< along the wire (x or y): one list for all wires, or one per wire
  /// Height above the bottom: {{z}} for all electrodes, or one list per wire with one value per electrode.
  std::vector<std::vector<double>> z_mm;

  [[nodiscard]] int wires() const { return static_cast<int>(wire_mm.size()); }
  [[nodiscard]] int electrodesPerWire() const { return along_mm.empty() ? 0 : static_cast<int>(along_mm[0].size()); }
  [[nodiscard]] int electrodes() const { return wires() * electrodesPerWire(); }
  [[nodiscard]] double along(int wire, int electrode) const;
  [[nodiscard]] double z(int wire, int electrode) const;
  bool operator==(const ElectrodeLayer&) const = default;
};

/// Fig. 1 of the paper: the resistivity g(p) = g0 (1 + max(p, 0) / p0)^(-n) falls with the hydrostatic pressure p
/// (under Eq. (1) the pressure at the upper electrode, in the conduction field the local pressure). The default values
/// are assumed, because the paper does not give the numbers of its figure.
struct PressureLaw {
  double p0_MPa = 0.05;
  double exponent = 0.5;
  bool operator==(const PressureLaw&) const = default;
};

/// Rectangles of equal size on the top face: area a is in column a % columns along x and row a / columns along y.
struct LoadAreas {
  int columns = 3;
  int rows = 2;
  [[nodiscard]] int count() const { return columns * rows; }
  bool operator==(const LoadAreas&) const = default;
};

struct Rectangle {
  Eigen::Vector2d low_mm;
  Eigen::Vector2d high_mm;
};

/// Range of the force for sampling and for "% of range" [N]; the components of both vectors are along x, y and z.
struct ForceRange {
  Eigen::Vector3d low_N{-1, -1, -6};
  Eigen::Vector3d high_N{1, 1, 0};
  bool operator==(const ForceRange&) const = default;
};

/// The sensor: block, rubber, load areas, two layers of electrodes and the law of its resistances.
struct SensorDesign {
  Eigen::Vector3d block_mm{30, 30, 5}; ///< origin at a lower corner, z up, bottom face fixed
  Material material;
  LoadAreas areas;
  ElectrodeLayer upper;            ///< row-wires
  ElectrodeLayer lower;            ///< column-wires
  bool lowerFollowsRubber = false; ///< false, as in the paper: the lower electrodes do not move
  ResistanceLaw resistance;
  std::optional<PressureLaw> pressureLaw; ///< of the resistivity, under Eq. (1) and in the conduction field
  ForceRange forceRange;

  [[nodiscard]] int rowWires() const { return upper.wires(); }
  [[nodiscard]] int electrodesPerRowWire() const { return upper.electrodesPerWire(); }
  [[nodiscard]] int columnWires() const { return lower.wires(); }
  [[nodiscard]] int electrodesPerColumnWire() const { return lower.electrodesPerWire(); }

  /// Positions 3 x (row-wires * electrodes) [mm] at rest; electrode e of row-wire r is column r * electrodes + e.
  [[nodiscard]] Eigen::Matrix3Xd upperElectrodes_mm() const;
  /// Positions 3 x (column-wires * electrodes) [mm] at rest; electrode j of column-wire k is column k * electrodes + j.
  [[nodiscard]] Eigen::Matrix3Xd lowerElectrodes_mm() const;
  [[nodiscard]] Rectangle areaRectangle(int area) const;
  /// Returns the parameters of the conduction field, or nullptr if the design uses Eq. (1).
  [[nodiscard]] const FieldLaw* field() const { return std::get_if<FieldLaw>(&resistance); }
  bool operator==(const SensorDesign&) const = default;
};

/// Returns the middle row-wire, counted from 0; of two middle ones the lower: row 4 of the paper's ten.
constexpr int centreRowWire(int rowWires) {
  return (rowWires - 1) / 2;
}

/// The preset `paper`: the paper's sections 3 and 4.2; depths and positions are our choice (resources/docs/physics.md).
SensorDesign paperDesign();

/// One fault of a design: its key in the design file, and a sentence with the value and the expected range.
struct DesignFault {
  std::string key;
  std::string sentence;
};

/// Returns all faults of the design, in the order of the file; empty if it can be built.
std::vector<DesignFault> check(const SensorDesign& design);

/// Returns the reason why Eq. (1) is not a square system for a row-wire (column-wires != 3 x electrodes of a row-wire);
/// nullopt if it is square.
std::optional<std::string> whyNotSquare(const SensorDesign& design);

/// Returns warnings about a valid design, one sentence each: electrodes so near to each other that small spheres with
/// dipoles are no longer a good model of them.
std::vector<std::string> designWarnings(const SensorDesign& design);

/// Throws DesignError with the first fault if the design is invalid.
void requireValid(const SensorDesign& design);

/// Throws DesignError if the design uses the conduction field; `what` names the computation that requires Eq. (1).
void requirePairs(const SensorDesign& design, const std::string& what);

} // namespace palp
