#pragma once

#include <Eigen/Core>

namespace palp {

/// Quadrature points on the boundary of the deformed block, face by face: positions, and the outward normal times the
/// area weight of each.
class BoundaryQuadrature {
public:
  /// Nodes of the faces as FieldMesh has them.
  BoundaryQuadrature(const Eigen::MatrixXi& faces, const Eigen::Matrix3Xd& nodes_mm);

  static constexpr int pointsAFace = 25;
  /// Potential 1/(4 pi r) of sources (3 x sources) together at the points of faces first .. first + count - 1, and its
  /// flux outward times the area.
  void sources(const Eigen::Matrix3Xd& sources_mm, int first, int count, double* potential, double* flux) const;
  /// Integrals of a face's six shape functions times values at its points, which include the areas.
  [[nodiscard]] static Eigen::Matrix<double, 6, 1> onShapes(const double* points);
  /// The same with its three barycentric coordinates.
  [[nodiscard]] static Eigen::Matrix<double, 3, 1> onCorners(const double* points);
  /// At a face's points, what is quadratic in its six nodes' values.
  [[nodiscard]] static Eigen::Matrix<double, pointsAFace, 1> atPoints(const Eigen::Matrix<double, 6, 1>& nodes);

private:
  Eigen::Matrix<double, Eigen::Dynamic, 6> at_; ///< points x (place, normal times area)
};

} // namespace palp
