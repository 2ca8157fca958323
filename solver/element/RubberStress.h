#pragma once

#include "model/Material.h"

#include <Eigen/Core>

namespace palp {

// Stresses of every law in double precision, independent of the element kernels: for fields at the nodes and for
// checks.

/// Isochoric part of the energy [MPa] at the deformation gradient F.
double isochoricEnergy(const Material& material, const Eigen::Matrix3d& F);

/// First Piola-Kirchhoff stress [MPa] with the pressure (tension positive) as an unknown of its own.
Eigen::Matrix3d firstPiolaStress(const Material& material, const Eigen::Matrix3d& F, double pressure_MPa);

/// Cauchy stress sigma = P F^T / J [MPa].
Eigen::Matrix3d cauchyStress(const Material& material, const Eigen::Matrix3d& F, double pressure_MPa);

} // namespace palp
