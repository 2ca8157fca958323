#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"
#include "model/Solution.h"

namespace palp {

/// Imbalance of a state of a mapped mesh, found anew from the stress formula at the Gauss points and not by the
/// solver's kernels: largest of |internal - external| over the free nodes / |external|, and of the volume equation
/// mean(J) - 1 - p/kappa over the elements. What a silent wrong answer cannot pass.
double independentResidual(const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                           const Solution& solution);

} // namespace palp
