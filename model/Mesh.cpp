#include "model/Mesh.h"

#include <algorithm>

namespace palp {

std::vector<bool> clampedNodes(const Mesh& mesh) {
  const double tolerance_mm = 1e-9 * mesh.nodes_mm.row(2).maxCoeff();
  std::vector<bool> clamped;
  for (const double z_mm : mesh.nodes_mm.row(2)) clamped.push_back(z_mm <= tolerance_mm);
  return clamped;
}

int freeUnknowns(const Mesh& mesh) {
  const std::vector<bool> clamped = clampedNodes(mesh);
  return static_cast<int>(3 * std::count(clamped.begin(), clamped.end(), false));
}

std::string shapeName(ElementShape shape) {
  return shape == ElementShape::Tetrahedron10 ? "10-node tetrahedra" : "8-node hexahedra";
}

} // namespace palp
