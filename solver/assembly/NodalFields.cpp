#include "solver/assembly/NodalFields.h"

#include "model/base/PositiveSolve.h"
#include "solver/element/ElementGeometry.h"
#include "solver/element/ElementKernels.h"
#include "solver/element/RubberStress.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <vector>

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

namespace {

/// The mean of what the hexahedra around a node have.
Eigen::VectorXd meanPressures(const Mesh& mesh, const LoadIncrement& state) {
  Eigen::VectorXd pressures = Eigen::VectorXd::Zero(mesh.nodeCount()), count = pressures;
  for (int e = 0; e < mesh.elementCount(); ++e)
    for (int n = 0; n < 8; ++n) {
      pressures(mesh.elements(n, e)) -= state.elementUnknowns(0, e);
      count(mesh.elements(n, e)) += 1;
    }
  return pressures.cwiseQuotient(count);
}

/// A quadratic function of the place around a corner, by weighted least squares.
class QuadraticFit {
public:
  /// In units of how far the points lie from the corner along each axis, as elements are flat.
  void widen(const Eigen::Vector3d& from, double weight) {
    squares_ += weight * from.cwiseAbs2();
    weights_ += weight;
  }
  void add(const Eigen::Vector3d& from, double weight, double value) {
    const Basis b = basis(from);
    normal_ += weight / weights_ * b * b.transpose();
    fit_ += weight / weights_ * value * b;
  }
  /// A little stiff in its quadratic part, so that few elements, as at the block's edges, determine it.
  void solve() {
    constexpr double stiffness = 0.01;
    normal_.diagonal().tail<6>().array() += stiffness;
    if (const auto factor = semidefiniteFactor(normal_))
      fit_ = factor->solve(fit_).eval();
    else
      fit_.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  [[nodiscard]] double at(const Eigen::Vector3d& from) const { return fit_.dot(basis(from)); }

private:
  using Basis = Eigen::Matrix<double, 10, 1>;
  [[nodiscard]] Basis basis(const Eigen::Vector3d& from) const {
    const Eigen::Vector3d d = from.cwiseQuotient((squares_ / weights_).cwiseSqrt());
    return {1, d(0), d(1), d(2), d(0) * d(0), d(1) * d(1), d(2) * d(2), d(0) * d(1), d(1) * d(2), d(2) * d(0)};
  }

  Eigen::Vector3d squares_ = Eigen::Vector3d::Zero();
  double weights_ = 0;
  Eigen::Matrix<double, 10, 10> normal_ = Eigen::Matrix<double, 10, 10>::Zero();
  Basis fit_ = Basis::Zero();
};

/// The quadratic function that is nearest to the pressure in the tetrahedra around a corner (least squares over their
/// volume), and in the middle of an edge the mean of its two ends' functions.
Eigen::VectorXd fittedPressures(const Mesh& mesh, const LoadIncrement& state) {
  std::vector<QuadraticFit> fits(static_cast<std::size_t>(mesh.nodeCount())); // of corners
  const auto fit = [&](int node) -> QuadraticFit& { return fits[static_cast<std::size_t>(node)]; };
  // `use(corner, place from it, volume, pressure)` for four points per element, exact to degree 2.
  const auto forPoints = [&](const auto& use) {
    constexpr double far = 0.58541019662497, near = 0.13819660112501;
    for (int e = 0; e < mesh.elementCount(); ++e) {
      const auto corners = mesh.elements.col(e).head<4>();
      const Eigen::Matrix<double, 3, 4> places = mesh.nodes_mm(Eigen::all, corners);
      const double volume = tetGeometry(mesh, e).volume / 4;
      for (int q = 0; q < 4; ++q) {
        Eigen::Vector4d l = Eigen::Vector4d::Constant(near);
        l(q) = far;
        const double pressure = -state.elementUnknowns.col(e).tail<4>().dot(l);
        for (int k = 0; k < 4; ++k) use(fit(corners(k)), places * l - places.col(k), volume, pressure);
      }
    }
  };
  forPoints([](QuadraticFit& at, const Eigen::Vector3d& from, double volume, double) { at.widen(from, volume); });
  forPoints([](QuadraticFit& at, const Eigen::Vector3d& from, double volume, double p) { at.add(from, volume, p); });
  std::vector<bool> solved(fits.size(), false);
  Eigen::VectorXd pressures(mesh.nodeCount());
  for (int e = 0; e < mesh.elementCount(); ++e)
    for (int k = 0; k < 4; ++k) {
      const int node = mesh.elements(k, e);
      if (solved[static_cast<std::size_t>(node)]) continue;
      solved[static_cast<std::size_t>(node)] = true;
      fit(node).solve();
      pressures(node) = fit(node).at(Eigen::Vector3d::Zero());
    }
  for (int e = 0; e < mesh.elementCount(); ++e)
    for (int edge = 0; edge < 6; ++edge) {
      const int a = mesh.elements(tetEdges[edge][0], e), b = mesh.elements(tetEdges[edge][1], e);
      const Eigen::Vector3d half = (mesh.nodes_mm.col(b) - mesh.nodes_mm.col(a)) / 2;
      pressures(mesh.elements(4 + edge, e)) = (fit(a).at(half) + fit(b).at(-half)) / 2;
    }
  return pressures;
}

} // namespace

Eigen::VectorXd nodalPressures_MPa(const Mesh& mesh, const LoadIncrement& state) {
  return mesh.shape == ElementShape::Tetrahedron10 ? fittedPressures(mesh, state) : meanPressures(mesh, state);
}

} // namespace palp
