#include "app/scenes/MeshSurface.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace palp {

namespace {

using Face = std::vector<int>;
using Triangle = std::array<int, 3>;

// Local nodes of an element's faces in VTK's order, corners first; outward normals by the right hand.
const std::vector<Face> kTetrahedronFaces{
    {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}, {0, 2, 1, 6, 5, 4}};
const std::vector<Face> kHexahedronFaces{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                         {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

std::vector<Triangle> trianglesOf(const Face& face) {
  if (face.size() == 4) return {{face[0], face[1], face[2]}, {face[0], face[2], face[3]}};
  return {{face[0], face[3], face[5]},
          {face[3], face[1], face[4]},
          {face[5], face[4], face[2]},
          {face[3], face[4], face[5]}};
}

std::vector<Face> edgesOf(const Face& face) {
  if (face.size() == 4) return {{face[0], face[1]}, {face[1], face[2]}, {face[2], face[3]}, {face[3], face[0]}};
  return {{face[0], face[3], face[1]}, {face[1], face[4], face[2]}, {face[2], face[5], face[0]}};
}

/// Faces that belong to one element only, in the elements' order.
std::vector<Face> boundaryFaces(const Mesh& mesh) {
  const bool tetrahedra = mesh.shape == ElementShape::Tetrahedron10;
  const std::vector<Face>& local = tetrahedra ? kTetrahedronFaces : kHexahedronFaces;
  const std::size_t corners = tetrahedra ? 3 : 4;
  std::map<Face, int> count;
  std::vector<Face> all;
  std::vector<Face> keys;
  for (int element = 0; element < mesh.elementCount(); ++element)
    for (const Face& places : local) {
      Face face(places.size());
      std::transform(places.begin(), places.end(), face.begin(), [&](int k) { return mesh.elements(k, element); });
      Face key(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(corners));
      std::sort(key.begin(), key.end());
      ++count[key];
      all.push_back(std::move(face));
      keys.push_back(std::move(key));
    }
  std::vector<Face> boundary;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (count[keys[k]] == 1) boundary.push_back(std::move(all[k]));
  return boundary;
}

/// Barycentric coordinates of the point in the triangle, seen from above.
Eigen::Vector3d barycentric(const Mesh& mesh, const Triangle& triangle, const Eigen::Vector2d& xy) {
  const Eigen::Vector2d a = mesh.nodes_mm.col(triangle[0]).head<2>();
  Eigen::Matrix2d sides;
  sides.col(0) = mesh.nodes_mm.col(triangle[1]).head<2>() - a;
  sides.col(1) = mesh.nodes_mm.col(triangle[2]).head<2>() - a;
  const Eigen::Vector2d t = sides.inverse() * (xy - a);
  return {1 - t.sum(), t.x(), t.y()};
}

} // namespace

MeshSurface meshSurface(const Mesh& mesh) {
  MeshSurface surface;
  std::unordered_map<int, int> place;
  const auto point = [&](int node) {
    const auto [found, added] = place.try_emplace(node, static_cast<int>(surface.nodes.size()));
    if (added) surface.nodes.push_back(node);
    return found->second;
  };
  std::map<std::array<int, 2>, bool> drawn;
  for (Face face : boundaryFaces(mesh)) {
    std::transform(face.begin(), face.end(), face.begin(), point);
    for (const Triangle& triangle : trianglesOf(face)) surface.triangles.push_back(triangle);
    for (Face& edge : edgesOf(face)) {
      const std::array<int, 2> ends{std::min(edge.front(), edge.back()), std::max(edge.front(), edge.back())};
      if (drawn.try_emplace(ends, true).second) surface.edges.push_back(std::move(edge));
    }
  }
  return surface;
}

Eigen::Vector3d TopPoint::of(const Eigen::Matrix3Xd& nodal) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) mean += weights[k] * nodal.col(nodes[k]);
  return mean;
}

TopPoint topPoint(const Mesh& mesh, const Eigen::Vector2d& xy_mm) {
  TopPoint best;
  double farthestOut = -std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < mesh.topFaces.cols(); ++k) {
    const Eigen::VectorXi nodes = mesh.topFaces.col(k);
    const Face face(nodes.begin(), nodes.end());
    for (const Triangle& triangle : trianglesOf(face)) {
      const Eigen::Vector3d weights = barycentric(mesh, triangle, xy_mm);
      if (!(weights.minCoeff() > farthestOut)) continue;
      farthestOut = weights.minCoeff();
      best = {triangle, {weights[0], weights[1], weights[2]}};
      if (farthestOut >= 0) return best;
    }
  }
  return best;
}

std::vector<std::vector<TopPoint>> areaBorders(const Mesh& mesh, const SensorDesign& design, int steps) {
  std::vector<std::vector<TopPoint>> borders;
  for (int area = 0; area < design.areas.count(); ++area) {
    const Rectangle box = design.areaRectangle(area);
    const std::array<Eigen::Vector2d, 5> corners{
        box.low_mm, {box.high_mm.x(), box.low_mm.y()}, box.high_mm, {box.low_mm.x(), box.high_mm.y()}, box.low_mm};
    std::vector<TopPoint> border;
    for (std::size_t side = 0; side < 4; ++side)
      for (int k = side == 0 ? 0 : 1; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        border.push_back(topPoint(mesh, (1 - t) * corners[side] + t * corners[side + 1]));
      }
    borders.push_back(std::move(border));
  }
  return borders;
}

} // namespace palp
