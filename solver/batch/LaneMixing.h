#pragma once

#include "solver/element/ElementKernels.h"
#include "solver/element/LaneKernels.h"
#include "solver/element/LaneVector.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace palp {

/// Anderson's acceleration of lanes' fixed-point iterations (Anderson 1965; Walker and Ni 2011, depth 2): with the
/// directions r_k and the steps s_k of the iterations so far,
///
///   s_k = r_k - sum_j gamma_j (s_j + r_j+1 - r_j),   gamma = argmin |r_k - sum_j gamma_j (r_j+1 - r_j)|,   j = k-2,
///   k-1
///
/// over some of the unknowns, the leading ones; the others follow with the same gamma. History is kept in single
/// precision: it changes the way, not the fixed point. It stands block by block of 8 lanes, so that it is worked
/// through as fast as it is read.
class LaneMixing {
public:
  /// Leading numbers [leading][32 lanes], following ones [following / count][4 blocks][count][8 lanes] in any order of
  /// the caller's.
  LaneMixing(std::size_t leading, std::size_t following, int count);

  /// A lane has no history and is mixed from now on, or is left as it is.
  void begin(int lane, bool mixed);
  /// What a lane has gone so far says nothing about the next directions, as another load begins.
  void restart(int lane) { restarts_[lane] = true; }

  /// All that is known of a lane becomes known of another; between two iterations, when all that follows has moved.
  void copy(int from, int to);

  /// u [leading][32] goes along the directions, scale[lane] directions[rows[i]][lane], or what is mixed of them; lanes
  /// without scale stay.
  void moveLeading(std::span<const int> rows, const float* directions, const std::array<double, batchLanes>& scale,
                   double* u);
  /// The same for `count` of the following numbers of a block, once an iteration and after moveLeading: directions and
  /// values [count][8].
  void moveFollowing(int block, std::size_t place, const double* directions, double* values) {
    laneKernels().followMixed(
        directions, count_, mixes_[block],
        following_.data() + (place * blocks + block) * std::size_t(count_) * followingPast * lanes, values);
  }

private:
  static constexpr int blocks = batchLanes / lanes;

  void begin(const std::array<double, batchLanes>& scale);
  void findGamma(int lane, const double* sums);

  int count_;
  std::array<bool, batchLanes> mixed_{}, restarts_{};
  std::array<bool, batchLanes> hasLast_{}; ///< a direction and a step that the next direction makes a pair with
  std::array<int, batchLanes> known_{};    ///< motions of each lane
  std::array<LaneMix, blocks> mixes_{};    ///< of this iteration
  FloatLanes leading_;                     ///< [leading][blocks][leadingPast][8]
  FloatLanes following_;                   ///< [following / count][blocks][count][followingPast][8]
};

} // namespace palp
