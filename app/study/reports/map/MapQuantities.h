#pragma once

#include "app/study/reports/map/TouchMap.h"

#include <array>
#include <string>

namespace palp {

/// A quantity of a map: its name for tables and legends, its unit, a name for files, and where it stands.
struct MapQuantity {
  std::string name, unit, file;
  const Eigen::MatrixXd& (*of)(const TouchMap&);
  bool drawn = false; ///< in the report
};

/// All of them, in the order of the report's table.
const std::array<MapQuantity, 8>& mapQuantities();

/// What is assumed of touches, by Eq. (1) and under the field.
extern const char* const kPairsTouched;
extern const char* const kFieldTouched;

} // namespace palp
