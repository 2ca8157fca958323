#pragma once

#include "solver/element/LaneVector.h"

#include <cstddef>
#include <functional>

namespace palp {

/// Columns that are factorised together: a tile of them, 256 x 256 doubles, stays in a second-level cache.
inline constexpr int frontTile = 256;

/// Runs tasks 0 .. count - 1, perhaps in parallel; `flops` is their work in all. False: stopped on the way.
using TaskRunner = std::function<bool(int count, double flops, const std::function<void(int)>&)>;

/// What a supernode hands to its parent (its Schur complement's part, U = -L21 L21^T): a lower triangle in blocks of
/// 256 columns, each without the rows above it, in little more than half of the full square's memory.
class UpdateMatrix {
public:
  UpdateMatrix() = default;
  explicit UpdateMatrix(int size);

  [[nodiscard]] int size() const { return size_; }
  /// Column j, to be indexed by the triangle's rows; the rows above its block are not stored.
  [[nodiscard]] double* column(int j) { return values_.data() + start(j); }
  [[nodiscard]] const double* column(int j) const { return values_.data() + start(j); }
  /// From one column of j's block to the next.
  [[nodiscard]] int stride(int j) const { return size_ - j / frontTile * frontTile; }

  /// Releases the memory of the columns before column j where possible; they must not be read any more.
  void forgetBefore(int j);

private:
  [[nodiscard]] std::size_t start(int j) const;

  int size_ = 0;
  UnsetArray<double> values_;
};

/// Precision in which the update of the remaining unknowns is computed; it is subtracted in double.
enum class UpdatePrecision { Double, Single };

enum class FrontOutcome { Done, NotPositiveDefinite, Stopped };

/// Eliminates the first `width` unknowns of a front (Duff and Reid 1983),
///   [A11     ]   [L11  ] [I   ] [L11^T L21^T]
///   [A21   0 ] = [L21 I] [   U] [        I  ] ,   A11 = L11 L11^T,  L21 = A21 L11^-T,  U = -L21 L21^T.
/// The panel, A11 above A21 (height x width), becomes L11 above L21; the update becomes U.
FrontOutcome factoriseFront(double* panel, int height, int width, UpdateMatrix& update, UpdatePrecision products,
                            const TaskRunner& run);

/// Sets BLAS to one thread from here on: the order of its sums depends on the number of threads.
void useOneBlasThread();

} // namespace palp
