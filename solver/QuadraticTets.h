#pragma once

#include "model/Mesh.h"
#include "solver/TetMesher.h"

namespace palp {

/// Adds the edge midpoints: corners first, then midpoints, in VTK's order. The faces with a mark >= 0 become the top
/// faces, the mark their load area.
Mesh quadraticTets(const LinearTets& tets);

} // namespace palp
