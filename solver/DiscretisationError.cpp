#include "solver/DiscretisationError.h"

#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "solver/ConductionField.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double coarserBy = 1.3;  // the difference to such a mesh lies near the finer one's error
constexpr double errorOrder = 1.3; // of the error's fall with the size, between the singular edges' and the element's
/// Error over that difference, where the electrodes are not nodes of the coarser mesh: 0.3 to 1.05, mean 0.65, over
/// eight loads on meshes of 1, 1.25 and 1.5 times the default size against meshes twice as fine. On finer meshes it is
/// less, and the estimate too high: 2.2 to 2.9 times at 0.6 of the default size.
constexpr double errorOfDifference = 0.7;
/// The same for d ln R, whose estimate is never below that of the displacements, since the difference is small by
/// chance for some loads: with fixed electrodes, on the finer meshes of the field (finerForField), whose comparison
/// meshes are finer too, and under a pressure law, whose mesh is finer still. On 35 to 47 loads each, other layouts and
/// blocks among them, and four read-outs (resources/docs/numerics/mesh-error.md).
constexpr double errorOfResistanceDifference = 1.25;
constexpr double errorOfResistanceDifferenceOnFiner = 0.45;
constexpr double errorOfResistanceDifferenceByPressure = 0.6;
constexpr double smallestRefinement = 1.15;
constexpr double clearlyFewer = 0.65;        // 1.3^-3 is 0.46; grids have whole numbers of cells
constexpr double comparisonTolerance = 1e-4; // far below any difference between meshes
constexpr int mostCoarsenings = 4;
constexpr int mostRefinements = 8;
constexpr double mostDof = 250000; // what 24 GB hold with the factor

LoadCase scaled(LoadCase load, double fraction) {
  for (AreaLoad& area : load.areas) area.force_N *= fraction;
  for (PatchLoad& patch : load.patches) patch.force_N *= fraction;
  for (Indenter& indenter : load.indenters) indenter = indenter.at(fraction);
  return load;
}

/// Relative L2 difference of the upper electrodes' displacements; 0 where nothing moves.
double difference(const HyperelasticProblem& fine, const Solution& fineSolution, const HyperelasticProblem& coarse,
                  const Solution& coarseSolution) {
  const Eigen::Matrix3Xd u = fine.electrodes(fineSolution.state()).upper_mm;
  const double norm = u.norm();
  return norm > 0 ? (u - coarse.electrodes(coarseSolution.state()).upper_mm).norm() / norm : 0;
}

/// The problem on a mesh at least 1.3 times coarser, with clearly fewer unknowns; its electrodes are not nodes, which
/// would keep the mesh fine.
HyperelasticProblem coarserProblem(const HyperelasticProblem& problem, const LoadCase& load,
                                   const std::stop_token& stop) {
  double size = problem.mesh().size_mm;
  for (int attempt = 0;; ++attempt) {
    size *= coarserBy;
    const MeshOptions options =
        meshFor(problem.design(), load, {.meshSize_mm = size, .mapped = {}, .electrodesAsNodes = false});
    HyperelasticProblem coarser(problem.design(), sensorMesh(problem.design(), options, stop));
    if (coarser.dof() < clearlyFewer * problem.dof() || attempt == mostCoarsenings) return coarser;
  }
}

/// Factor from the difference to the coarser problem, which may be coarser than by 1.3, to the error estimate.
double scaleOfDifference(const HyperelasticProblem& problem, const HyperelasticProblem& coarser) {
  const double ratio = std::cbrt(double(problem.dof()) / coarser.dof());
  return errorOfDifference * (std::pow(coarserBy, errorOrder) - 1) /
         (std::pow(std::max(ratio, coarserBy), errorOrder) - 1);
}

/// Relative difference of d ln R, rms over all readings; 0 where nothing changes.
double resistanceDifference(const SensorDesign& design, const Eigen::MatrixXd& resistances_ohm,
                            const HyperelasticProblem& other, const Solution& otherSolution, int threads,
                            const std::stop_token& stop) {
  const auto network = ConductionField(other).network(otherSolution.state(), threads, stop);
  if (!network) throw Cancelled();
  const Eigen::ArrayXXd rest = resistancesAtRest_ohm(design).array().log();
  const Eigen::ArrayXXd change = resistances_ohm.array().log() - rest;
  const Eigen::ArrayXXd others =
      NetworkReading(*network, design.field()->readout).resistances_ohm().array().log() - rest;
  const double norm = change.matrix().norm();
  return norm > 0 ? (change - others).matrix().norm() / norm : 0;
}

} // namespace

