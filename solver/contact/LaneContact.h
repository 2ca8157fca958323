#pragma once

#include "solver/batch/LoadBatch.h"

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp {

/// What the indenters of one load of a batch do, in the space of the nodes that they can press (TopCompliance).
class LaneContact {
public:
  LaneContact() = default;
  LaneContact(const LaneContact&) = delete;
  LaneContact& operator=(const LaneContact&) = delete;
  virtual ~LaneContact() = default;

  /// Forces on the nodes that move so [3 x nodes] under the forces found before, which are where it starts; none at
  /// first. False: no answer, or one that reaches the border of the compliance, or stopped.
  [[nodiscard]] virtual bool solve(const Eigen::Matrix3Xd& motion_mm, const std::stop_token& stop) = 0;

  /// The indenters' force on each node of the mesh that carries one.
  [[nodiscard]] virtual std::vector<NodeForce> forces() const = 0;

  /// A load may be taken in parts, one after another. `settled` says whether it is there, now that the iteration of a
  /// part has ended with this motion of the nodes, goes on to the next part, stays at this one as more nodes touch than
  /// were known, or is to be found in another way.
  enum class Way { Arrived, GoesOn, StaysHere, Lost };
  [[nodiscard]] virtual Way settled(const Eigen::Matrix3Xd& motion_mm) = 0;
  /// Whether, since this was last asked, it began to answer in another way: the motion so far does not foretell the
  /// next.
  [[nodiscard]] virtual bool turned() { return false; }
  /// Whether the part in work leads as far again, and in the same direction, as the one before.
  [[nodiscard]] virtual bool straightOn() const { return false; }
};

} // namespace palp
