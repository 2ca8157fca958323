#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/batch/LaneWatch.h"
#include "solver/batch/LoadBatch.h"
#include "solver/contact/LaneContact.h"
#include "solver/contact/TopCompliance.h"

#include <array>
#include <memory>
#include <stop_token>

namespace palp {

/// The loads with indenters among a batch's lanes. Each begins and ends for itself, so that a lane whose touch has been
/// found need not wait for its block's others.
class TouchLanes {
public:
  /// `top` is null where there are none.
  TouchLanes(std::shared_ptr<const TopCompliance> top, const HyperelasticProblem& problem)
      : top_(std::move(top)), problem_(problem) {}

  static bool isTouch(const LoadCase& load) { return !load.indenters.empty(); }
  static bool hasFriction(const LoadCase& load);

  /// A lane begins with this load's indenters, from rest; `inSingle` as in LoadBatch, the same for a block's lanes.
  void begin(int lane, const LoadCase& load, LoadBatch& batch, LaneWatch& watch, bool inSingle);
  void end(int lane) { contacts_[lane].reset(); }
  void move(int from, int to) { contacts_[to] = std::move(contacts_[from]); }

  /// One iteration of the active lanes, those without indenters as well. Lanes whose indenters find no place fail.
  void iterate(LoadBatch& batch, LaneWatch& watch, const std::stop_token& stop) const;
  /// Lanes whose loads are taken in parts: on to the next where they have found the one in work.
  void goOn(LoadBatch& batch, LaneWatch& watch, const std::array<bool, batchLanes>& wasActive) const;

private:
  std::shared_ptr<const TopCompliance> top_;
  const HyperelasticProblem& problem_;
  std::array<std::unique_ptr<LaneContact>, batchLanes> contacts_;
};

} // namespace palp
