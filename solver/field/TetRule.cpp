#include "solver/field/TetRule.h"

#include "solver/element/ElementGeometry.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

/// N. J. Walkington, Quadrature on simplices of arbitrary dimension, 2000: 14 points, exact to degree 5.
TetRule::TetRule() {
  std::size_t i = 0;
  for (const auto& [a, w] :
       {std::pair{0.3108859192633006, 0.1126879257180159}, std::pair{0.0927352503108912, 0.0734930431163619}})
    for (int k = 0; k < 4; ++k, ++i) {
      barycentric[i].setConstant(a);
      barycentric[i](k) = 1 - 3 * a;
      weights[i] = w;
    }
  constexpr double a = 0.0455037041256497;
  for (int k = 0; k < 4; ++k)
    for (int l = k + 1; l < 4; ++l, ++i) {
      barycentric[i].setConstant(0.5 - a);
      barycentric[i](k) = barycentric[i](l) = a;
      weights[i] = 0.0425460207770815;
    }
  for (i = 0; i < points; ++i) {
    shapes.col(static_cast<Eigen::Index>(i)) = tetShapes(barycentric[i]);
    gradients[i] = tetLocalGradients(barycentric[i]);
  }
}

const TetRule& tetRule() {
  static const TetRule rule;
  return rule;
}

Eigen::Matrix<double, 10, 3> tetLocalGradients(const Eigen::Vector4d& barycentric) {
  TetGeometry unit;
  unit.gradients << -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1;
  return tetShapeGradients(unit, barycentric).transpose();
}

namespace {

using Corners = std::array<Eigen::Vector4d, 4>;

/// Four points, exact to degree 2 (A. H. Stroud, Approximate Calculation of Multiple Integrals, 1971); in a large piece
/// those of tetRule, as it may hold most of what is smooth but steep.
void addPiece(const Corners& corners, std::vector<TetPoint>& points) {
  constexpr double far = 0.5854101966249685, near = 0.1381966011250105, large = 0.1;
  Eigen::Matrix4d all;
  for (int k = 0; k < 4; ++k) all.col(k) = corners[std::size_t(k)];
  const double share = std::abs(all.determinant()); // of coordinates whose sum is 1: volumes' quotient
  if (share < 1e-12) return;                        // flat: the function is 0 at a corner
  if (share > large) {
    for (std::size_t q = 0; q < TetRule::points; ++q)
      points.push_back({all * tetRule().barycentric[q], tetRule().weights[q] * share});
    return;
  }
  for (const Eigen::Vector4d& corner : corners)
    points.push_back({near * all.rowwise().sum() + (far - near) * corner, share / 4});
}

/// A prism between two triangles, in three pieces.
void addPrism(const std::array<Eigen::Vector4d, 3>& a, const std::array<Eigen::Vector4d, 3>& b,
              std::vector<TetPoint>& points) {
  addPiece({a[0], a[1], a[2], b[2]}, points);
  addPiece({a[0], a[1], b[1], b[2]}, points);
  addPiece({a[0], b[0], b[1], b[2]}, points);
}

/// Pieces of a tetrahedron on either side of where what is linear between the values at its corners is 0.
void addCut(const Corners& corners, const Eigen::Vector4d& values, std::vector<TetPoint>& points) {
  std::array<int, 4> sorted{0, 1, 2, 3}; // positive ones first
  const auto middle =
      std::stable_partition(sorted.begin(), sorted.end(), [&](int corner) { return values(corner) > 0; });
  const auto positive = middle - sorted.begin();
  const auto at = [&](int k) { return corners[std::size_t(sorted[std::size_t(k)])]; };
  const auto between = [&](int k, int l) -> Eigen::Vector4d {
    const double a = values(sorted[std::size_t(k)]), b = values(sorted[std::size_t(l)]);
    return at(k) + a / (a - b) * (at(l) - at(k));
  };
  if (positive == 0 || positive == 4) return addPiece(corners, points);
  if (positive == 2) {
    addPrism({at(0), between(0, 2), between(0, 3)}, {at(1), between(1, 2), between(1, 3)}, points);
    return addPrism({at(2), between(0, 2), between(1, 2)}, {at(3), between(0, 3), between(1, 3)}, points);
  }
  const int tip = positive == 1 ? 0 : 3, base = positive == 1 ? 1 : 0;
  const std::array<Eigen::Vector4d, 3> cut{between(tip, base), between(tip, base + 1), between(tip, base + 2)};
  addPiece({at(tip), cut[0], cut[1], cut[2]}, points);
  addPrism(cut, {at(base), at(base + 1), at(base + 2)}, points);
}

/// The corners cut off, and the octahedron between them in four about one of its diagonals; by nodes.
constexpr int kEighths[8][4] = {{0, 4, 6, 7}, {1, 4, 5, 8}, {2, 5, 6, 9}, {3, 7, 8, 9},
                                {4, 9, 6, 5}, {4, 9, 5, 8}, {4, 9, 8, 7}, {4, 9, 7, 6}};

bool changesSign(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return (values.array() > 0).any() && !(values.array() > 0).all();
}

} // namespace

std::vector<TetPoint> tetPointsAroundKink(const Eigen::Matrix<double, 10, 1>& values) {
  std::vector<TetPoint> points;
  if (changesSign(values.head<4>())) {
    addCut({tetNode(0), tetNode(1), tetNode(2), tetNode(3)}, values.head<4>(), points);
  } else if (changesSign(values)) {
    for (const auto& [a, b, c, d] : kEighths)
      addCut({tetNode(a), tetNode(b), tetNode(c), tetNode(d)}, {values(a), values(b), values(c), values(d)}, points);
  } else {
    for (std::size_t q = 0; q < TetRule::points; ++q)
      points.push_back({tetRule().barycentric[q], tetRule().weights[q]});
  }
  return points;
}

} // namespace palp
