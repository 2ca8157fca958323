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

/// One load that needs the mesh of the complete path: of each indenter the largest force or depth, and both corners of
/// the rectangle that it is shifted in.
LoadCase pathEnvelope(const std::vector<LoadCase>& path);

/// The solutions of a path's loads as one: load k + 1 follows load k, so that load fractions go on above 1.
Solution joined(std::vector<Solution> steps);

/// Follows a path of loads on one mesh, which is made for the deepest of each indenter's steps and for all of its way.
/// Throws DesignError where design, mesh or path cannot be, and Cancelled where it is stopped while it meshes or finds
/// resistances under the law of the field.
TouchPath followPath(const SensorDesign& design, const std::vector<LoadCase>& path, const MeshOptions& mesh,
                     const NewtonOptions& options, const NewtonObserver& observer, StageLog& stages);

} // namespace palp
