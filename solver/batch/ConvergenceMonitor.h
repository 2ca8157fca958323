#pragma once

#include "solver/element/ElementKernels.h"
#include "solver/element/LaneKernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace palp {

/// Estimates the remaining error of each column from the contraction of its changes: after a change c of a geometric
/// series of contraction q the remainder is c q / (1 - q). A column converges when that is below the tolerance, and
/// fails where the changes do not contract or after mostIterations.
class ConvergenceMonitor {
public:
  static constexpr int mostIterations = 30;
  static constexpr double slowestContraction = 0.8; ///< above it full Newton is cheaper
  static constexpr double cautionary = 1.5;         ///< factor on measured contractions

  explicit ConvergenceMonitor(double tolerance) : tolerance_(tolerance) {}

  std::array<bool, batchColumns> active{}, failed{};
  std::array<double, batchColumns> change{};

  /// Starts a column with the contraction that is assumed until one can be measured. `span` is the number of iterations
  /// over which it is measured: above 1 for contact, whose changes fall irregularly as nodes close and open.
  void begin(int column, double assumedContraction, int span = 1) {
    active[column] = true;
    failed[column] = false;
    contraction_[column] = assumedContraction;
    span_[column] = span;
    changes_[column].clear();
  }
  /// Moves a column's state to another column.
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
  /// Contraction at the last iteration judged: measured, times `cautionary`, after the first.
  [[nodiscard]] double contraction(int column) const { return contraction_[column]; }

  /// Updates the active columns after an iteration.
  void judge() {
    for (int column = 0; column < batchColumns; ++column) {
      if (!active[column]) continue;
      const double c = change[column];
      std::vector<double>& changes = changes_[column];
      const auto iteration = static_cast<int>(changes.size());
      const int over = std::min(iteration, span_[column]);
      changes.push_back(c);
      if (over > 0 && changes[iteration - over] > 0)
        contraction_[column] = cautionary * std::pow(c / changes[iteration - over], 1. / over);
      const bool hopeless = iteration > 2 * span_[column] && contraction_[column] > cautionary * slowestContraction;
      if (c < 0 || hopeless || iteration + 1 == mostIterations) {
        failed[column] = true;
        active[column] = false;
      } else if (c == 0 ||
                 (contraction_[column] < 1 && c * contraction_[column] / (1 - contraction_[column]) <= tolerance_)) {
        active[column] = false;
      }
    }
  }

private:
  double tolerance_;
  std::array<int, batchColumns> span_{};
  std::array<double, batchColumns> contraction_{};
  std::array<std::vector<double>, batchColumns> changes_; ///< change of each iteration
};

} // namespace palp
