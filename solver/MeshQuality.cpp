#include "solver/MeshQuality.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

struct Angles {
  double smallest = 180, largest = 0;
};

/// Dihedral angle [degrees] at the edge a b between the half planes through c and d.
double dihedral(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d) {
  const Eigen::Vector3d n1 = (b - a).cross(c - a), n2 = (b - a).cross(d - a);
  return std::atan2(n1.cross(n2).norm(), n1.dot(n2)) * 180 / std::numbers::pi;
}

Angles anglesOf(const Mesh& mesh, Eigen::Index element) {
  // An edge's two corners, and one corner of each face that meets there.
  static constexpr std::array<std::array<int, 4>, 6> tet{
      {{0, 1, 2, 3}, {1, 2, 0, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  static constexpr std::array<std::array<int, 4>, 12> hex{{{0, 1, 3, 4},
                                                           {1, 2, 0, 5},
                                                           {2, 3, 1, 6},
                                                           {3, 0, 2, 7},
                                                           {4, 5, 7, 0},
                                                           {5, 6, 4, 1},
                                                           {6, 7, 5, 2},
                                                           {7, 4, 6, 3},
                                                           {0, 4, 1, 3},
                                                           {1, 5, 0, 2},
                                                           {2, 6, 1, 3},
                                                           {3, 7, 2, 0}}};
  Angles angles;
  const auto add = [&](const auto& edges) {
    for (const auto& [a, b, c, d] : edges) {
      const auto corner = [&](int n) { return Eigen::Vector3d(mesh.nodes_mm.col(mesh.elements(n, element))); };
      const double angle = dihedral(corner(a), corner(b), corner(c), corner(d));
      angles.smallest = std::min(angles.smallest, angle);
      angles.largest = std::max(angles.largest, angle);
    }
  };
  if (mesh.shape == ElementShape::Tetrahedron10) {
    add(tet);
  } else {
    add(hex);
  }
  return angles;
}

} // namespace

MeshQuality meshQuality(const Mesh& mesh) {
  MeshQuality quality;
  quality.minDihedral_deg = 180;
  for (Eigen::Index e = 0; e < mesh.elementCount(); ++e) {
    const Angles angles = anglesOf(mesh, e);
    quality.minDihedral_deg = std::min(quality.minDihedral_deg, angles.smallest);
    quality.maxDihedral_deg = std::max(quality.maxDihedral_deg, angles.largest);
    ++quality.minDihedralHistogram[std::min<std::size_t>(17, static_cast<std::size_t>(angles.smallest / 10))];
  }
  return quality;
}

} // namespace palp
