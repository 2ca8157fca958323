#include "solver/GradedTets.h"

#include "model/Error.h"
#include "solver/QuadraticTets.h"
#include "solver/StretchMap.h"
#include "solver/TetMesher.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace palp {

namespace {

constexpr int sideMark = -1;
constexpr double volumeOfUnitSize = 0.12; // a regular tetrahedron of edge 1 has 0.118

using StretchMaps = std::array<StretchMap, 3>;

StretchMap horizontalMap(double length, int parts, const Grading& grading) {
  std::vector<FinePlace> places{{0, grading.edge_mm}, {length, grading.edge_mm}};
  for (int i = 1; i < parts; ++i) places.push_back({length * i / parts, grading.border_mm});
  return {length, grading.bulk_mm, grading.growth, places};
}

StretchMaps stretchMaps(const SensorDesign& design, const Grading& grading) {
  const Eigen::Vector3d& block = design.block_mm;
  return {horizontalMap(block.x(), design.areas.columns, grading), horizontalMap(block.y(), design.areas.rows, grading),
          StretchMap(block.z(), grading.vertical_mm, grading.growth,
                     {{0, grading.bottom_mm}, {block.z(), grading.top_mm}})};
}

/// Surface of the block: one facet a load area (its mark), the rest marked sideMark; side facets list the points where
/// the areas' borders meet the rim.
struct Surface {
  std::vector<Eigen::Vector3d> points;
  std::vector<Facet> facets;
};

Surface blockSurface(const SensorDesign& design) {
  const int nx = design.areas.columns, ny = design.areas.rows;
  const Eigen::Vector3d& block = design.block_mm;
  Surface surface;
  const auto top = [nx](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) surface.points.emplace_back(block.x() * i / nx, block.y() * j / ny, block.z());
  const int bottom = static_cast<int>(surface.points.size());
  for (const auto& [x, y] : {std::array{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}})
    surface.points.emplace_back(block.x() * x, block.y() * y, 0);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      surface.facets.push_back({{top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1)}, j * nx + i});
  surface.facets.push_back({{bottom, bottom + 1, bottom + 2, bottom + 3}, sideMark});
  Facet south{{bottom, bottom + 1}, sideMark}, north{{bottom + 3, bottom + 2}, sideMark};
  for (int i = nx; i >= 0; --i) {
    south.corners.push_back(top(i, 0));
    north.corners.push_back(top(i, ny));
  }
  Facet west{{bottom, bottom + 3}, sideMark}, east{{bottom + 1, bottom + 2}, sideMark};
  for (int j = ny; j >= 0; --j) {
    west.corners.push_back(top(0, j));
    east.corners.push_back(top(nx, j));
  }
  surface.facets.insert(surface.facets.end(), {south, north, west, east});
  return surface;
}

/// Back from stretched coordinates; the points of the outside snap to its planes.
Eigen::Vector3d unstretched(const StretchMaps& maps, const Eigen::Vector3d& block, const Eigen::Vector3d& t) {
  Eigen::Vector3d x;
  for (int d = 0; d < 3; ++d) {
    x(d) = maps[d].unstretched(t(d));
    if (std::abs(x(d)) < 1e-9 * block(d)) x(d) = 0;
    if (std::abs(x(d) - block(d)) < 1e-9 * block(d)) x(d) = block(d);
  }
  return x;
}

bool allPositive(const LinearTets& tets) {
  for (Eigen::Index e = 0; e < tets.corners.cols(); ++e) {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i)
      edges.col(i) = tets.points.col(tets.corners(i + 1, e)) - tets.points.col(tets.corners(0, e));
    if (!(edges.determinant() > 0)) return false;
  }
  return true;
}

} // namespace

Grading defaultGrading(const SensorDesign& design, double factor) {
  Grading g;
  static_cast<void>(design);
  for (double* size : {&g.bulk_mm, &g.border_mm, &g.edge_mm, &g.bottom_mm, &g.top_mm, &g.vertical_mm}) *size *= factor;
  return g;
}

Mesh gradedTets(const SensorDesign& design, const Grading& grading) {
  const StretchMaps maps = stretchMaps(design, grading);
  const Surface surface = blockSurface(design);
  const Eigen::Matrix3Xd electrodes = design.upperElectrodes_mm();
  const auto corners = static_cast<Eigen::Index>(surface.points.size());
  Eigen::Matrix3Xd points(3, corners + electrodes.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d x = i < corners ? surface.points[i] : Eigen::Vector3d(electrodes.col(i - corners));
    for (int d = 0; d < 3; ++d) points(d, i) = maps[d].stretched(x(d));
  }
  LinearTets tets = tetrahedralise(points, surface.facets, volumeOfUnitSize);
  for (Eigen::Index i = 0; i < tets.points.cols(); ++i)
    tets.points.col(i) = unstretched(maps, design.block_mm, tets.points.col(i));
  for (Eigen::Index i = 0; i < corners; ++i) tets.points.col(i) = surface.points[i];
  tets.points.middleCols(corners, electrodes.cols()) = electrodes;
  if (!allPositive(tets)) {
    for (Eigen::Index e = 0; e < tets.corners.cols(); ++e) std::swap(tets.corners(0, e), tets.corners(1, e));
    if (!allPositive(tets)) throw DesignError("mesh: the grading is too steep and turns elements inside out");
  }
  Mesh mesh = quadraticTets(tets);
  for (Eigen::Index i = 0; i < electrodes.cols(); ++i)
    mesh.upperElectrodeNodes.push_back(static_cast<int>(corners + i));
  return mesh;
}

} // namespace palp
