#include "solver/assembly/NodalFields.h"

#include "solver/element/ElementGeometry.h"
#include "solver/element/ElementKernels.h"
#include "solver/element/MooneyRivlin.h"

#include <Eigen/Dense>

#include <cmath>

namespace palp {

namespace {

/// Deformation gradient and pressure (tension positive) at one point of an element.
struct PointState {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  double pressure = 0;
};

PointState tetAtNode(const Mesh& mesh, const TetGeometry& geometry, const LoadIncrement& state, int element, int n) {
  const Eigen::Vector4d l = tetNode(n);
  const Eigen::Matrix<double, 3, 10> dN = tetShapeGradients(geometry, l);
  PointState point;
  for (int k = 0; k < 10; ++k) point.F += state.displacements_mm.col(mesh.elements(k, element)) * dN.col(k).transpose();
  const auto own = state.elementUnknowns.col(element);
  point.F += own.head<3>() * tetBubbleGradient(geometry, l).transpose();
  point.pressure = own.tail<4>().dot(l);
  return point;
}

PointState hexAtNode(const Mesh& mesh, const LoadIncrement& state, int element, int n) {
  const HexPointGeometry geometry = hexGeometry(mesh, element, hexCorner(n));
  PointState point;
  for (int k = 0; k < 8; ++k)
    point.F += state.displacements_mm.col(mesh.elements(k, element)) * geometry.gradients.col(k).transpose();
  point.pressure = state.elementUnknowns(0, element);
  return point;
}

double vonMises(const Eigen::Matrix<double, 6, 1>& s) {
  const double normal = std::pow(s(0) - s(1), 2) + std::pow(s(1) - s(2), 2) + std::pow(s(2) - s(0), 2);
  return std::sqrt(normal / 2 + 3 * (s(3) * s(3) + s(4) * s(4) + s(5) * s(5)));
}

} // namespace

NodalFields nodalFields(const Mesh& mesh, const Material& material, const LoadIncrement& state) {
  const int nodes = mesh.nodeCount();
  NodalFields fields;
  fields.displacement_mm = state.displacements_mm;
  fields.cauchy_MPa.setZero(6, nodes);
  fields.volumeRatio.setZero(nodes);
  Eigen::Matrix<double, 9, Eigen::Dynamic> gradients = Eigen::Matrix<double, 9, Eigen::Dynamic>::Zero(9, nodes);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(nodes);
  for (int e = 0; e < mesh.elementCount(); ++e) {
    const bool tet = mesh.shape == ElementShape::Tetrahedron10;
    const TetGeometry geometry = tet ? tetGeometry(mesh, e) : TetGeometry{};
    for (int n = 0; n < mesh.elements.rows(); ++n) {
      const PointState point = tet ? tetAtNode(mesh, geometry, state, e, n) : hexAtNode(mesh, state, e, n);
      const Eigen::Matrix3d s = cauchyStress(material, point.F, point.pressure);
      const int node = mesh.elements(n, e);
      fields.cauchy_MPa.col(node) +=
          (Eigen::Matrix<double, 6, 1>() << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)).finished();
      fields.volumeRatio(node) += point.F.determinant();
      gradients.col(node) += point.F.reshaped();
      count(node) += 1;
    }
  }
  fields.cauchy_MPa.array().rowwise() /= count.transpose().array();
  fields.volumeRatio.array() /= count.array();
  fields.pressure_MPa = -fields.cauchy_MPa.topRows<3>().colwise().sum().transpose() / 3;
  fields.vonMises_MPa.resize(nodes);
  fields.principalStretches.resize(3, nodes);
  for (int i = 0; i < nodes; ++i) {
    fields.vonMises_MPa(i) = vonMises(fields.cauchy_MPa.col(i));
    const Eigen::Matrix3d F = (gradients.col(i) / count(i)).reshaped(3, 3);
    // Eigenvalues of C = F^T F are their squares, smallest first.
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(F.transpose() * F, Eigen::EigenvaluesOnly);
    fields.principalStretches.col(i) = eigen.eigenvalues().cwiseMax(0).cwiseSqrt().reverse();
  }
  return fields;
}

} // namespace palp
