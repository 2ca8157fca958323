#include "solver/contact/ContactSteps.h"

#include <algorithm>

namespace palp {

namespace {

constexpr double longestMove = 0.5; // of an indenter in one iteration, relative to its expected depth
// Of a load with friction. During normal loading, rubber that comes into contact in an increment sticks where it was
// before that increment: the error is proportional to the increment. Under tangential loading it slides in one
// direction, and the increment hardly matters (resources/docs/numerics/contact.md).
constexpr double frictionSteps = 4, stepsOfTwoParts = frictionSteps / pressShare;

} // namespace

double largestContactStep(const std::vector<Indenter>& indenters, bool fromRest) {
  double size = 1;
  for (const Indenter& indenter : indenters)
    if (indenter.friction > 0)
      size = std::min(size, 1 / (fromRest && indenter.hasTwoParts() ? stepsOfTwoParts : frictionSteps));
  return size;
}

std::vector<ContactEstimate> contactEstimates(const std::vector<Indenter>& indenters, const SensorDesign& design) {
  std::vector<ContactEstimate> all;
  for (const Indenter& indenter : indenters) all.push_back(contactEstimate(indenter, design));
  return all;
}

std::vector<ContactTarget> contactTargets(const std::vector<Indenter>& parts,
                                          std::span<const ContactEstimate> expected) {
  std::vector<ContactTarget> all;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Indenter& part = parts[k];
    ContactTarget target{
        {false, false, false}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), longestMove * expected[k].depth_mm};
    if (const Press* press = part.press()) {
      target.force_N = press->force_N;
      target.free = {part.friction > 0, part.friction > 0, true};
    } else {
      target.translation_mm << part.motion()->shift_mm, -part.motion()->depth_mm;
    }
    all.push_back(target);
  }
  return all;
}

bool constrainTangentially(std::vector<ContactTarget>& targets, const ContactState& state) {
  bool any = false;
  for (std::size_t k = 0; k < targets.size(); ++k)
    for (const int c : {0, 1})
      if (targets[k].free(c)) {
        targets[k].free(c) = false;
        targets[k].translation_mm(c) = state.translations_mm(c, static_cast<Eigen::Index>(k));
        any = true;
      }
  return any;
}

bool penetrates(const std::vector<Indenter>& indenters, const Eigen::Matrix3Xd& tips_mm,
                const Eigen::Vector3d& position_mm, double allowed_mm) {
  for (std::size_t k = 0; k < indenters.size(); ++k)
    if (distance(indenters[k], position_mm - tips_mm.col(static_cast<Eigen::Index>(k))).gap_mm < -allowed_mm)
      return true;
  return false;
}

bool slidAway(const std::vector<Indenter>& indenters, std::span<const ContactEstimate> expected,
              const ContactState& from, const ContactState& to) {
  for (std::size_t k = 0; k < indenters.size(); ++k) {
    if (!indenters[k].press() || indenters[k].friction == 0) continue;
    const auto column = static_cast<Eigen::Index>(k);
    const double slip_mm = (to.translations_mm.col(column) - from.translations_mm.col(column)).head<2>().norm();
    if (slip_mm > expected[k].half_mm.minCoeff()) return true;
  }
  return false;
}

ContactState untouched(std::size_t points, std::size_t indenters) {
  return {Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(points)),
          Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(indenters)),
          std::vector<ContactStatus>(points, ContactStatus::Open)};
}

} // namespace palp
