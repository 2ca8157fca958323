#include "solver/HyperelasticProblem.h"

#include "model/DesignError.h"
#include "solver/assembly/NodalFields.h"
#include "solver/assembly/SurfaceTraction.h"
#include "solver/contact/ContactSolver.h"
#include "solver/contact/ContactSummary.h"
#include "solver/statics/LinearisedBlock.h"
#include "solver/statics/NewtonSolver.h"

#include <algorithm>
#include <cassert>

namespace palp {

HyperelasticProblem::HyperelasticProblem(SensorDesign design, Mesh mesh)
    : block_(std::make_shared<const LinearisedBlock>(std::move(design), std::move(mesh))),
      design_(block_, &block_->design) {}

bool sameButForLaw(const SensorDesign& a, const SensorDesign& b) {
  SensorDesign other = b;
  other.resistance = a.resistance;
  other.pressureLaw = a.pressureLaw;
  return a == other;
}

HyperelasticProblem HyperelasticProblem::withLawOf(const SensorDesign& design) const {
  assert(sameButForLaw(design, this->design()) && "another block is another problem");
  HyperelasticProblem other(*this);
  other.design_ = std::make_shared<const SensorDesign>(design);
  return other;
}

const Mesh& HyperelasticProblem::mesh() const {
  return block_->mesh;
}
int HyperelasticProblem::dof() const {
  return block_->discretisation->dof();
}
std::string HyperelasticProblem::elementType() const {
  return block_->mesh.shape == ElementShape::Tetrahedron10 ? "P2+bubble/P1d" : "Q1/P0";
}

namespace {

/// All of it but the increments.
Solution withoutIncrements(const Discretisation& mesh, NewtonResult& result) {
  Solution solution;
  solution.converged = result.converged;
  solution.cancelled = result.cancelled;
  solution.stopReason = std::move(result.stopReason);
  solution.newton = std::move(result.steps);
  for (Eigen::Index i = 0; i < result.internalForces.size(); ++i)
    if (mesh.freeIndex(static_cast<int>(i)) < 0) solution.reaction_N(i % 3) += result.internalForces(i);
  solution.maxVolumeError = std::max(result.largestJ - 1, 1 - result.smallestJ);
  return solution;
}

LoadIncrement increment(const Discretisation& mesh, const EquilibriumState& equilibrium) {
  return {equilibrium.loadFraction,
          Eigen::Map<const Eigen::Matrix3Xd>(equilibrium.state.displacements.data(), 3, mesh.nodes()),
          elementUnknowns(mesh, equilibrium.state.unknowns)};
}

Solution contactSolution(const LinearisedBlock& linearised, const LoadCase& load, ContactResult& result) {
  const Discretisation& mesh = *linearised.discretisation;
  Solution solution = withoutIncrements(mesh, result.newton);
  for (const auto& [equilibrium, contact] : result.increments) {
    LoadIncrement next = increment(mesh, equilibrium);
    Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(result.points.size()));
    for (std::size_t p = 0; p < result.points.size(); ++p)
      positions.col(static_cast<Eigen::Index>(p)) =
          linearised.mesh.nodes_mm.col(result.points[p].node) + next.displacements_mm.col(result.points[p].node);
    next.indenters = indenterStates(load, linearised.mesh, result.points, contact, positions);
    next.contactTraction_MPa = contactTractions_MPa(linearised.mesh, result.points, contact);
    solution.increments.push_back(std::move(next));
  }
  solution.reachedLoadFraction = solution.state().loadFraction;
  return solution;
}

} // namespace

std::vector<Solution> HyperelasticProblem::solvePath(const std::vector<LoadCase>& path, const NewtonOptions& options,
                                                     const NewtonObserver& observer) const {
  if (const auto wrong = whyInvalid(path, *design_)) throw DesignError(*wrong);
  std::vector<ContactResult> results =
      ContactSolver(block_->assembler, block_->mesh, block_->design, path, options, observer).solve();
  std::vector<Solution> solutions;
  for (std::size_t k = 0; k < results.size(); ++k) solutions.push_back(contactSolution(*block_, path[k], results[k]));
  return solutions;
}

Solution HyperelasticProblem::solve(const LoadCase& load, const NewtonOptions& options,
                                    const NewtonObserver& observer) const {
  if (!load.indenters.empty()) return std::move(solvePath({load}, options, observer).back());
  const Discretisation& mesh = *block_->discretisation;
  Loading loading{nodalForces(block_->mesh, block_->design, load),
                  Eigen::VectorXd::Zero(3 * Eigen::Index(mesh.nodes()))};
  // The problem's hold on it ends with the loan where Newton is to work with one tangent at a time.
  const auto borrow = [&] {
    auto rest = block_->initialTangent(options.threads, observer.stop);
    if (options.oneTangent) block_->releaseInitialTangent();
    return rest;
  };
  auto rest = borrow();
  const std::weak_ptr<const InitialTangent> borrowed = rest;
  if (!rest) {
    Solution solution;
    solution.cancelled = true;
    solution.stopReason = "cancelled at load fraction 0";
    solution.increments.push_back(
        {0, Eigen::Matrix3Xd::Zero(3, mesh.nodes()), Eigen::MatrixXd::Zero(mesh.unknowns(), mesh.elements())});
    return solution;
  }
  SparseCholesky cholesky(block_->plan());
  NewtonSolver solver(block_->assembler, cholesky, options, observer);
  solver.startingWith({std::move(rest), options.oneTangent ? LentTangent::Find(borrow) : LentTangent::Find()});
  NewtonResult result = solver.solve(loading);
  if (auto still = borrowed.lock()) block_->keepInitialTangent(std::move(still));
  Solution solution = withoutIncrements(mesh, result);
  for (const EquilibriumState& equilibrium : result.increments)
    solution.increments.push_back(increment(mesh, equilibrium));
  solution.reachedLoadFraction = solution.state().loadFraction;
  return solution;
}

void HyperelasticProblem::findOrdering() const {
  (void)block_->plan();
}

std::size_t HyperelasticProblem::findFactor(int threads, const std::stop_token& stop) const {
  const auto rest = block_->initialTangent(threads, stop);
  return rest ? rest->factor.bytes() : 0;
}

void HyperelasticProblem::releaseFactor() const {
  block_->releaseInitialTangent();
}

ElectrodeDisplacements HyperelasticProblem::electrodes(const LoadIncrement& state) const {
  return {block_->upperProbe().displacements_mm(state), block_->lowerProbe().displacements_mm(state),
          block_->upperProbe().pressures_MPa(state)};
}

NodalFields HyperelasticProblem::fields(const LoadIncrement& state) const {
  NodalFields fields = nodalFields(block_->mesh, block_->design.material, state);
  fields.contactTraction_MPa = state.contactTraction_MPa;
  return fields;
}

} // namespace palp
