#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace palp {

/// Quadrature on a tetrahedron, with the quadratic shape functions at its points.
struct TetRule {
  static constexpr int points = 14;
  std::array<Eigen::Vector4d, points> barycentric{};
  std::array<double, points> weights{}; ///< sum 1
  Eigen::Matrix<double, 10, points> shapes;
  std::array<Eigen::Matrix<double, 10, 3>, points> gradients; ///< by the last three barycentric coordinates

  TetRule();
};

const TetRule& tetRule();

/// Derivatives of the quadratic shape functions by the last three barycentric coordinates.
Eigen::Matrix<double, 10, 3> tetLocalGradients(const Eigen::Vector4d& barycentric);

/// A point of a quadrature, and its weight as a share of the tetrahedron's volume.
struct TetPoint {
  Eigen::Vector4d barycentric;
  double weight = 0;
};

/// Points for what jumps where a function changes its sign, from the function's values at the ten nodes: those of
/// tetRule where it does not; else the tetrahedron is cut along the plane on which the function between the corners is
/// 0, and each piece has four points, exact to degree 2, or if it is larger than a tenth those of tetRule. Where only
/// nodes between corners have the other sign, its eighths are cut so. (The leading error of a rule that steps over a
/// jump is of first order in the mesh size.)
std::vector<TetPoint> tetPointsAroundKink(const Eigen::Matrix<double, 10, 1>& values);

} // namespace palp
