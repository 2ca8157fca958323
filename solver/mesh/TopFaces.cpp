#include "solver/mesh/TopFaces.h"

#include <algorithm>

namespace palp {

namespace {

/// Which of the equal parts of [0, length] holds x; of the full length, the last one.
int partAt(double x, double length, int parts) {
  return std::min(parts - 1, static_cast<int>(x / length * parts));
}

} // namespace

Eigen::VectorXi areasOfTopFaces(const SensorDesign& design, const Mesh& mesh) {
  const int corners = mesh.shape == ElementShape::Tetrahedron10 ? 3 : 4; // the first nodes of a face
  Eigen::VectorXi areas(mesh.topFaces.cols());
  for (Eigen::Index f = 0; f < areas.size(); ++f) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int n = 0; n < corners; ++n) centre += mesh.nodes_mm.col(mesh.topFaces(n, f)) / corners;
    const int column = partAt(centre.x(), design.block_mm.x(), design.areas.columns);
    const int row = partAt(centre.y(), design.block_mm.y(), design.areas.rows);
    areas(f) = row * design.areas.columns + column;
  }
  return areas;
}

} // namespace palp
