#pragma once

#include "app/cli/Cli.h"
#include "solver/SensorMesh.h"

#include <string>

namespace palp {

/// Where a load on that mesh takes long or much memory, prints this on standard error before it is made, and among the
/// warnings. `which` comes before the sentence, as "design 3: ".
void printMeshCost(const SensorDesign& design, const MeshOptions& options, Session& session,
                   const std::string& which = {});

} // namespace palp
