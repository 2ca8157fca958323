#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"
#include "solver/HyperelasticProblem.h"

#include <stop_token>
#include <string>

namespace palp {

/// Estimate of the discretisation error of the upper electrodes' displacements, relative L2, and how it was found.
struct DiscretisationError {
  double relative = 0;
  std::string method;
};
DiscretisationError discretisationError(const HyperelasticProblem& problem, const LoadCase& load,
                                        const Solution& solution, std::stop_token stop = {}, int threads = 0);

/// Mesh whose discretisation error under the load (relative L2 of the upper electrodes' displacements) is estimated to
/// be at most `accuracy`: meshes and solves until two successive meshes differ by no more. Stopped, or where the load
/// has no solution: the mesh reached so far. Throws DesignError where the accuracy is out of reach.
Mesh meshForAccuracy(const SensorDesign& design, const LoadCase& load, double accuracy, std::stop_token stop = {},
                     int threads = 0);

} // namespace palp