DiscretisationError discretisationError(const HyperelasticProblem& problem, const LoadCase& load,
                                        const Solution& solution, std::stop_token stop, int threads,
                                        const Eigen::MatrixXd* resistances_ohm) {
  const bool graded = problem.mesh().size_mm > 0;
  const HyperelasticProblem other =
      graded ? coarserProblem(problem, load, stop)
             : HyperelasticProblem(problem.design(),
                                   sensorMesh(problem.design(), meshFor(problem.design(), load, {}), stop));
  Solution reference;
  try {
    reference = other.solve(scaled(load, solution.state().loadFraction),
                            {.relativeTolerance = comparisonTolerance, .threads = threads}, {.step = {}, .stop = stop});
  } catch (const DesignError& error) { // a coarser mesh has no node under a small indenter
    return {{}, {}, "no estimate: on the other mesh " + std::string(error.what())};
  }
  throwIfStopped(stop);
  if (!reference.converged)
    return {{}, {}, "no estimate: the solve on the other mesh did not converge: " + reference.stopReason};
  const double scale = graded ? scaleOfDifference(problem, other) : 1;
  const double displacements = scale * difference(problem, solution, other, reference);
  const double ofResistances = finerForPressure(problem.design()) ? errorOfResistanceDifferenceByPressure
                               : finerForField(problem.design())  ? errorOfResistanceDifferenceOnFiner
                                                                  : errorOfResistanceDifference;
  std::optional<double> resistances;
  try {
    if (resistances_ohm && problem.design().field())
      resistances =
          std::max((graded ? scale * ofResistances / errorOfDifference : 1) *
                       resistanceDifference(problem.design(), *resistances_ohm, other, reference, threads, stop),
                   displacements);
  } catch (const DesignError& error) { // a coarser mesh bears less of a pressure law
    return {displacements, {}, "no estimate of resistances: on the other mesh " + std::string(error.what())};
  }
  return {displacements, resistances,
          !graded
              ? "difference to quadratic tetrahedra on the default mesh; their own error is not included"
              : std::string(
                    "from the difference to a mesh 1.3 times coarser; within a factor of 3 of the error wherever it "
                    "was checked") +
                    (!resistances ? ""
                     : problem.design().pressureLaw
                         ? ", that of d ln R up to 6 times too high under a steep pressure law"
                         : ", that of d ln R in 96 of 100 checks, otherwise mostly too high")};
}

Mesh meshForAccuracy(const SensorDesign& design, const LoadCase& load, double accuracy, std::stop_token stop,
                     int threads) {
  if (!(accuracy > 0 && accuracy < 1))
    throw DesignError("accuracy: " + gotExpected(accuracy, "", "a relative error between 0 and 1"));
  MeshOptions options = meshFor(design, load, {.meshSize_mm = 1.5 * standardMeshSize_mm(design), .mapped = {}});
  for (int refinement = 0;; ++refinement) {
    const HyperelasticProblem problem(design, sensorMesh(design, options, stop));
    if (problem.dof() > mostDof || refinement == mostRefinements)
      throw DesignError(
          "accuracy " + shortText(accuracy) + " needs too fine a mesh: " +
          gotExpected(std::to_string(problem.dof()) + " unknowns or more", "up to " + shortText(mostDof)));
    const Solution solution = problem.solve(load, {.threads = threads}, {.step = {}, .stop = stop});
    throwIfStopped(stop);
    if (!solution.converged) return problem.mesh();
    const auto error = discretisationError(problem, load, solution, stop, threads).relative;
    if (error && *error <= accuracy) return problem.mesh();
    // Without an estimate, as the coarser mesh could not carry the load, a finer mesh has a finer comparison mesh.
    const double finerBy = error ? std::pow(1.1 * *error / accuracy, 1 / errorOrder) : coarserBy;
    *options.meshSize_mm /= std::clamp(finerBy, smallestRefinement, 2.);
  }
}

} // namespace palp
