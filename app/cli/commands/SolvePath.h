#pragma once

#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "solver/HyperelasticProblem.h"

#include <vector>

namespace palp {

/// `palp solve --loads`: a row of the result for each step of the path, the last one's fields into the file.
Exit solvePath(const SensorDesign& design, const std::vector<LoadCase>& path, const MeshOptions& mesh,
               const NewtonOptions& options, const NewtonObserver& observer, const OutputFile& output,
               Session& session);

/// Warnings of indenters that touch too few nodes for an accurate depth.
void warnWhereFewNodesTouch(const LoadCase& load, const std::vector<IndenterState>& indenters, Session& session);

} // namespace palp
