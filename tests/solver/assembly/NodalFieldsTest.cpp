#include "solver/assembly/NodalFields.h"

#include "tests/solver/TestBlocks.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

using namespace palp;
using namespace palp::test;

namespace {

/// The state of uniform deformation F with the pressure p (tension positive) everywhere.
LoadIncrement uniform(const Mesh& mesh, const Eigen::Matrix3d& F, double p) {
  const bool tets = mesh.shape == ElementShape::Tetrahedron10;
  LoadIncrement state{1, (F - Eigen::Matrix3d::Identity()) * mesh.nodes_mm,
                      Eigen::MatrixXd::Constant(tets ? 7 : 1, mesh.elementCount(), p)};
  if (tets) state.elementUnknowns.topRows<3>().setZero(); // no bubbles
  return state;
}

class Fields : public testing::TestWithParam<bool> {
protected:
  Mesh mesh_ = GetParam() ? cubeTets(2, 0.2) : cubeHexes(2, 0.2);
  MooneyRivlin m_;
  Material rubber_{m_};
  /// xx, yy, zz, xy, yz, xz at every node.
  void expectStress(const NodalFields& fields, const Eigen::Matrix<double, 6, 1>& stress) const {
    for (int n = 0; n < mesh_.nodeCount(); ++n)
      EXPECT_LT((fields.cauchy_MPa.col(n) - stress).norm(), 1e-12) << fields.cauchy_MPa.col(n).transpose();
  }
};
INSTANTIATE_TEST_SUITE_P(TetsAndHexes, Fields, testing::Bool());

TEST_P(Fields, OfIncompressibleUniaxialTensionAreTheClosedForm) {
  const double l = 1.4, stress = 2 * (l * l - 1 / l) * (m_.c10_MPa + m_.c01_MPa / l);
  const Eigen::Vector3d stretches(1 / std::sqrt(l), 1 / std::sqrt(l), l);
  // Only the isochoric part has a deviator: the pressure is the third of the trace, and the sides are free.
  const NodalFields f = nodalFields(mesh_, rubber_, uniform(mesh_, stretches.asDiagonal(), stress / 3));
  expectStress(f, (Eigen::Matrix<double, 6, 1>() << 0, 0, stress, 0, 0, 0).finished());
  for (int n = 0; n < mesh_.nodeCount(); ++n) {
    EXPECT_NEAR(f.vonMises_MPa(n), stress, 1e-12);
    EXPECT_NEAR(f.pressure_MPa(n), -stress / 3, 1e-12);
    EXPECT_NEAR(f.volumeRatio(n), 1, 1e-12);
    EXPECT_LT((f.principalStretches.col(n) - Eigen::Vector3d(l, 1 / std::sqrt(l), 1 / std::sqrt(l))).norm(), 1e-7)
        << "largest first; equal eigenvalues are found to the root of rounding";
    EXPECT_LT(
        (f.displacement_mm.col(n) - (stretches - Eigen::Vector3d::Ones()).cwiseProduct(mesh_.nodes_mm.col(n))).norm(),
        1e-12);
  }
}

TEST_P(Fields, OfSimpleShearAreRivlins) {
  // B = F F^T has Bxx = 1 + g^2, Bxz = g; sigma = -q + 2 c10 B - 2 c01 B^-1 with q so that its trace is the pressure's.
  const double g = 0.5;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = g;
  const Eigen::Matrix3d B = F * F.transpose(), s = 2 * m_.c10_MPa * B - 2 * m_.c01_MPa * B.inverse();
  const double p = 0.3, shift = p - s.trace() / 3;
  const NodalFields f = nodalFields(mesh_, rubber_, uniform(mesh_, F, p));
  expectStress(f, (Eigen::Matrix<double, 6, 1>() << s(0, 0) + shift, s(1, 1) + shift, s(2, 2) + shift, 0, 0,
                   2 * (m_.c10_MPa + m_.c01_MPa) * g)
                      .finished());
  EXPECT_NEAR(f.pressure_MPa(0), -p, 1e-12);
  // lambda - 1 / lambda = g in the plane of the shear.
  const double largest = g / 2 + std::sqrt(1 + g * g / 4);
  EXPECT_LT((f.principalStretches.col(0) - Eigen::Vector3d(largest, 1, 1 / largest)).norm(), 1e-9);
}

TEST_P(Fields, OfSwellingAreThePressureAlone) {
  const NodalFields f = nodalFields(mesh_, rubber_, uniform(mesh_, 1.1 * Eigen::Matrix3d::Identity(), 0.7));
  expectStress(f, (Eigen::Matrix<double, 6, 1>() << 0.7, 0.7, 0.7, 0, 0, 0).finished());
  EXPECT_NEAR(f.volumeRatio.minCoeff(), 1.1 * 1.1 * 1.1, 1e-12);
  EXPECT_LT(f.vonMises_MPa.maxCoeff(), 1e-7); // the root of a difference of squares
}

TEST(NodalPressures, OfTetrahedraThatAgreeOnALinearPressureAreThat) {
  const Mesh mesh = cubeTets(3, 0.2);
  const auto pressure = [](const Eigen::Vector3d& x) { return 0.3 - x.x() + 2 * x.y() + 0.5 * x.z(); };
  LoadIncrement state = uniform(mesh, Eigen::Matrix3d::Identity(), 0);
  for (int e = 0; e < mesh.elementCount(); ++e)
    for (int k = 0; k < 4; ++k) state.elementUnknowns(3 + k, e) = -pressure(mesh.nodes_mm.col(mesh.elements(k, e)));
  const Eigen::VectorXd found = nodalPressures_MPa(mesh, state);
  for (int n = 0; n < mesh.nodeCount(); ++n) EXPECT_NEAR(found(n), pressure(mesh.nodes_mm.col(n)), 1e-11);
}

TEST_P(Fields, HaveTheElementsPressureAtAllNodes) {
  const Eigen::VectorXd found = nodalPressures_MPa(mesh_, uniform(mesh_, Eigen::Matrix3d::Identity(), -0.02));
  EXPECT_LT((found.array() - 0.02).abs().maxCoeff(), 1e-13);
}

} // namespace
