#pragma once

#include "app/study/StageLog.h"
#include "model/LoadCase.h"
#include "model/SensorDesign.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <vector>

namespace palp {

/// One step of a path of indenters: where it ended and what the sensor reads there.
struct PathStep {
  Solution solution;
  ElectrodeDisplacements displacements;
  Eigen::MatrixXd resistances_ohm; ///< row-wires x column-wires
};

struct TouchPath {
  HyperelasticProblem problem;
  std::vector<PathStep> steps; ///< up to the first that is not reached
};

/// Follows a path of loads on one mesh, which is made for the deepest of each indenter's steps and for all of its way.
/// Throws DesignError where design, mesh or path cannot be, and Cancelled where it is stopped while it meshes or finds
/// resistances under the law of the field.
TouchPath followPath(const SensorDesign& design, const std::vector<LoadCase>& path, const MeshOptions& mesh,
                     const NewtonOptions& options, const NewtonObserver& observer, StageLog& stages);

} // namespace palp
