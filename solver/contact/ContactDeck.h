#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <string>

namespace palp {

/// A number of a deck: CalculiX reads fields of up to 20 characters.
std::string deckNumber(double value);

/// A load's indenters for CalculiX. Each is a layer of wedges (C3D6) whose nodes all go with one node of their own,
/// REFERENCE1, REFERENCE2, ..., so that it is rigid and does not turn. Its lower faces are the master of the top faces
/// next to it (surface to surface, a stiff linear pressure, Coulomb friction).
struct ContactDeck {
  std::string model; ///< nodes, elements, surfaces, contact pairs: ends before the first step
  std::string steps; ///< all steps: down by depths, then forces where they are prescribed, then tangentially
};

/// `clamps` are the data lines of all boundary conditions of the block, `loads` those of the nodal forces of areas and
/// discs (may be empty), `output` the requests of a step.
ContactDeck contactDeck(const SensorDesign& design, const Mesh& mesh, const LoadCase& load, const std::string& clamps,
                        const std::string& loads, const std::string& output);

} // namespace palp
