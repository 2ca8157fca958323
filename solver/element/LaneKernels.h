#pragma once

#include <cstddef>

namespace palp {

/// Loads that are iterated together: one a lane.
inline constexpr int batchLanes = 32;
inline constexpr int factorBlockRows = 8;

/// A Cholesky factor in single precision: it only preconditions iterations whose residuals are in double. Each
/// supernode's panel is cut into blocks of 8 rows, [column][8]: first the blocks of its own rows (columns up to the
/// block's diagonal, which holds inverses), then the rows below, filled up with zeros.
struct BlockedFactor {
  int count;                ///< supernodes
  const int* first;         ///< first row of each supernode
  const std::size_t* start; ///< of each supernode in values
  const int* blockStart;    ///< first block of the rows below each supernode
  const int* rows;          ///< rows of the factor in those blocks; one past the last for the filling
  const float* values;
};

struct LaneKernels {
  /// Substitution through supernodes first .. last - 1 for x [rows + 1][batchLanes]: x becomes L^-1 x from the first
  /// supernode to the last (forward), or L^-T x from the last to the first (backward).
  void (*forward)(const BlockedFactor&, int first, int last, float* x);
  void (*backward)(const BlockedFactor&, int first, int last, float* x);
  /// The same for one right side x [rows + 1].
  void (*forwardOne)(const BlockedFactor&, int first, int last, double* x);
  void (*backwardOne)(const BlockedFactor&, int first, int last, double* x);
  /// out[row * stride + lane] += sum over t of coefficients[row][t] monomials[t][lane], 8 lanes.
  void (*addPolynomials)(const double* coefficients, int terms, const double* monomials, int rows, double* out,
                         int stride);
};
const LaneKernels& laneKernels();

} // namespace palp
