#pragma once

#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <Eigen/Core>

namespace palp {

/// The load area in which the centre of each top face lies.
Eigen::VectorXi areasOfTopFaces(const SensorDesign& design, const Mesh& mesh);

} // namespace palp
