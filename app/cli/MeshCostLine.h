#pragma once

#include "app/cli/Cli.h"
#include "solver/SensorMesh.h"

namespace palp {

/// Where a load on that mesh takes long or much memory, prints this on standard error before it is made, and among the
/// warnings.
void sayMeshCost(const SensorDesign& design, const MeshOptions& options, Session& session);

} // namespace palp
