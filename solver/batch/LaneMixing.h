#pragma once

#include "solver/element/LaneKernels.h"

#include <array>
#include <cstddef>
#include <vector>

namespace palp {

/// Anderson's acceleration of lanes' fixed-point iterations (Anderson 1965; Walker and Ni 2011, depth 2): with the
/// directions r_k and the steps s_k of the iterations so far,
///
///   s_k = r_k - sum_j gamma_j (s_j + r_j+1 - r_j),   gamma = argmin |r_k - sum_j gamma_j (r_j+1 - r_j)|,   j = k-2,
///   k-1
///
/// over some of the unknowns, the leading ones; the others follow with the same gamma. History is kept in single
/// precision: it changes the way, not the fixed point.
class LaneMixing {
public:
  static constexpr int depth = 2;

  /// Numbers [leading][32 lanes] and [following][32 lanes], the latter in any order of the caller's.
  LaneMixing(std::size_t leading, std::size_t following);

  /// A lane has no history and is mixed from now on, or is left as it is.
  void begin(int lane, bool mixed);
  /// What a lane has gone so far says nothing about the next directions, as another load begins.
  void restart(int lane) { restarts_[lane] = true; }
  [[nodiscard]] bool mixes(int lane) const { return mixed_[lane]; }

  /// Turns the leading directions [leading][32] of the lanes that are moved into steps.
  void mixLeading(const std::array<bool, batchLanes>& moved, double* directions);
  /// Turns one number of a following direction of the lane, once an iteration, into its step. `index` is its own.
  [[nodiscard]] double mixFollowing(int lane, std::size_t index, double direction);

private:
  /// Of one number in one lane.
  struct Past {
    float direction = 0, step = 0;
    std::array<float, depth> motion{}; ///< s_j + r_j+1 - r_j
  };
  std::array<bool, batchLanes> mixed_{}, restarts_{};
  std::array<int, batchLanes> iterations_{}; ///< of each lane before this one
  std::array<std::array<double, depth>, batchLanes> gamma_{};
  std::vector<Past> leading_, following_;
  std::vector<std::array<float, depth>> changes_; ///< r_j+1 - r_j of the leading numbers
};

} // namespace palp
