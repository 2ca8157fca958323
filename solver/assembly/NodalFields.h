#pragma once

#include "model/Material.h"
#include "model/Mesh.h"
#include "model/Solution.h"

namespace palp {

/// Fields of a state at the nodes, averaged over the elements around each node.
NodalFields nodalFields(const Mesh& mesh, const Material& material, const LoadIncrement& state);
/// Pressure at the nodes [MPa], compression positive, from that of the elements, which jumps: in tetrahedra a
/// quadratic fit around each corner; in hexahedra the mean.
Eigen::VectorXd nodalPressures_MPa(const Mesh& mesh, const LoadIncrement& state);

} // namespace palp
