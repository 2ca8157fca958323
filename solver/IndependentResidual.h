#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"
#include "model/Solution.h"

namespace palp {

/// Imbalance of a state of a mapped mesh, computed independently of the solver's kernels from the stress formula at the
/// Gauss points: the larger of |internal - external| / |external| over the free nodes and the largest
/// |mean(J) - 1 - p/kappa| over the elements. A wrong answer cannot pass it unnoticed.
double independentResidual(const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                           const Solution& solution);

} // namespace palp
