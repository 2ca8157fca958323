#pragma once

#include "model/Mesh.h"

#include <Eigen/Core>

namespace palp {

/// Barycentric coordinates' gradients (one column a corner) and volume of a straight tetrahedron.
struct TetGeometry {
  Eigen::Matrix<double, 3, 4> gradients;
  double volume = 0;
};
TetGeometry tetGeometry(const Mesh& mesh, int element);

/// Quadratic shape functions at barycentric coordinates, in VTK's order; the quartic bubble.
Eigen::Matrix<double, 10, 1> tetShapes(const Eigen::Vector4d& barycentric);
Eigen::Matrix<double, 3, 10> tetShapeGradients(const TetGeometry& geometry, const Eigen::Vector4d& barycentric);
/// Barycentric coordinates of node n.
Eigen::Vector4d tetNode(int n);
double tetBubble(const Eigen::Vector4d& barycentric);
Eigen::Vector3d tetBubbleGradient(const TetGeometry& geometry, const Eigen::Vector4d& barycentric);

/// Trilinear shape functions at reference coordinates in [-1, 1], their gradients in space and det of the map.
struct HexPointGeometry {
  Eigen::Matrix<double, 8, 1> shapes;
  Eigen::Matrix<double, 3, 8> gradients;
  double determinant = 0;
};
HexPointGeometry hexGeometry(const Mesh& mesh, int element, const Eigen::Vector3d& reference);

/// Reference coordinates of VTK's corner n.
Eigen::Vector3d hexCorner(int n);

/// The coordinates that the kernels need of one element: ElementKernels.h.
void elementGeometry(const Mesh& mesh, int element, double* out, int stride);

} // namespace palp
