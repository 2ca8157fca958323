#pragma once

#include "solver/Assembler.h"
#include "solver/HyperelasticProblem.h"
#include "solver/PointProbe.h"
#include "solver/SparseCholesky.h"

namespace palp {

/// What a problem keeps, shared read-only with BatchSolver.
struct HyperelasticProblem::Parts {
  Parts(SensorDesign d, Mesh m);

  SensorDesign design;
  Mesh mesh;
  std::shared_ptr<const Discretisation> discretisation;
  Assembler assembler;
  PointProbe upperProbe;
  PointProbe lowerProbe;
};

/// The elements' own unknowns as in LoadIncrement (unknowns x elements), and back.
Eigen::MatrixXd elementUnknowns(const Discretisation& mesh, const LaneVector& unknowns);

} // namespace palp
