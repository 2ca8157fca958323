#include "solver/contact/NormalContact.h"

#include "model/base/PositiveSolve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr int mostContactSteps = 60;
// Lengths are shares of the block's height.
constexpr double nearGap = 0.3;            // nodes farther than this from an indenter do not reach it within a solve
constexpr double depthStepsOfHeight = 50;  // the largest
constexpr double convergedForce = 1e-9;    // change of the forces in a step, relative to their sum
constexpr double convergedOfHeight = 5e10; // depths in it

} // namespace

NormalContact::NormalContact(std::vector<Indenter> indenters, std::shared_ptr<const TopCompliance> top)
    : indenters_(std::move(indenters)), top_(std::move(top)), height_mm_(top_->places_mm().row(2).maxCoeff()) {
  for (const Indenter& indenter : indenters_) {
    tips_mm_.emplace_back(indenter.place_mm.x(), indenter.place_mm.y(), height_mm_);
    if (const Motion* motion = indenter.motion())
      tips_mm_.back() += Eigen::Vector3d(motion->shift_mm.x(), motion->shift_mm.y(), -motion->depth_mm);
  }
}

NormalContact::Nearest NormalContact::nearest(const Eigen::Vector3d& place_mm) const {
  Nearest found{0, std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero()};
  for (std::size_t k = 0; k < indenters_.size(); ++k) {
    const IndenterDistance at = distance(indenters_[k], place_mm - tips_mm_[k]);
    if (at.gap_mm < found.gap_mm) found = {k, at.gap_mm, at.normal};
  }
  return found;
}

Eigen::Vector3d NormalContact::motionByForces(int node) const {
  Eigen::Vector3d motion_mm = Eigen::Vector3d::Zero();
  for (const NodeForce& f : forces_) motion_mm += top_->block(node, f.node) * f.force_N;
  return motion_mm;
}

std::vector<NormalContact::FreeNode> NormalContact::nearNodes(const Eigen::Matrix3Xd& motion_mm) const {
  std::vector<FreeNode> near;
  for (int i = 0; i < top_->count(); ++i) {
    const Eigen::Vector3d place_mm = top_->places_mm().col(i) + motion_mm.col(i);
    if (nearest(place_mm).gap_mm < nearGap * height_mm_) near.push_back({i, place_mm - motionByForces(i)});
  }
  return near;
}

/// One step of the active set method; `converged` becomes whether it left everything unchanged. Returns false without a
/// solution.
bool NormalContact::step(const std::vector<FreeNode>& near, bool& converged) {
  const double longestDepthStep_mm = height_mm_ / depthStepsOfHeight;
  // Positions of the nodes under the present forces, and the new active set.
  std::vector<int> active;
  std::vector<Nearest> touched;
  std::vector<double> right; // minus the gap without the forces
  std::vector<double> smallestGap_mm(indenters_.size(), nearGap * height_mm_);
  std::vector<char> carries(indenters_.size(), 0);
  std::size_t f = 0; // forces_ and near are in the order of the nodes
  for (const auto& [i, place_mm] : near) {
    while (f < forces_.size() && forces_[f].node < i) ++f;
    const Eigen::Vector3d byForces_mm = motionByForces(i);
    const Nearest at = nearest(place_mm + byForces_mm);
    smallestGap_mm[at.indenter] = std::min(smallestGap_mm[at.indenter], at.gap_mm);
    const double force_N = f < forces_.size() && forces_[f].node == i ? forces_[f].force_N.dot(at.normal) : 0;
    if (force_N * at.normal.dot(top_->block(i, i) * at.normal) <= at.gap_mm) continue;
    active.push_back(i);
    touched.push_back(at);
    right.push_back(at.normal.dot(byForces_mm) - at.gap_mm);
    carries[at.indenter] = 1;
  }
  const bool sameSet = std::equal(active.begin(), active.end(), forces_.begin(), forces_.end(),
                                  [](int i, const NodeForce& force) { return i == force.node; });
  // An indenter without contact moves down to the nearest node; one in contact is in equilibrium with its force.
  converged = sameSet;
  std::vector<std::size_t> pressing;
  for (std::size_t k = 0; k < indenters_.size(); ++k) {
    if (!indenters_[k].press()) continue;
    if (carries[k])
      pressing.push_back(k);
    else {
      tips_mm_[k].z() -= std::max(smallestGap_mm[k], 0.) + 1e-3 * longestDepthStep_mm;
      converged = false;
    }
  }
  if (active.empty()) {
    forces_.clear();
    return true;
  }
  const auto count = static_cast<Eigen::Index>(active.size()), freed = static_cast<Eigen::Index>(pressing.size());
  Eigen::MatrixXd compliance(count, count), down = Eigen::MatrixXd::Zero(count, freed);
  for (Eigen::Index a = 0; a < count; ++a) {
    const Eigen::Vector3d& normal = touched[a].normal;
    for (Eigen::Index k = 0; k < freed; ++k)
      if (touched[a].indenter == pressing[k]) down(a, k) = normal.z();
    for (Eigen::Index b = 0; b <= a; ++b)
      compliance(a, b) = compliance(b, a) = normal.dot(top_->block(active[a], active[b]) * touched[b].normal);
  }
  const auto factor = positiveFactor(compliance);
  if (!factor) return false;
  Eigen::VectorXd force_N = factor->solve(Eigen::Map<const Eigen::VectorXd>(right.data(), count));
  if (freed > 0) {
    const Eigen::MatrixXd byDepth = factor->solve(down);
    Eigen::VectorXd missing_N = -down.transpose() * force_N;
    for (Eigen::Index k = 0; k < freed; ++k) missing_N(k) += indenters_[pressing[k]].press()->force_N.z();
    const auto stiffness = positiveFactor(down.transpose() * byDepth);
    if (!stiffness) return false;
    const Eigen::VectorXd deeper_mm =
        stiffness->solve(missing_N).cwiseMax(-longestDepthStep_mm).cwiseMin(longestDepthStep_mm);
    force_N += byDepth * deeper_mm;
    for (Eigen::Index k = 0; k < freed; ++k) tips_mm_[pressing[k]].z() += deeper_mm(k);
    converged = converged && deeper_mm.cwiseAbs().maxCoeff() <= height_mm_ / convergedOfHeight;
  }
  if (!force_N.allFinite()) return false;
  double change_N = 0;
  std::vector<NodeForce> forces;
  for (Eigen::Index a = 0; a < count; ++a) {
    forces.push_back({active[a], force_N(a) * touched[a].normal});
    if (sameSet) change_N = std::max(change_N, (forces.back().force_N - forces_[a].force_N).norm());
  }
  converged = converged && change_N <= convergedForce * force_N.lpNorm<1>();
  forces_ = std::move(forces);
  return true;
}

bool NormalContact::solve(const Eigen::Matrix3Xd& motion_mm, const std::stop_token& stop) {
  const std::vector<FreeNode> near = nearNodes(motion_mm);
  bool converged = false;
  for (int s = 0; s < mostContactSteps && !converged && !stop.stop_requested(); ++s)
    if (!step(near, converged)) return false;
  return converged && std::none_of(forces_.begin(), forces_.end(),
                                   [&](const NodeForce& force) { return top_->atBorder(force.node); });
}

std::vector<NodeForce> NormalContact::forces() const {
  std::vector<NodeForce> all = forces_;
  for (NodeForce& force : all) force.node = top_->nodes()[force.node];
  return all;
}

} // namespace palp
