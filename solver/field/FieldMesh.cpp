#include "solver/field/FieldMesh.h"

#include "solver/element/ElementKernels.h"
#include "solver/mesh/QuadraticTets.h"

#include <algorithm>
#include <array>
#include <vector>

namespace palp {

namespace {

/// VTK's number of a hexahedron's corner; bits 0, 1, 2 of `at` say x, y, z.
int vtkCorner(unsigned at) {
  static constexpr std::array<int, 8> number{0, 1, 3, 2, 4, 5, 7, 6};
  return number[at];
}

/// Corners of the six tetrahedra along the diagonal of a cube, one for each order in which a way from corner 0 to
/// corner 7 goes along the axes (H. W. Kuhn, 1960): neighbours cut their common face alike.
std::array<std::array<unsigned, 4>, 6> diagonalTets() {
  std::array<std::array<unsigned, 4>, 6> all{};
  std::array<unsigned, 3> axes{0, 1, 2};
  for (auto& tet : all) {
    tet = {0, 1U << axes[0], (1U << axes[0]) | (1U << axes[1]), 7};
    std::next_permutation(axes.begin(), axes.end());
  }
  return all;
}

int edgeBetween(int a, int b) {
  for (int e = 0; e < 6; ++e)
    if (std::minmax(tetEdges[e][0], tetEdges[e][1]) == std::minmax(a, b)) return e;
  return -1;
}

struct Face {
  std::array<int, 3> key; ///< corners, ascending
  int element, side;
};

constexpr int kSides[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}; // counter-clockwise from outside

} // namespace

FieldMesh::FieldMesh(const Mesh& solverMesh) {
  if (solverMesh.shape == ElementShape::Hexahedron8) {
    cutHexahedra(solverMesh);
  } else {
    tets_.nodes_mm = solverMesh.nodes_mm;
    tets_.elements = solverMesh.elements;
  }
  tets_.size_mm = solverMesh.size_mm;
  findFaces();
  corners_ = tets_.elements.topRows<4>().maxCoeff() + 1;
}

void FieldMesh::cutHexahedra(const Mesh& hexahedra) {
  const auto cut = diagonalTets();
  const Eigen::Index hexes = hexahedra.elements.cols();
  LinearTets linear;
  linear.corners.resize(4, 6 * hexes);
  for (Eigen::Index h = 0; h < hexes; ++h)
    for (std::size_t t = 0; t < 6; ++t)
      for (std::size_t k = 0; k < 4; ++k)
        linear.corners(static_cast<Eigen::Index>(k), 6 * h + static_cast<Eigen::Index>(t)) =
            hexahedra.elements(vtkCorner(cut[t][k]), h);
  tets_ = quadraticTets(hexahedra.nodes_mm, linear);
  cornersAround_ = Eigen::MatrixXi::Constant(8, tets_.nodeCount(), -1);
  for (Eigen::Index n = 0; n < hexahedra.nodes_mm.cols(); ++n) cornersAround_(0, n) = static_cast<int>(n);
  for (Eigen::Index h = 0; h < hexes; ++h) {
    const auto bitsOf = [&](int node) {
      unsigned at = 0;
      while (hexahedra.elements(vtkCorner(at), h) != node) ++at;
      return at;
    };
    for (Eigen::Index t = 6 * h; t < 6 * h + 6; ++t)
      for (int e = 0; e < 6; ++e) {
        const unsigned a = bitsOf(tets_.elements(tetEdges[e][0], t)), b = bitsOf(tets_.elements(tetEdges[e][1], t));
        int count = 0;
        for (unsigned c = 0; c < 8; ++c) // those that lie where both ends do
          if (((c ^ a) & ~(a ^ b)) == 0)
            cornersAround_(count++, tets_.elements(4 + e, t)) = hexahedra.elements(vtkCorner(c), h);
      }
  }
}

void FieldMesh::findFaces() {
  std::vector<Face> all;
  all.reserve(4 * static_cast<std::size_t>(elements()));
  for (int e = 0; e < elements(); ++e)
    for (int side = 0; side < 4; ++side) {
      Face face{{}, e, side};
      for (std::size_t k = 0; k < 3; ++k) face.key[k] = tets_.elements(kSides[side][k], e);
      std::sort(face.key.begin(), face.key.end());
      all.push_back(face);
    }
  std::sort(all.begin(), all.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
  std::vector<Face> outer;
  neighbours_ = Eigen::MatrixXi::Constant(4, elements(), -1);
  const auto behind = [&](const Face& face) -> int& {
    const int* side = kSides[face.side];
    return neighbours_(6 - side[0] - side[1] - side[2], face.element);
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i + 1 < all.size() && all[i].key == all[i + 1].key) {
      behind(all[i]) = all[i + 1].element;
      behind(all[i + 1]) = all[i].element;
      ++i;
    } else {
      outer.push_back(all[i]);
    }
  faces_.resize(6, static_cast<Eigen::Index>(outer.size()));
  for (std::size_t f = 0; f < outer.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int* side = kSides[outer[f].side];
      const auto column = static_cast<Eigen::Index>(f);
      faces_(k, column) = tets_.elements(side[k], outer[f].element);
      faces_(3 + k, column) = tets_.elements(4 + edgeBetween(side[k], side[(k + 1) % 3]), outer[f].element);
    }
}

Eigen::MatrixXd FieldMesh::atNodes(const Eigen::Ref<const Eigen::MatrixXd>& solverNodes) const {
  if (cornersAround_.size() == 0) return solverNodes;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(solverNodes.rows(), nodes());
  for (int n = 0; n < nodes(); ++n) {
    int count = 0;
    while (count < 8 && cornersAround_(count, n) >= 0) all.col(n) += solverNodes.col(cornersAround_(count++, n));
    all.col(n) /= count;
  }
  return all;
}

} // namespace palp
