#pragma once

#include "model/Mesh.h"

#include <array>

namespace palp {

/// Shape of the elements: dihedral angles, of tetrahedra and hexahedra alike, and a histogram to be drawn.
struct MeshQuality {
  double minDihedral_deg = 0;
  double maxDihedral_deg = 0;
  std::array<int, 18> minDihedralHistogram{}; ///< elements by their smallest dihedral angle, 10 degrees per bin
};
MeshQuality meshQuality(const Mesh& mesh);

} // namespace palp
