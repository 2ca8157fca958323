#include "solver/contact/FrictionContact.h"

#include <algorithm>
#include <cmath>

namespace palp {

FrictionContact::FrictionContact(std::vector<Indenter> indenters, std::shared_ptr<const TopCompliance> top,
                                 const Mesh& mesh, const SensorDesign& design)
    : indenters_(std::move(indenters)), top_(std::move(top)), mesh_(mesh), design_(design),
      tips_mm_(tipsAtRest_mm(indenters_, mesh)), expected_(contactEstimates(indenters_, design)),
      steps_(static_cast<int>(std::lround(1 / largestContactStep(indenters_, true)))) {
  choosePoints(margin_);
  state_ = untouched(points_.size(), indenters_.size());
  beginStep(Eigen::Matrix3Xd::Zero(3, top_->count()));
  const std::vector<ContactEstimate> first = contactEstimates(partsAt(1. / steps_), design);
  for (std::size_t k = 0; k < first.size(); ++k)
    state_.translations_mm.col(static_cast<Eigen::Index>(k)).z() = -first[k].depth_mm;
}

void FrictionContact::choosePoints(double margin) {
  LoadCase load;
  load.indenters = indenters_;
  points_.clear();
  numbers_.clear();
  for (const ContactPoint& point : touchablePoints(mesh_, design_, {load}, margin)) {
    const auto at = std::lower_bound(top_->nodes().begin(), top_->nodes().end(), point.node);
    if (at == top_->nodes().end() || *at != point.node) continue; // outside of the compliance
    points_.push_back(point);
    numbers_.push_back(static_cast<int>(at - top_->nodes().begin()));
  }
  const auto count = static_cast<Eigen::Index>(points_.size());
  compliance_.resize(3 * count, 3 * count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index i = 0; i < count; ++i)
      compliance_.block<3, 3>(3 * i, 3 * j) = top_->block(numbers_[std::size_t(i)], numbers_[std::size_t(j)]);
  contact_.emplace(indenters_, points_, tips_mm_);
}

std::vector<Indenter> FrictionContact::partsAt(double fraction) const {
  std::vector<Indenter> parts;
  for (const Indenter& indenter : indenters_) parts.push_back(indenter.at(fraction));
  return parts;
}

void FrictionContact::beginStep(const Eigen::Matrix3Xd& motion_mm) {
  startMotion_mm_ = motion_mm;
  start_ = slipStart_ = state_;
  tangential_ = TangentialControl::Force;
  contact_->startStep(positions(motion_mm), start_);
  targets_ = contactTargets(partsAt(double(step_) / steps_), expected_);
}

/// Repeats the increment from its start with the tangential translations held. The forces stay, since the nodes' motion
/// belongs to them. Returns false if that was done already, or no indenter is free.
bool FrictionContact::constrain() {
  if (tangential_ != TangentialControl::Force) return false;
  tangential_ = TangentialControl::Displacement;
  modeChanged_ = true;
  return constrainTangentially(targets_, start_);
}

void FrictionContact::release(const Eigen::Matrix3Xd& motion_mm) {
  startMotion_mm_ = motion_mm;
  slipStart_ = state_;
  tangential_ = TangentialControl::Free;
  modeChanged_ = true;
  contact_->startStep(positions(motion_mm), slipStart_);
  targets_ = contactTargets(partsAt(double(step_) / steps_), expected_);
}

/// Adds candidate points, in the present increment too; existing ones keep their forces.
void FrictionContact::extendCandidates() {
  modeChanged_ = true;
  const std::vector<ContactPoint> existing = points_;
  const ContactState before = start_, from = slipStart_, now = state_;
  choosePoints(margin_ *= marginGrowth);
  const auto grown = [&](const ContactState& small) {
    ContactState large = untouched(points_.size(), indenters_.size());
    large.translations_mm = small.translations_mm;
    for (std::size_t i = 0, k = 0; i < points_.size(); ++i) { // both sorted by node
      while (k < existing.size() && existing[k].node < points_[i].node) ++k;
      if (k == existing.size() || existing[k].node != points_[i].node) continue;
      large.forces_N.col(static_cast<Eigen::Index>(i)) = small.forces_N.col(static_cast<Eigen::Index>(k));
      large.statuses[i] = small.statuses[k];
    }
    return large;
  };
  start_ = grown(before);
  slipStart_ = grown(from);
  state_ = grown(now);
  contact_->startStep(positions(startMotion_mm_), slipStart_);
}

Eigen::Matrix3Xd FrictionContact::positions(const Eigen::Matrix3Xd& motion_mm) const {
  Eigen::Matrix3Xd x(3, static_cast<Eigen::Index>(numbers_.size()));
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    x.col(static_cast<Eigen::Index>(i)) = top_->places_mm().col(numbers_[i]) + motion_mm.col(numbers_[i]);
  return x;
}

/// Fails where a point at the border of the compliance is in contact: points beyond it may be, too.
bool FrictionContact::solve(const Eigen::Matrix3Xd& motion_mm, const std::stop_token& stop) {
  const ContactState before = state_;
  const auto solved = [&] {
    if (!contact_->solve(compliance_, positions(motion_mm), targets_, state_, stop)) return false;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (state_.statuses[i] != ContactStatus::Open && top_->atBorder(numbers_[i])) return false;
    return true;
  };
  if (points_.empty()) return false;
  if (solved()) return true;
  state_ = before;
  return constrain() && solved();
}

std::vector<NodeForce> FrictionContact::forces() const {
  std::vector<NodeForce> all;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (const Eigen::Vector3d force_N = state_.forces_N.col(static_cast<Eigen::Index>(i)); !force_N.isZero(0))
      all.push_back({points_[i].node, force_N});
  return all;
}

bool FrictionContact::touchesBeyond(const Eigen::Matrix3Xd& motion_mm) const {
  const double allowed_mm = top_->places_mm().row(2).maxCoeff() / penetrationOfHeight;
  for (int i = 0; i < top_->count(); ++i) {
    if (std::binary_search(numbers_.begin(), numbers_.end(), i)) continue;
    const Eigen::Vector3d position_mm = top_->places_mm().col(i) + motion_mm.col(i);
    if (penetrates(indenters_, tips_mm_ + state_.translations_mm, position_mm, allowed_mm)) return true;
  }
  return false;
}

ColumnContact::StepResult FrictionContact::finishIncrement(const Eigen::Matrix3Xd& motion_mm) {
  if (slid()) return constrain() ? StepResult::RepeatIncrement : StepResult::Failed;
  if (touchesBeyond(motion_mm)) {
    if (++extensions_ == mostMargins) return StepResult::Failed;
    extendCandidates();
    return StepResult::RepeatIncrement;
  }
  if (tangential_ == TangentialControl::Displacement) {
    release(motion_mm);
    return StepResult::RepeatIncrement;
  }
  if (step_ == steps_) return StepResult::Converged;
  ++step_;
  beginStep(motion_mm);
  return StepResult::NextIncrement;
}

/// Not where tangential loading starts with this increment.
bool FrictionContact::extrapolates() const {
  return step_ - 1 != std::lround(pressShare * steps_) ||
         std::none_of(indenters_.begin(), indenters_.end(),
                      [](const Indenter& indenter) { return indenter.hasTwoParts(); });
}

} // namespace palp
