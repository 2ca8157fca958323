#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <string>

namespace palp {

/// The same problem as an input deck for CalculiX or Abaqus: nodes, elements (C3D10 or C3D8), Mooney-Rivlin rubber,
/// fixed bottom face, the load as nodal forces, one nonlinear static step. The node set UPPER holds the upper
/// electrodes where they are nodes; their displacements are printed. Units mm, N, MPa. Throws DesignError where the
/// load cannot act, and for nu = 0.5, which those programs' displacement elements cannot represent.
std::string calculixDeck(const SensorDesign& design, const Mesh& mesh, const LoadCase& load);

} // namespace palp
