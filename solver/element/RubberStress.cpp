#include "solver/element/RubberStress.h"

#include <Eigen/Dense>

#include <cmath>

namespace palp {

namespace {

struct Invariants {
  double J, I1, I2;
};
Invariants invariants(const Eigen::Matrix3d& F) {
  const Eigen::Matrix3d C = F.transpose() * F;
  const double I1 = C.trace();
  return {F.determinant(), I1, (I1 * I1 - C.squaredNorm()) / 2};
}

/// By the derivatives of the invariants.
Eigen::Matrix3d stressOf(const MooneyRivlin& law, const Eigen::Matrix3d& F, double pressure_MPa) {
  const auto [J, I1, I2] = invariants(F);
  const double j1 = std::pow(J, -2. / 3), j2 = j1 * j1;
  const Eigen::Matrix3d cofactor = J * F.inverse().transpose();
  const Eigen::Matrix3d E = I1 * F - F * (F.transpose() * F);
  const double g = 2. / 3 * law.c10_MPa * j1 * I1 + 4. / 3 * law.c01_MPa * j2 * I2;
  return 2 * law.c10_MPa * j1 * F + 2 * law.c01_MPa * j2 * E + (pressure_MPa - g / J) * cofactor;
}

/// Squared principal stretches and directions: of B = F F^T.
Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(const Eigen::Matrix3d& F) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(F * F.transpose());
}

Eigen::Vector3d isochoricStretches(const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>& of, double J) {
  return of.eigenvalues().cwiseMax(0).cwiseSqrt() * std::cbrt(1 / J);
}

/// By principal stretches: P = (dev(sum_a (l_a dW/dl_a) n_a (x) n_a) / J + p) cof F.
Eigen::Matrix3d stressByStretches(const RubberLaw& law, const Eigen::Matrix3d& F, double pressure_MPa) {
  const double J = F.determinant();
  const auto axes = principal(F);
  Eigen::Vector3d stresses = principalStresses_MPa(law, isochoricStretches(axes, J));
  stresses.array() += pressure_MPa * J - stresses.mean();
  return axes.eigenvectors() * stresses.asDiagonal() * axes.eigenvectors().transpose() * F.inverse().transpose();
}

} // namespace

double isochoricEnergy(const Material& material, const Eigen::Matrix3d& F) {
  return energy_MPa(material.law, isochoricStretches(principal(F), F.determinant()));
}

Eigen::Matrix3d firstPiolaStress(const Material& material, const Eigen::Matrix3d& F, double pressure_MPa) {
  if (const auto* law = std::get_if<MooneyRivlin>(&material.law)) return stressOf(*law, F, pressure_MPa);
  return stressByStretches(material.law, F, pressure_MPa);
}

Eigen::Matrix3d cauchyStress(const Material& material, const Eigen::Matrix3d& F, double pressure_MPa) {
  return firstPiolaStress(material, F, pressure_MPa) * F.transpose() / F.determinant();
}

} // namespace palp
