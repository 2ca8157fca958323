#include "model/Mesh.h"

namespace palp {

int freeUnknowns(const Mesh& mesh) {
  return static_cast<int>(3 * (mesh.nodes_mm.row(2).array() > 0).count());
}

std::string shapeName(ElementShape shape) {
  return shape == ElementShape::Tetrahedron10 ? "10-node tetrahedra" : "8-node hexahedra";
}

} // namespace palp
