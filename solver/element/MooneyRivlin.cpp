#include "solver/element/MooneyRivlin.h"

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

} // namespace

double isochoricEnergy(const Material& material, const Eigen::Matrix3d& F) {
  const auto [J, I1, I2] = invariants(F);
  return material.c10_MPa * (std::pow(J, -2. / 3) * I1 - 3) + material.c01_MPa * (std::pow(J, -4. / 3) * I2 - 3);
}

Eigen::Matrix3d firstPiolaStress(const Material& material, const Eigen::Matrix3d& F, double pressure_MPa) {
  const auto [J, I1, I2] = invariants(F);
  const double j1 = std::pow(J, -2. / 3), j2 = j1 * j1;
  const Eigen::Matrix3d cofactor = J * F.inverse().transpose();
  const Eigen::Matrix3d E = I1 * F - F * (F.transpose() * F);
  const double g = 2. / 3 * material.c10_MPa * j1 * I1 + 4. / 3 * material.c01_MPa * j2 * I2;
  return 2 * material.c10_MPa * j1 * F + 2 * material.c01_MPa * j2 * E + (pressure_MPa - g / J) * cofactor;
}

Eigen::Matrix3d cauchyStress(const Material& material, const Eigen::Matrix3d& F, double pressure_MPa) {
  return firstPiolaStress(material, F, pressure_MPa) * F.transpose() / F.determinant();
}

} // namespace palp
