#pragma once

#include "model/LoadCase.h"
#include "model/RowColumnResistance.h"
#include "model/SensorDesign.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace palp {

/// A reflection under which a design is its own image: x -> length - x (axis 0), or that of y (axis 1). What is under a
/// load is also under its image, elsewhere. Each electrode and wire takes the place of another, or stays where it is.
struct DesignMirror {
  int axis = 0;
  double length_mm = 0;          ///< of the block along the axis
  std::vector<int> row, column;  ///< of each row-wire and column-wire: whose place it takes
  std::vector<int> upper, lower; ///< of each electrode, as SensorDesign counts them
  LoadAreas areas;

  /// Loads, displacements (3 x electrodes) and readings (row-wires x column-wires) of the image.
  [[nodiscard]] LoadCase image(LoadCase load) const;
  [[nodiscard]] ElectrodeDisplacements image(const ElectrodeDisplacements& moved) const;
  [[nodiscard]] Eigen::MatrixXd image(const Eigen::MatrixXd& resistances_ohm) const;
};

/// None where an electrode would come where none is.
std::optional<DesignMirror> mirrorOf(const SensorDesign& design, int axis);

} // namespace palp
