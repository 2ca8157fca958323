#include "app/scenes/block/MeshSurface.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

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
  struct Side {
    std::array<int, 4> key; ///< corners, ascending; -1 before those of a triangle
    int element, face;
  };
  std::vector<Side> sides;
  sides.reserve(static_cast<std::size_t>(mesh.elementCount()) * local.size());
  for (int element = 0; element < mesh.elementCount(); ++element)
    for (std::size_t face = 0; face < local.size(); ++face) {
      Side side{{-1, -1, -1, -1}, element, static_cast<int>(face)};
      for (std::size_t k = 0; k < corners; ++k) side.key[k] = mesh.elements(local[face][k], element);
      std::sort(side.key.begin(), side.key.end());
      sides.push_back(side);
    }
  const auto ofElement = [](const Side& a, const Side& b) {
    return std::pair(a.element, a.face) < std::pair(b.element, b.face);
  };
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
  std::vector<Side> alone;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const bool before = k > 0 && sides[k - 1].key == sides[k].key;
    const bool after = k + 1 < sides.size() && sides[k + 1].key == sides[k].key;
    if (!before && !after) alone.push_back(sides[k]);
  }
  std::sort(alone.begin(), alone.end(), ofElement);
  std::vector<Face> boundary;
  for (const Side& side : alone) {
    const Face& places = local[static_cast<std::size_t>(side.face)];
    Face face(places.size());
    std::transform(places.begin(), places.end(), face.begin(), [&](int k) { return mesh.elements(k, side.element); });
    boundary.push_back(std::move(face));
  }
  return boundary;
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
  std::unordered_set<std::int64_t> drawn;
  for (Face face : boundaryFaces(mesh)) {
    std::transform(face.begin(), face.end(), face.begin(), point);
    for (const Triangle& triangle : trianglesOf(face)) surface.triangles.push_back(triangle);
    for (Face& edge : edgesOf(face)) {
      const auto [low, high] = std::minmax(edge.front(), edge.back());
      if (drawn.insert((static_cast<std::int64_t>(low) << 32) + high).second) surface.edges.push_back(std::move(edge));
    }
  }
  return surface;
}

Eigen::Vector3d TopPoint::of(const Eigen::Matrix3Xd& nodal) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) mean += weights[k] * nodal.col(nodes[k]);
  return mean;
}

TopFace::TopFace(const Mesh& mesh) {
  for (Eigen::Index k = 0; k < mesh.topFaces.cols(); ++k) {
    const Eigen::VectorXi nodes = mesh.topFaces.col(k);
    for (const Triangle& triangle : trianglesOf(Face(nodes.begin(), nodes.end()))) {
      const Eigen::Vector2d a = mesh.nodes_mm.col(triangle[0]).head<2>();
      Eigen::Matrix2d sides;
      sides.col(0) = mesh.nodes_mm.col(triangle[1]).head<2>() - a;
      sides.col(1) = mesh.nodes_mm.col(triangle[2]).head<2>() - a;
      pieces_.push_back({triangle, a, sides.inverse()});
    }
  }
}

TopPoint TopFace::at(const Eigen::Vector2d& xy_mm) const {
  TopPoint best;
  double farthestOut = -std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces_) {
    const Eigen::Vector2d t = piece.inverse * (xy_mm - piece.corner);
    const Eigen::Vector3d weights(1 - t.sum(), t.x(), t.y());
    if (!(weights.minCoeff() > farthestOut)) continue;
    farthestOut = weights.minCoeff();
    best = {piece.nodes, {weights[0], weights[1], weights[2]}};
    if (farthestOut >= 0) return best;
  }
  return best;
}

TopPoint topPoint(const Mesh& mesh, const Eigen::Vector2d& xy_mm) {
  return TopFace(mesh).at(xy_mm);
}

std::vector<std::vector<TopPoint>> areaBorders(const TopFace& top, const SensorDesign& design, int steps) {
  std::vector<std::vector<TopPoint>> borders;
  for (int area = 0; area < design.areas.count(); ++area) {
    const Rectangle box = design.areaRectangle(area);
    const std::array<Eigen::Vector2d, 5> corners{
        box.low_mm, {box.high_mm.x(), box.low_mm.y()}, box.high_mm, {box.low_mm.x(), box.high_mm.y()}, box.low_mm};
    std::vector<TopPoint> border;
    for (std::size_t side = 0; side < 4; ++side)
      for (int k = side == 0 ? 0 : 1; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        border.push_back(top.at((1 - t) * corners[side] + t * corners[side + 1]));
      }
    borders.push_back(std::move(border));
  }
  return borders;
}

} // namespace palp
