#include "solver/element/ElementGeometry.h"

#include "model/DesignError.h"
#include "solver/element/ElementKernels.h"

#include <Eigen/Dense>

#include <cmath>
#include <string>

namespace palp {

namespace {

void requirePositive(double measure, int element) {
  if (!(measure > 0)) throw DesignError("mesh: element " + std::to_string(element) + " is inside out or flat");
}

} // namespace

TetGeometry tetGeometry(const Mesh& mesh, int element) {
  const Eigen::Vector3d origin = mesh.nodes_mm.col(mesh.elements(0, element));
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) edges.row(i) = (mesh.nodes_mm.col(mesh.elements(i + 1, element)) - origin).transpose();
  TetGeometry geometry;
  geometry.volume = edges.determinant() / 6;
  geometry.gradients.rightCols<3>() = edges.inverse();
  geometry.gradients.col(0) = -geometry.gradients.rightCols<3>().rowwise().sum();
  return geometry;
}

Eigen::Matrix<double, 10, 1> tetShapes(const Eigen::Vector4d& l) {
  Eigen::Matrix<double, 10, 1> N;
  for (int i = 0; i < 4; ++i) N(i) = l(i) * (2 * l(i) - 1);
  for (int e = 0; e < 6; ++e) N(4 + e) = 4 * l(tetEdges[e][0]) * l(tetEdges[e][1]);
  return N;
}

Eigen::Matrix<double, 3, 10> tetShapeGradients(const TetGeometry& geometry, const Eigen::Vector4d& l) {
  Eigen::Matrix<double, 3, 10> dN;
  for (int i = 0; i < 4; ++i) dN.col(i) = (4 * l(i) - 1) * geometry.gradients.col(i);
  for (int e = 0; e < 6; ++e) {
    const int i = tetEdges[e][0], j = tetEdges[e][1];
    dN.col(4 + e) = 4 * (l(i) * geometry.gradients.col(j) + l(j) * geometry.gradients.col(i));
  }
  return dN;
}

Eigen::Vector4d tetNode(int n) {
  if (n < 4) return Eigen::Vector4d::Unit(n);
  return (Eigen::Vector4d::Unit(tetEdges[n - 4][0]) + Eigen::Vector4d::Unit(tetEdges[n - 4][1])) / 2;
}

double tetBubble(const Eigen::Vector4d& l) {
  return 256 * l.prod();
}

Eigen::Vector3d tetBubbleGradient(const TetGeometry& geometry, const Eigen::Vector4d& l) {
  const Eigen::Vector4d others(l(1) * l(2) * l(3), l(0) * l(2) * l(3), l(0) * l(1) * l(3), l(0) * l(1) * l(2));
  return 256 * (geometry.gradients * others);
}

Eigen::Vector3d hexCorner(int n) {
  const bool x = n % 4 == 1 || n % 4 == 2, y = n % 4 >= 2, z = n >= 4;
  return {x ? 1. : -1., y ? 1. : -1., z ? 1. : -1.};
}

HexPointGeometry hexGeometry(const Mesh& mesh, int element, const Eigen::Vector3d& reference) {
  HexPointGeometry point;
  Eigen::Matrix<double, 3, 8> referenceGradients, corners;
  for (int n = 0; n < 8; ++n) {
    const Eigen::Vector3d c = hexCorner(n);
    const Eigen::Vector3d f = Eigen::Vector3d::Ones() + c.cwiseProduct(reference);
    point.shapes(n) = f.prod() / 8;
    referenceGradients.col(n) = Eigen::Vector3d(c(0) * f(1) * f(2), c(1) * f(0) * f(2), c(2) * f(0) * f(1)) / 8;
    corners.col(n) = mesh.nodes_mm.col(mesh.elements(n, element));
  }
  const Eigen::Matrix3d map = corners * referenceGradients.transpose();
  point.determinant = map.determinant();
  point.gradients = map.inverse().transpose() * referenceGradients;
  return point;
}

void elementGeometry(const Mesh& mesh, int element, double* out, int stride) {
  auto put = [&, item = 0](double value) mutable { out[stride * item++] = value; };
  if (mesh.shape == ElementShape::Tetrahedron10) {
    const TetGeometry geometry = tetGeometry(mesh, element);
    requirePositive(geometry.volume, element);
    for (int k = 0; k < TetLayout::volume; ++k) put(geometry.gradients(k % 3, k / 3));
    put(geometry.volume);
    return;
  }
  for (int q = 0; q < HexLayout::points; ++q) {
    const HexPointGeometry point = hexGeometry(mesh, element, hexCorner(q) / std::sqrt(3.));
    requirePositive(point.determinant, element);
    for (int k = 0; k < HexLayout::weight; ++k) put(point.gradients(k % 3, k / 3));
    put(point.determinant);
  }
}

} // namespace palp
