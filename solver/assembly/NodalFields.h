#pragma once

#include "model/Material.h"
#include "model/Mesh.h"
#include "model/Solution.h"

namespace palp {

/// Fields of a state at the nodes, averaged over the elements around each node.
NodalFields nodalFields(const Mesh& mesh, const Material& material, const LoadIncrement& state);

} // namespace palp
