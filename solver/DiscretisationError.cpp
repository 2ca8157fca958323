#include "solver/HyperelasticProblem.h"

#include "solver/SensorMesh.h"

namespace palp {

namespace {

constexpr double coarserBy = 1.3;

/// Relative L2 difference of the upper electrodes' displacements.
double difference(const Eigen::Matrix3Xd& u, const Eigen::Matrix3Xd& other) {
  const double norm = u.norm();
  return norm > 0 ? (u - other).norm() / norm : 0;
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
  const Solution reference = other.solve(load, {}, {.step = {}, .stop = std::move(stop)});
  error.relative =
      difference(problem.electrodes(solution.state()).upper_mm, other.electrodes(reference.state()).upper_mm);
  return error;
}

} // namespace palp
