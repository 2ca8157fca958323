#include "solver/statics/LinearisedBlock.h"

#include "model/DesignError.h"

namespace palp {

Eigen::MatrixXd elementUnknowns(const Discretisation& mesh, const LaneVector& unknowns) {
  Eigen::MatrixXd x(mesh.unknowns(), mesh.elements());
  for (int e = 0; e < mesh.elements(); ++e)
    for (int k = 0; k < mesh.unknowns(); ++k) x(k, e) = unknowns[laneIndex(e, mesh.unknowns(), k)];
  return x;
}

LinearisedBlock::LinearisedBlock(SensorDesign d, Mesh m)
    : design(std::move(d)), mesh(std::move(m)),
      discretisation(std::make_shared<const Discretisation>(mesh, clampedBottom(mesh))),
      assembler(discretisation, rubberConstants(design.material)) {}

std::shared_ptr<const CholeskyPlan> LinearisedBlock::plan() const {
  std::call_once(planOnce_, [this] { plan_ = std::make_shared<const CholeskyPlan>(assembler.pattern()); });
  return plan_;
}

std::shared_ptr<const InitialTangent> LinearisedBlock::initialTangent(int threads, const std::stop_token& stop) const {
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

void LinearisedBlock::keepInitialTangent(std::shared_ptr<const InitialTangent> tangent) const {
  const std::lock_guard lock(tangentGuard_);
  tangent_ = std::move(tangent);
}

LinearisedBlock::Making::~Making() {
  {
    const std::lock_guard lock(block.tangentGuard_);
    block.making_ = false;
  }
  block.made_.notify_all();
}

std::shared_ptr<InitialTangent> LinearisedBlock::makeTangent(std::shared_ptr<const CholeskyPlan> plan, int threads,
                                                             const std::stop_token& stop,
                                                             UpdatePrecision products) const {
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
        "with a shear modulus above 0 and a mesh without crushed elements");
  return rest;
}

void LinearisedBlock::releaseInitialTangent() const {
  std::shared_ptr<const InitialTangent> last; // freed after the lock, which takes a while
  const std::lock_guard lock(tangentGuard_);
  last.swap(tangent_);
}

const PointProbe& LinearisedBlock::upperProbe() const {
  std::call_once(upperOnce_, [this] { upperProbe_.emplace(mesh, design.upperElectrodes_mm()); });
  return *upperProbe_;
}

const PointProbe& LinearisedBlock::lowerProbe() const {
  std::call_once(lowerOnce_, [this] { lowerProbe_.emplace(mesh, design.lowerElectrodes_mm()); });
  return *lowerProbe_;
}

} // namespace palp
