#include "solver/HyperelasticProblem.h"

#include "model/DesignError.h"
#include "solver/assembly/NodalFields.h"
#include "solver/assembly/SurfaceTraction.h"
#include "solver/contact/ContactSolver.h"
#include "solver/contact/ContactSummary.h"
#include "solver/statics/NewtonSolver.h"
#include "solver/statics/ProblemParts.h"

#include <algorithm>
#include <cassert>

namespace palp {

Eigen::MatrixXd elementUnknowns(const Discretisation& mesh, const LaneVector& unknowns) {
  Eigen::MatrixXd x(mesh.unknowns(), mesh.elements());
  for (int e = 0; e < mesh.elements(); ++e)
    for (int k = 0; k < mesh.unknowns(); ++k) x(k, e) = unknowns[laneIndex(e, mesh.unknowns(), k)];
  return x;
}

HyperelasticProblem::Parts::Parts(SensorDesign d, Mesh m)
    : design(std::move(d)), mesh(std::move(m)),
      discretisation(std::make_shared<const Discretisation>(mesh, clampedBottom(mesh))),
      assembler(discretisation, rubberConstants(design.material)) {}

std::shared_ptr<const CholeskyPlan> HyperelasticProblem::Parts::plan() const {
  std::call_once(planOnce_, [this] { plan_ = std::make_shared<const CholeskyPlan>(assembler.pattern()); });
  return plan_;
}

std::shared_ptr<const InitialTangent> HyperelasticProblem::Parts::initialTangent(int threads,
                                                                                 const std::stop_token& stop) const {
  {
    std::unique_lock lock(tangentGuard_);
    if (!made_.wait(lock, stop, [this] { return tangent_ || !making_; })) return {};
    if (tangent_) return tangent_;
    making_ = true;
  }
  const Making making{*this};
  const std::shared_ptr<const InitialTangent> tangent = makeTangent(plan(), threads, stop);
  keepInitialTangent(tangent);
  return tangent;
}

void HyperelasticProblem::Parts::keepInitialTangent(std::shared_ptr<const InitialTangent> tangent) const {
  const std::lock_guard lock(tangentGuard_);
  tangent_ = std::move(tangent);
}

HyperelasticProblem::Parts::Making::~Making() {
  {
    const std::lock_guard lock(parts.tangentGuard_);
    parts.making_ = false;
  }
  parts.made_.notify_all();
}

std::shared_ptr<InitialTangent> HyperelasticProblem::Parts::makeTangent(std::shared_ptr<const CholeskyPlan> plan,
                                                                        int threads, const std::stop_token& stop,
                                                                        Products products) const {
  if (stop.stop_requested()) return {};
  auto rest = std::make_shared<InitialTangent>(InitialTangent{{}, {}, SparseCholesky(std::move(plan))});
  assembler.tangent(discretisation->atRest(), rest->tangents, rest->forces, threads, stop);
  if (stop.stop_requested()) return {};
  LaneVector matrix = assembler.matrix(rest->tangents, threads);
  rest->tangents.stiffness = {};
  const auto outcome = rest->factor.factorise(std::move(matrix), threads, stop, products);
  if (outcome == SparseCholesky::Outcome::Stopped) return {};
  if (outcome == SparseCholesky::Outcome::NotPositiveDefinite)
    throw DesignError(
        "the block at rest is not stable on this mesh (its tangent is not positive definite); expected a material "
        "with c10_MPa + c01_MPa above 0 and a mesh without crushed elements");
  return rest;
}

void HyperelasticProblem::Parts::releaseInitialTangent() const {
  std::shared_ptr<const InitialTangent> last; // freed after the lock, which takes a while
  const std::lock_guard lock(tangentGuard_);
  last.swap(tangent_);
}

const PointProbe& HyperelasticProblem::Parts::upperProbe() const {
  std::call_once(upperOnce_, [this] { upperProbe_.emplace(mesh, design.upperElectrodes_mm()); });
  return *upperProbe_;
}

const PointProbe& HyperelasticProblem::Parts::lowerProbe() const {
  std::call_once(lowerOnce_, [this] { lowerProbe_.emplace(mesh, design.lowerElectrodes_mm()); });
  return *lowerProbe_;
}

HyperelasticProblem::HyperelasticProblem(SensorDesign design, Mesh mesh)
    : parts_(std::make_shared<const Parts>(std::move(design), std::move(mesh))), design_(parts_, &parts_->design) {}

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
  return parts_->mesh;
}
int HyperelasticProblem::dof() const {
  return parts_->discretisation->dof();
}
std::string HyperelasticProblem::elementType() const {
  return parts_->mesh.shape == ElementShape::Tetrahedron10 ? "P2+bubble/P1d" : "Q1/P0";
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

Solution contactSolution(const HyperelasticProblem::Parts& parts, const LoadCase& load, ContactResult& result) {
  const Discretisation& mesh = *parts.discretisation;
  Solution solution = withoutIncrements(mesh, result.newton);
  for (const auto& [equilibrium, contact] : result.increments) {
    LoadIncrement next = increment(mesh, equilibrium);
    Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(result.points.size()));
    for (std::size_t p = 0; p < result.points.size(); ++p)
      positions.col(static_cast<Eigen::Index>(p)) =
          parts.mesh.nodes_mm.col(result.points[p].node) + next.displacements_mm.col(result.points[p].node);
    next.indenters = indenterStates(load, parts.mesh, result.points, contact, positions);
    next.contactTraction_MPa = contactTractions_MPa(parts.mesh, result.points, contact);
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
      ContactSolver(parts_->assembler, parts_->mesh, parts_->design, path, options, observer).solve();
  std::vector<Solution> solutions;
  for (std::size_t k = 0; k < results.size(); ++k) solutions.push_back(contactSolution(*parts_, path[k], results[k]));
  return solutions;
}

Solution HyperelasticProblem::solve(const LoadCase& load, const NewtonOptions& options,
                                    const NewtonObserver& observer) const {
  if (!load.indenters.empty()) return std::move(solvePath({load}, options, observer).back());
  const Discretisation& mesh = *parts_->discretisation;
  Loading loading{nodalForces(parts_->mesh, parts_->design, load),
                  Eigen::VectorXd::Zero(3 * Eigen::Index(mesh.nodes()))};
  // The problem's hold on it ends with the loan where Newton is to work with one tangent at a time.
  const auto borrow = [&] {
    auto rest = parts_->initialTangent(options.threads, observer.stop);
    if (options.oneTangent) parts_->releaseInitialTangent();
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
  SparseCholesky cholesky(parts_->plan());
  NewtonSolver solver(parts_->assembler, cholesky, options, observer);
  solver.startingWith({std::move(rest), options.oneTangent ? LentTangent::Find(borrow) : LentTangent::Find()});
  NewtonResult result = solver.solve(loading);
  if (auto still = borrowed.lock()) parts_->keepInitialTangent(std::move(still));
  Solution solution = withoutIncrements(mesh, result);
  for (const EquilibriumState& equilibrium : result.increments)
    solution.increments.push_back(increment(mesh, equilibrium));
  solution.reachedLoadFraction = solution.state().loadFraction;
  return solution;
}

void HyperelasticProblem::findOrdering() const {
  (void)parts_->plan();
}

std::size_t HyperelasticProblem::findFactor(int threads, const std::stop_token& stop) const {
  const auto rest = parts_->initialTangent(threads, stop);
  return rest ? rest->factor.bytes() : 0;
}

void HyperelasticProblem::releaseFactor() const {
  parts_->releaseInitialTangent();
}

ElectrodeDisplacements HyperelasticProblem::electrodes(const LoadIncrement& state) const {
  return {parts_->upperProbe().displacements_mm(state), parts_->lowerProbe().displacements_mm(state),
          parts_->upperProbe().pressures_MPa(state)};
}

NodalFields HyperelasticProblem::fields(const LoadIncrement& state) const {
  NodalFields fields = nodalFields(parts_->mesh, parts_->design.material, state);
  fields.contactTraction_MPa = state.contactTraction_MPa;
  return fields;
}

} // namespace palp
