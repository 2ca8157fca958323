#pragma once

#include "solver/element/ElementKernels.h"
#include "solver/element/LaneKernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace palp {

/// Follows the change c of each lane and says when its error is below the tolerance: what is left of a geometric series
/// of contraction q after a change c is c q / (1 - q).
class LaneWatch {
public:
  static constexpr int mostIterations = 30;
  static constexpr double slowestContraction = 0.8; ///< above it full Newton is the better way
  static constexpr double cautionary = 1.5;         ///< on measured contractions

  explicit LaneWatch(double tolerance) : tolerance_(tolerance) {}

  std::array<bool, batchLanes> active{}, failed{};
  std::array<double, batchLanes> change{};

  /// A lane begins with the contraction that is assumed until it can be measured. Where nodes come into contact and
  /// leave it the changes fall unevenly: `span` is the number of iterations over which the contraction is measured.
  void begin(int lane, double assumedContraction, int span = 1) {
    active[lane] = true;
    failed[lane] = false;
    contraction_[lane] = assumedContraction;
    span_[lane] = span;
    changes_[lane].clear();
  }
  /// A lane goes on as another.
  void move(int from, int to) {
    active[to] = std::exchange(active[from], false);
    failed[to] = failed[from];
    change[to] = change[from];
    contraction_[to] = contraction_[from];
    span_[to] = span_[from];
    changes_[to] = std::move(changes_[from]);
  }
  [[nodiscard]] bool anyActive() const { return std::find(active.begin(), active.end(), true) != active.end(); }
  [[nodiscard]] bool anyActive(int block) const {
    const auto* first = active.data() + block * lanes;
    return std::find(first, first + lanes, true) != first + lanes;
  }
  /// Of the last iteration judged: measured, with caution, after the first.
  [[nodiscard]] double contraction(int lane) const { return contraction_[lane]; }

  /// Judges one iteration of the active lanes.
  void judge() {
    for (int lane = 0; lane < batchLanes; ++lane) {
      if (!active[lane]) continue;
      const double c = change[lane];
      std::vector<double>& changes = changes_[lane];
      const auto iteration = static_cast<int>(changes.size());
      const int over = std::min(iteration, span_[lane]);
      changes.push_back(c);
      if (over > 0 && changes[iteration - over] > 0)
        contraction_[lane] = cautionary * std::pow(c / changes[iteration - over], 1. / over);
      const bool hopeless = iteration > 2 * span_[lane] && contraction_[lane] > cautionary * slowestContraction;
      if (c < 0 || hopeless || iteration + 1 == mostIterations) {
        failed[lane] = true;
        active[lane] = false;
      } else if (c == 0 ||
                 (contraction_[lane] < 1 && c * contraction_[lane] / (1 - contraction_[lane]) <= tolerance_)) {
        active[lane] = false;
      }
    }
  }

private:
  double tolerance_;
  std::array<int, batchLanes> span_{};
  std::array<double, batchLanes> contraction_{};
  std::array<std::vector<double>, batchLanes> changes_; ///< of each iteration
};

} // namespace palp
