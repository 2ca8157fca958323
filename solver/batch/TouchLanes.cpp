#include "solver/batch/TouchLanes.h"

#include "solver/contact/FrictionContact.h"
#include "solver/contact/NormalContact.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int contactSpan = 4; // iterations over which the contraction of a load with indenters is measured

} // namespace

bool TouchLanes::hasFriction(const LoadCase& load) {
  return std::any_of(load.indenters.begin(), load.indenters.end(),
                     [](const Indenter& indenter) { return indenter.friction > 0; });
}

void TouchLanes::begin(int lane, const LoadCase& load, LoadBatch& batch, LaneWatch& watch, bool inSingle) {
  if (hasFriction(load))
    contacts_[lane] = std::make_unique<FrictionContact>(load.indenters, top_, problem_.mesh(), problem_.design());
  else
    contacts_[lane] = std::make_unique<NormalContact>(load.indenters, top_);
  batch.mix(lane, inSingle);
  watch.begin(lane, 1, contactSpan); // nothing is known of it
}

void TouchLanes::iterate(LoadBatch& batch, LaneWatch& watch, const std::stop_token& stop) const {
  bool any = false;
  for (int lane = 0; lane < batchLanes; ++lane) any = any || (watch.active[lane] && contacts_[lane]);
  if (!any) return batch.iterate(watch.active, watch.change, stop);
  batch.iterate(
      watch.active, watch.change, top_->nodes(), top_->path(),
      [&](int lane, const Eigen::Matrix3Xd& motion_mm) {
        if (!contacts_[lane]) return true;
        if (!contacts_[lane]->solve(motion_mm, stop)) return false;
        if (contacts_[lane]->turned()) batch.turn(lane);
        batch.setNodeForces(lane, contacts_[lane]->forces());
        return true;
      },
      stop);
}

void TouchLanes::goOn(LoadBatch& batch, LaneWatch& watch, const std::array<bool, batchLanes>& wasActive) const {
  for (int lane = 0; lane < batchLanes; ++lane) {
    if (!wasActive[lane] || watch.active[lane] || watch.failed[lane] || !contacts_[lane]) continue;
    const LaneContact::Way way = contacts_[lane]->settled(batch.displacementsOf(lane, top_->nodes()));
    if (way == LaneContact::Way::Lost) watch.failed[lane] = true;
    if (contacts_[lane]->turned()) batch.turn(lane);
    if (way == LaneContact::Way::GoesOn) batch.goOn(lane, contacts_[lane]->straightOn());
    if (way == LaneContact::Way::GoesOn || way == LaneContact::Way::StaysHere)
      watch.begin(lane, 1, contactSpan); // nothing is known of it
  }
}

} // namespace palp
