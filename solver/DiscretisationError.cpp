#include "solver/DiscretisationError.h"

#include "model/Error.h"
#include "model/Text.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double coarserBy = 1.3; // the plain difference to such a mesh lies near the finer one's error
constexpr double order = 1.3;     // of the error's fall with the size, between the singular edges' and the element's
constexpr int mostRefinements = 6;
constexpr double mostDof = 250000; // what 24 GB hold with the factor

LoadCase scaled(LoadCase load, double fraction) {
  for (AreaLoad& area : load.areas) area.force_N *= fraction;
  for (PatchLoad& patch : load.patches) patch.force_N *= fraction;
  return load;
}

/// Relative L2 difference of the upper electrodes' displacements; 0 where nothing moves.
double difference(const HyperelasticProblem& fine, const Solution& fineSolution, const HyperelasticProblem& coarse,
                  const Solution& coarseSolution) {
  const Eigen::Matrix3Xd u = fine.electrodes(fineSolution.state()).upper_mm;
  const double norm = u.norm();
  return norm > 0 ? (u - coarse.electrodes(coarseSolution.state()).upper_mm).norm() / norm : 0;
}

} // namespace

DiscretisationError discretisationError(const HyperelasticProblem& problem, const LoadCase& load,
                                        const Solution& solution, std::stop_token stop) {
  MeshOptions options;
  DiscretisationError error;
  if (problem.mesh().size_mm > 0) {
    options.meshSize_mm = coarserBy * problem.mesh().size_mm;
    error.method = "difference to a mesh 1.3 times coarser";
  } else {
    error.method = "difference to quadratic tetrahedra on the default mesh";
  }
  const HyperelasticProblem other(problem.design(), sensorMesh(problem.design(), options));
  const Solution reference =
      other.solve(scaled(load, solution.state().loadFraction), {}, {.step = {}, .stop = std::move(stop)});
  error.relative = difference(problem, solution, other, reference);
  return error;
}

Mesh meshForAccuracy(const SensorDesign& design, const LoadCase& load, double accuracy, std::stop_token stop) {
  if (!(accuracy > 0 && accuracy < 1))
    throw DesignError("accuracy " + text(accuracy) + "; allowed is a relative error between 0 and 1");
  double size = sensorMesh(design).size_mm * 1.5;
  std::unique_ptr<HyperelasticProblem> coarse;
  Solution coarseSolution;
  for (int refinement = 0;; ++refinement) {
    auto fine = std::make_unique<HyperelasticProblem>(design, sensorMesh(design, {.meshSize_mm = size, .mapped = {}}));
    if (fine->dof() > mostDof || refinement == mostRefinements)
      throw DesignError("accuracy " + text(accuracy) + " needs a mesh of " + std::to_string(fine->dof()) +
                        " unknowns or more; allowed are " + text(mostDof) + ": choose a larger accuracy");
    Solution solution = fine->solve(load, {}, {.step = {}, .stop = stop});
    if (stop.stop_requested() || !solution.converged) return fine->mesh();
    if (coarse) {
      const double error = difference(*fine, solution, *coarse, coarseSolution);
      if (error <= accuracy) return fine->mesh();
      // The estimate of the next mesh is to end the search, but no step is finer than half.
      size /= std::clamp(std::pow(1.1 * error / accuracy, 1 / order), coarserBy, 2.);
    } else {
      size /= coarserBy;
    }
    coarse = std::move(fine);
    coarseSolution = std::move(solution);
  }
}

} // namespace palp
