#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <stop_token>
#include <string>

namespace palp {

/// The same problem as an input deck for CalculiX or Abaqus: C3D10 or C3D8, Mooney-Rivlin, clamped bottom, the load as
/// nodal forces (the same integrals as here), nonlinear geometry. Nodes and elements count from 1. Its elements have no
/// pressure unknown and lock where ours do not. Throws DesignError if the load cannot be applied, or for nu = 0.5.
std::string calculixDeck(const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                         const std::stop_token& stop = {});

} // namespace palp
