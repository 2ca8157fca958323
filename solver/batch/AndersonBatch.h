#pragma once

#include "solver/element/ElementKernels.h"
#include "solver/element/LaneKernels.h"
#include "solver/element/LaneVector.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace palp {

/// Anderson mixing of up to 32 fixed-point iterations, one per column (Anderson 1965; Walker and Ni 2011; depth 2; for
/// a single iteration see statics/StepMixing.h). Why: touches contract slowly under modified Newton
/// (resources/docs/numerics/many-loads.md). With the directions r_k and the steps s_k of the iterations so far,
///
///   s_k = r_k - sum_j gamma_j (s_j + r_j+1 - r_j),   gamma = argmin |r_k - sum_j gamma_j (r_j+1 - r_j)|,   j = k-2,
///   k-1
///
/// where the minimum is over some of the unknowns, the leading ones (displacements); the following ones (the elements'
/// internal unknowns) use the same gamma. The history is in single precision, which changes the iterates but not the
/// fixed point, and is stored in blocks of 8 SIMD lanes. Per iteration: moveLeading once, then moveFollowing for each
/// group of following unknowns.
class AndersonBatch {
public:
  /// Leading unknowns [leading][32 columns], following ones [following / count][4 blocks][count][8 lanes] in any order.
  AndersonBatch(std::size_t leading, std::size_t following, int count);

  /// Clears the history of a column and switches its mixing on or off.
  void begin(int column, bool mixed);
  /// Discards the history of a column, as another load increment starts.
  void restart(int column) { restarts_[column] = true; }

  /// Copies the history of a column to another; between iterations, after all of moveFollowing.
  void copy(int from, int to);

  /// Adds the mixed step of the directions scale[column] directions[rows[i]][column] to u [leading][32]; columns with
  /// scale 0 stay.
  void moveLeading(std::span<const int> rows, const float* directions, const std::array<double, batchColumns>& scale,
                   double* u);
  /// The same for `count` of the following unknowns of a block, after moveLeading: directions and values [count][8].
  void moveFollowing(int block, std::size_t place, const double* directions, double* values) {
    laneKernels().followMixed(
        directions, count_, mixes_[block],
        following_.data() + (place * blocks + block) * std::size_t(count_) * followingPast * lanes, values);
  }

private:
  static constexpr int blocks = batchColumns / lanes;

  void begin(const std::array<double, batchColumns>& scale);
  void findGamma(int column, const double* sums);

  int count_;
  std::array<bool, batchColumns> mixed_{}, restarts_{};
  std::array<bool, batchColumns> hasLast_{}; ///< whether the last direction and step are stored
  std::array<int, batchColumns> motions_{};  ///< number of stored motions of each column
  std::array<LaneMix, blocks> mixes_{};      ///< of this iteration
  FloatLanes leading_;                       ///< [leading][blocks][leadingPast][8]
  FloatLanes following_;                     ///< [following / count][blocks][count][followingPast][8]
};

} // namespace palp
