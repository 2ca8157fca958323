#include "solver/batch/ContactColumns.h"

#include "solver/contact/FrictionContact.h"
#include "solver/contact/NormalContact.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int contactSpan = 4; // iterations over which the contraction of a load with indenters is measured

} // namespace

bool ContactColumns::hasFriction(const LoadCase& load) {
  return std::any_of(load.indenters.begin(), load.indenters.end(),
                     [](const Indenter& indenter) { return indenter.friction > 0; });
}

void ContactColumns::begin(int column, const LoadCase& load, LoadBatch& batch, ConvergenceMonitor& watch,
                           bool inSingle) {
  if (hasFriction(load))
    contacts_[column] = std::make_unique<FrictionContact>(load.indenters, top_, problem_.mesh(), problem_.design());
  else
    contacts_[column] = std::make_unique<NormalContact>(load.indenters, top_);
  batch.mix(column, inSingle);
  watch.begin(column, 1, contactSpan); // its contraction is unknown
}

void ContactColumns::iterate(LoadBatch& batch, ConvergenceMonitor& watch, const std::stop_token& stop) const {
  bool any = false;
  for (int column = 0; column < batchColumns; ++column) any = any || (watch.active[column] && contacts_[column]);
  if (!any) return batch.iterate(watch.active, watch.change, stop);
  batch.iterate(
      watch.active, watch.change, top_->nodes(), top_->path(),
      [&](int column, const Eigen::Matrix3Xd& motion_mm) {
        if (!contacts_[column]) return true;
        if (!contacts_[column]->solve(motion_mm, stop)) return false;
        if (contacts_[column]->modeChanged()) batch.resetHistory(column);
        batch.setNodeForces(column, contacts_[column]->forces());
        return true;
      },
      stop);
}

void ContactColumns::continueIncrements(LoadBatch& batch, ConvergenceMonitor& watch,
                                        const std::array<bool, batchColumns>& wasActive) const {
  for (int column = 0; column < batchColumns; ++column) {
    if (!wasActive[column] || watch.active[column] || watch.failed[column] || !contacts_[column]) continue;
    const ColumnContact::StepResult result =
        contacts_[column]->finishIncrement(batch.displacementsOf(column, top_->nodes()));
    if (result == ColumnContact::StepResult::Failed) watch.failed[column] = true;
    if (contacts_[column]->modeChanged()) batch.resetHistory(column);
    if (result == ColumnContact::StepResult::NextIncrement)
      batch.continueWith(column, contacts_[column]->extrapolates());
    if (result == ColumnContact::StepResult::NextIncrement || result == ColumnContact::StepResult::RepeatIncrement)
      watch.begin(column, 1, contactSpan); // its contraction is unknown
  }
}

} // namespace palp
