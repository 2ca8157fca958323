#pragma once

#include "model/SensorDesign.h"

#include <optional>
#include <vector>

namespace palp {

/// What a reflection under which a design is its own image does to its wires: each takes the place of another, or stays
/// where it is.
struct DesignMirror {
  std::vector<int> row, column; ///< of each row-wire and column-wire: whose place it takes
};

/// The reflection x -> length - x (axis 0), or that of y (axis 1); none where an electrode would come where none is.
std::optional<DesignMirror> mirrorOf(const SensorDesign& design, int axis);

} // namespace palp
