#pragma once

#include "solver/PointProbe.h"
#include "solver/statics/LinearisedBlock.h"

namespace palp {

/// How the displacement of a point follows those of the nodes of its element, to first order at rest: 3 x 3 nodes, x,
/// y, z of the first node first. The bubble is among them: the elements' own unknowns follow their nodes by x = -W u.
Eigen::Matrix3Xd pointMotion(const PointProbe::Host& host, const Discretisation& mesh, const InitialTangent& rest);

} // namespace palp
