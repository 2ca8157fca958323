#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <stop_token>
#include <string>

namespace palp {

/// The same problem as an input deck for CalculiX or Abaqus: C3D10 or C3D8, the law of the rubber, clamped bottom, the
/// load as nodal forces (the same integrals as here), nonlinear geometry. Nodes and elements count from 1. Its elements
/// have no pressure unknown and lock where ours do not. Throws DesignError if the load cannot be applied, for nu = 0.5,
/// or for Gent's law, which neither program has.
std::string calculixDeck(const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                         const std::stop_token& stop = {});

} // namespace palp
