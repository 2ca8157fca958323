#pragma once

#include "solver/SensorMesh.h"

#include <string>

namespace palp {

/// What a mesh will take for one load on it, from its grid, before it is made: time on two cores of 2020 or so, each
/// within a factor of two.
struct MeshCost {
  double elements = 0, memory_MB = 0, seconds = 0;
};
MeshCost meshCost(const SensorDesign& design, const MeshOptions& options = {});

/// A sentence with elements, memory and time where a load takes more than 20 s or 2 GB; else empty.
std::string costInWords(const MeshCost& cost);
/// The same in a few words that follow what is being done, as "Meshing"; else empty.
std::string costInBrief(const MeshCost& cost);

} // namespace palp
