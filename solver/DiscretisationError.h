#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"
#include "solver/HyperelasticProblem.h"

#include <optional>
#include <stop_token>
#include <string>

namespace palp {

/// Estimate of the discretisation error in the displacements of the upper electrodes: relative, over all electrodes
/// (L2). On graded meshes it is the difference from the solution on a mesh 1.3 times coarser, times a measured factor;
/// on others the difference from the default mesh. Limits: within a factor of 3 of the error for every design and load
/// that was checked (resources/docs/numerics/mesh-error.md); rather too high on meshes finer than the default; for a
/// mapped mesh finer than the default it is the default mesh's error. The error of the rubber's law is not included.
struct DiscretisationError {
  std::optional<double> relative; ///< none where the solve on the other mesh did not converge
  /// The same of d ln R over all readings under the law of the field, where the resistances were given: within a factor
  /// of 3 in 96 of 100 checks, else most often too high, under a pressure law that varies k by 50 times and more up to
  /// 6 times.
  std::optional<double> resistances{};
  std::string method; ///< how it was found and how far it can be trusted, or why there is none
};
/// Estimates the error of the last converged state of the solution, and of its resistances [ohm] where they are given
/// and the design has the law of the field. Throws Cancelled.
DiscretisationError discretisationError(const HyperelasticProblem& problem, const LoadCase& load,
                                        const Solution& solution, std::stop_token stop = {}, int threads = 0,
                                        const Eigen::MatrixXd* resistances_ohm = nullptr);

/// A mesh whose discretisation error under the load, as estimated above, is at most `accuracy`. Begins with 1.5 times
/// the default size and refines by what the estimate asks for, until it is met. Where the load has no solution: the
/// mesh reached so far. Throws DesignError where the accuracy is out of reach, and Cancelled.
Mesh meshForAccuracy(const SensorDesign& design, const LoadCase& load, double accuracy, std::stop_token stop = {},
                     int threads = 0);

} // namespace palp
