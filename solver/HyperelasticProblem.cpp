#include "solver/HyperelasticProblem.h"

#include "solver/NewtonSolver.h"
#include "solver/NodalFields.h"
#include "solver/ProblemParts.h"
#include "solver/SurfaceTraction.h"

#include <algorithm>

namespace palp {

namespace {

RubberConstants rubberConstants(const Material& material) {
  return {material.c10_MPa, material.c01_MPa, material.compressibility_per_MPa()};
}

} // namespace

Eigen::MatrixXd elementUnknowns(const Discretisation& mesh, const LaneVector& unknowns) {
  Eigen::MatrixXd x(mesh.unknowns(), mesh.elements());
  for (int e = 0; e < mesh.elements(); ++e)
    for (int k = 0; k < mesh.unknowns(); ++k)
      x(k, e) = unknowns[(std::size_t(e / lanes) * mesh.unknowns() + k) * lanes + e % lanes];
  return x;
}

HyperelasticProblem::Parts::Parts(SensorDesign d, Mesh m)
    : design(std::move(d)), mesh(std::move(m)),
      discretisation(std::make_shared<const Discretisation>(mesh, clampedBottom(mesh))),
      assembler(discretisation, rubberConstants(design.material)), upperProbe(mesh, design.upperElectrodes_mm()),
      lowerProbe(mesh, design.lowerElectrodes_mm()) {}

HyperelasticProblem::HyperelasticProblem(SensorDesign design, Mesh mesh)
    : parts_(std::make_unique<Parts>(std::move(design), std::move(mesh))) {}
HyperelasticProblem::~HyperelasticProblem() = default;
HyperelasticProblem::HyperelasticProblem(HyperelasticProblem&&) noexcept = default;
HyperelasticProblem& HyperelasticProblem::operator=(HyperelasticProblem&&) noexcept = default;

const SensorDesign& HyperelasticProblem::design() const {
  return parts_->design;
}
const Mesh& HyperelasticProblem::mesh() const {
  return parts_->mesh;
}
int HyperelasticProblem::dof() const {
  return parts_->discretisation->dof();
}
std::string HyperelasticProblem::elementType() const {
  return parts_->mesh.shape == ElementShape::Tetrahedron10 ? "P2+bubble/P1d" : "Q1/P0";
}

Solution HyperelasticProblem::solve(const LoadCase& load, const NewtonOptions& options,
                                    const NewtonObserver& observer) const {
  const Discretisation& mesh = *parts_->discretisation;
  Loading loading{nodalForces(parts_->mesh, parts_->design, load),
                  Eigen::VectorXd::Zero(3 * Eigen::Index(mesh.nodes()))};
  SparseCholesky cholesky(parts_->assembler.pattern());
  NewtonResult result = NewtonSolver(parts_->assembler, cholesky, options, observer).solve(loading);
  Solution solution;
  solution.converged = result.converged;
  solution.cancelled = result.cancelled;
  solution.stopReason = std::move(result.stopReason);
  solution.newton = std::move(result.steps);
  solution.maxVolumeError = std::max(result.largestJ - 1, 1 - result.smallestJ);
  for (const auto& [fraction, state] : result.increments)
    solution.increments.push_back({fraction,
                                   Eigen::Map<const Eigen::Matrix3Xd>(state.displacements.data(), 3, mesh.nodes()),
                                   elementUnknowns(mesh, state.unknowns)});
  solution.reachedLoadFraction = solution.state().loadFraction;
  return solution;
}

ElectrodeDisplacements HyperelasticProblem::electrodes(const LoadIncrement& state) const {
  return {parts_->upperProbe.displacements_mm(state), parts_->lowerProbe.displacements_mm(state),
          parts_->upperProbe.pressures_MPa(state)};
}

NodalFields HyperelasticProblem::fields(const LoadIncrement& state) const {
  return nodalFields(parts_->mesh, parts_->design.material, state);
}

} // namespace palp
