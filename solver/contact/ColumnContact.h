#pragma once

#include "solver/batch/LoadBatch.h"

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp {

/// Contact of the indenters of one load of a batch, in the space of the nodes that they can press (TopCompliance).
///
/// A load may be applied in increments. Order of calls: in each iteration `solve`, then `forces`; when the iteration of
/// an increment has converged, `finishIncrement`, which returns what follows:
///   NextIncrement     the next increment is set up, from the present state (or extrapolated where `extrapolates`)
///   RepeatIncrement   the same increment again, with more candidate points or another tangential control
///   Converged         the complete load is applied
///   Failed            to be solved by full Newton
/// `modeChanged` is read after `solve` and after `finishIncrement`: where true, the mixing history is discarded.
class ColumnContact {
public:
  ColumnContact() = default;
  ColumnContact(const ColumnContact&) = delete;
  ColumnContact& operator=(const ColumnContact&) = delete;
  virtual ~ColumnContact() = default;

  /// Solves for the forces on the nodes at their motion [3 x nodes] under the previous forces (none at first), which
  /// are the initial guess. Returns false without an equilibrium, at the border of the compliance, or if cancelled.
  [[nodiscard]] virtual bool solve(const Eigen::Matrix3Xd& motion_mm, const std::stop_token& stop) = 0;

  /// The indenters' force on each loaded node of the mesh.
  [[nodiscard]] virtual std::vector<NodeForce> forces() const = 0;

  enum class StepResult { Converged, NextIncrement, RepeatIncrement, Failed };
  /// Called when the iteration of an increment has converged with this motion of the nodes.
  [[nodiscard]] virtual StepResult finishIncrement(const Eigen::Matrix3Xd& motion_mm) = 0;
  /// Whether the contact mode changed since the last call.
  [[nodiscard]] virtual bool modeChanged() { return false; }
  /// Whether the present increment equals the previous one in size and direction.
  [[nodiscard]] virtual bool extrapolates() const { return false; }
};

} // namespace palp
