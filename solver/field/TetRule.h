#pragma once

#include <Eigen/Core>

#include <array>

namespace palp {

/// Quadrature on a tetrahedron, with the quadratic shape functions at its points.
struct TetRule {
  static constexpr int points = 14;
  std::array<double, points> weights{}; ///< sum 1
  Eigen::Matrix<double, 10, points> shapes;
  std::array<Eigen::Matrix<double, 10, 3>, points> gradients; ///< by the last three barycentric coordinates

  TetRule();
};

const TetRule& tetRule();

} // namespace palp
