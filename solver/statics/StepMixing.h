#pragma once

#include "solver/element/LaneVector.h"

#include <Eigen/Core>

#include <deque>

namespace palp {

/// Anderson's acceleration of an iteration z <- z + r(z) with one tangent (Anderson 1965; Walker and Ni 2011): with
/// the directions r_k and the steps s_k so far,
///
///   s_k = r_k - sum_j gamma_j (s_j + r_j+1 - r_j),   gamma = argmin |r_k - sum_j gamma_j (r_j+1 - r_j)|
///
/// over the last few j. z are the nodes' displacements, by which r is measured, and the elements' own unknowns, which
/// follow.
class StepMixing {
public:
  static constexpr std::size_t depth = 3;

  /// Forgets what was: another iteration begins.
  void restart() { past_.clear(); }
  /// Turns a direction into the step to take.
  void mix(Eigen::VectorXd& displacements, LaneVector& unknowns);

private:
  struct Part {
    Eigen::VectorXd displacements, unknowns;
  };
  /// A direction and its step, and how they changed to the next iteration.
  struct Past {
    Part direction, step, motion; ///< motion: s_j + r_j+1 - r_j
    Eigen::VectorXd change;       ///< r_j+1 - r_j
  };
  [[nodiscard]] Eigen::VectorXd shares(const Eigen::VectorXd& direction) const;

  std::deque<Past> past_; ///< the oldest first
};

} // namespace palp
