#include "solver/mesh/MappedHexes.h"

#include <algorithm>

namespace palp {

namespace {

/// Load area of a point of the top face.
int areaAt(const SensorDesign& design, const Eigen::Vector2d& p) {
  const int column = static_cast<int>(p.x() / design.block_mm.x() * design.areas.columns);
  const int row = static_cast<int>(p.y() / design.block_mm.y() * design.areas.rows);
  return std::min(row, design.areas.rows - 1) * design.areas.columns + std::min(column, design.areas.columns - 1);
}

} // namespace

Mesh mappedMesh(const SensorDesign& design, const std::array<int, 3>& counts) {
  const auto [nx, ny, nz] = counts;
  const auto node = [nx = nx, ny = ny](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  Mesh mesh;
  mesh.shape = ElementShape::Hexahedron8;
  mesh.nodes_mm.resize(3, Eigen::Index(nx + 1) * (ny + 1) * (nz + 1));
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        mesh.nodes_mm.col(node(i, j, k)) =
            design.block_mm.cwiseProduct(Eigen::Vector3d(double(i) / nx, double(j) / ny, double(k) / nz));
  mesh.elements.resize(8, Eigen::Index(nx) * ny * nz);
  for (int k = 0, e = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i, ++e)
        mesh.elements.col(e) << node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1);
  mesh.topFaces = mesh.elements.bottomRightCorner(4, Eigen::Index(nx) * ny);
  mesh.topFaceAreas.resize(mesh.topFaces.cols());
  for (Eigen::Index f = 0; f < mesh.topFaces.cols(); ++f) {
    const Eigen::Vector3d centre =
        (mesh.nodes_mm.col(mesh.topFaces(0, f)) + mesh.nodes_mm.col(mesh.topFaces(2, f))) / 2;
    mesh.topFaceAreas(f) = areaAt(design, centre.head<2>());
  }
  return mesh;
}

} // namespace palp
