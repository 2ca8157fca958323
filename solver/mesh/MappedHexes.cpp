#include "solver/mesh/MappedHexes.h"

#include "solver/mesh/TopFaces.h"

namespace palp {

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
  mesh.topFaceAreas = areasOfTopFaces(design, mesh);
  return mesh;
}

} // namespace palp
