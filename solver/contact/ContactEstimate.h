#pragma once

#include "model/LoadCase.h"
#include "solver/SensorMesh.h"

#include <vector>

namespace palp {

/// Estimate by linear elasticity for an indenter that presses straight down on a wide layer with a fixed bottom.
struct ContactEstimate {
  double depth_mm = 0;
  Eigen::Vector2d half_mm = Eigen::Vector2d::Zero(); ///< half of the contact's extent along x and y
};

/// For an incompressible layer without friction: sphere, pin and punch by the integral equation of Hayes, Keer,
/// Herrmann and Mockros (1972), cylinders by its counterpart in plane strain, a plane by the bonded block's stiffness.
/// It is the initial guess of a solve and sizes its mesh; the result does not depend on it.
ContactEstimate contactEstimate(const Indenter& indenter, const SensorDesign& design);

/// Zones and element sizes that indenters need of the mesh.
std::vector<FineZone> fineZones(const SensorDesign& design, const LoadCase& load);

} // namespace palp
