#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"
#include "solver/HyperelasticProblem.h"

#include <optional>
#include <stop_token>
#include <string>

namespace palp {

/// Estimate of the discretisation error of the upper electrodes' displacements, relative L2, and how it was found. On
/// meshes graded by us it is the difference to the same load's solution on a mesh 1.3 times coarser, times a measured
/// factor; on others the difference to the default mesh.
struct DiscretisationError {
  std::optional<double> relative; ///< none where the solve on the other mesh did not converge; `method` says so
  std::string method;
};
/// Of the last converged state of the solution. Throws Cancelled.
DiscretisationError discretisationError(const HyperelasticProblem& problem, const LoadCase& load,
                                        const Solution& solution, std::stop_token stop = {}, int threads = 0);

/// Mesh whose discretisation error under the load, as estimated above, is at most `accuracy`: starts at 1.5 times the
/// default size and refines by what the estimate asks for, again and again. Where the load has no solution: the mesh
/// reached so far. Throws DesignError where the accuracy is out of reach, and Cancelled.
Mesh meshForAccuracy(const SensorDesign& design, const LoadCase& load, double accuracy, std::stop_token stop = {},
                     int threads = 0);

} // namespace palp
