#pragma once

#include "model/Indenter.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace palp {

struct SensorDesign;

/// The part of an indenter's surface that a touch may reach, as triangles with their corners on it.
struct IndenterSurface {
  Eigen::Matrix3Xd points_mm;                ///< from the indenter's lowest point
  std::vector<std::array<int, 3>> triangles; ///< counterclockwise seen from above
};

/// As fine as a sixteenth of the contact's half width that closed forms expect, and 1.6 times as wide.
IndenterSurface indenterSurface(const Indenter& indenter, const SensorDesign& design);

} // namespace palp
