#pragma once

#include "solver/element/LaneVector.h"

#include <functional>

namespace palp {

/// Columns that are worked on together.
inline constexpr int frontTile = 256;

/// Runs tasks 0 .. count - 1, perhaps in parallel; false where they were stopped.
using TaskRunner = std::function<bool(int count, double flops, const std::function<void(int)>&)>;

/// The lower triangle that a supernode hands to its parent, in blocks of columns without the rows above them.
class UpdateMatrix {
public:
  UpdateMatrix() = default;
  explicit UpdateMatrix(int size);

  [[nodiscard]] int size() const { return size_; }
  /// Column j, addressed by rows, from the first of its block on.
  [[nodiscard]] double* column(int j) { return values_.data() + start(j); }
  [[nodiscard]] const double* column(int j) const { return values_.data() + start(j); }
  /// Between the columns of j's block.
  [[nodiscard]] int stride(int j) const { return size_ - j / frontTile * frontTile; }

private:
  [[nodiscard]] std::size_t start(int j) const;

  int size_ = 0;
  UnsetArray<double> values_;
};

enum class FrontOutcome { Done, NotPositiveDefinite, Stopped };

/// Factorises a panel of height x width in place; the update becomes -L21 L21^T.
FrontOutcome factoriseFront(double* panel, int height, int width, UpdateMatrix& update, const TaskRunner& run);

/// BLAS at one thread from here on: how its sums are cut depends on the number of threads.
void useOneBlasThread();

} // namespace palp
