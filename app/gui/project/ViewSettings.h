#pragma once

#include "app/scenes/block/DeformationScene.h"
#include "model/base/NamedEnum.h"

#include <array>
#include <optional>
#include <string>

namespace palp {

/// What the heatmap shows of the resistances.
enum class ResistanceKind { Resistance, Change, RelativeChange, LessReference };
inline constexpr NamedEnum kResistanceKinds("resistance",
                                            std::array{std::pair{ResistanceKind::Resistance, "R"},
                                                       std::pair{ResistanceKind::Change, "dR"},
                                                       std::pair{ResistanceKind::RelativeChange, "dR/R"},
                                                       std::pair{ResistanceKind::LessReference, "dR/R less kept"}});

/// How the scenes show what was computed.
struct ViewSettings {
  std::string scene = "deformation"; ///< in which a saved project opens
  Quantity quantity = Quantity::Displacement;
  std::optional<double> deformationScale; ///< none: automatic
  std::optional<CutPlane> cut;
  std::optional<ColorMap> colorMap;                     ///< none: as the quantity asks for
  std::optional<std::array<double, 2>> colorRange;      ///< of the quantity's colours; none: the values' own
  std::optional<std::array<double, 2>> differenceRange; ///< the same of the difference from the reference design
  bool extremes = false;                                ///< marks the largest and the smallest value
  bool ghost = true;
  bool electrodes = true;
  bool arrows = true;
  bool outlines = true;
  bool edges = false;
  std::optional<std::array<int, 2>> litCell; ///< of the Deformation scene: row-wire, column-wire
  int rowWire = 4;
  std::array<double, 3> lineFrom_mm{0, 15, 5}; ///< ends of the line of a plot, at rest; as here: not chosen yet
  std::array<double, 3> lineTo_mm{30, 15, 5};
  bool mesh = false; ///< of the Design scene
  double resistanceNoise = 1e-4;
  ResistanceKind resistance = ResistanceKind::RelativeChange;
  std::optional<std::array<double, 2>> resistanceRange; ///< of the colours; none: the values' own
  std::array<int, 2> cell{4, 15};                       ///< of the Resistance scene
  bool currentPaths = false;                            ///< in its block, under the law of the field
  int testArea = 0;
  bool lessReference = false;        ///< the Deformation scene shows the touch less another answer
  bool uniform = false;              ///< that is: of its own design to the same forces, uniform; else the kept one's
  std::string mapQuantity = "place"; ///< of the Design scene's map, by its name for files
  bool mapOnBlock = true;            ///< is drawn over the block too
  int reportPerArea = 100;           ///< samples on each area that a report draws

  bool operator==(const ViewSettings&) const = default;
  /// Of the colours that are shown: each of the two has a range of its own.
  [[nodiscard]] std::optional<std::array<double, 2>>& shownRange() {
    return lessReference ? differenceRange : colorRange;
  }
  [[nodiscard]] const std::optional<std::array<double, 2>>& shownRange() const {
    return lessReference ? differenceRange : colorRange;
  }
  /// The ends of the line; through the middle of this block's top face along x until one was chosen.
  [[nodiscard]] std::array<std::array<double, 3>, 2> lineIn(const Eigen::Vector3d& block_mm) const;
  /// Quantity, deformation scale, cut, colours, parts and lit cell of the Deformation scene; all else as by default.
  [[nodiscard]] DeformationOptions blockOptions() const;
};

} // namespace palp
