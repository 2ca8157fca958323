#pragma once

#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <array>

namespace palp {

/// The paper's mapped mesh: equal 8-node hexahedra, `counts` along x, y, z. The area of a top face is that of its
/// centre; tractions are integrated over the area itself.
Mesh mappedMesh(const SensorDesign& design, const std::array<int, 3>& counts);

} // namespace palp
