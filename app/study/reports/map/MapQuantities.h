#pragma once

#include "app/study/reports/map/TouchMap.h"

#include <array>
#include <string>

namespace palp {

/// A quantity of a map: its name for tables and legends, its unit, a name for files, and its values.
struct MapQuantity {
  std::string name, unit, file;
  const Eigen::MatrixXd& (*of)(const TouchMap&);
  bool drawn = false; ///< in the report
};

/// All of them, in the order of the report's table.
const std::array<MapQuantity, 8>& mapQuantities();

} // namespace palp
