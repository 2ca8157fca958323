#pragma once

#include <cstddef>

namespace palp {

/// Columns of right-hand sides that are solved together.
inline constexpr int batchColumns = 32;
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

/// Points of a surface, six numbers each in arrays of their own: place, and outward normal times area.
struct SurfacePoints {
  const double *x, *y, *z, *ax, *ay, *az;
  std::ptrdiff_t count;
};

/// Number of previous steps in a mixed one (batch/AndersonBatch.h).
inline constexpr int mixingDepth = 2;
/// History of an unknown, [these][8]: direction, step, motions, and for a leading one the changes of its direction.
inline constexpr int followingPast = 2 + mixingDepth, leadingPast = followingPast + mixingDepth;
/// Sums over the leading unknowns: for each change its products with those up to itself, then with the direction.
inline constexpr int mixSums = mixingDepth * (mixingDepth + 1) / 2 + mixingDepth;

/// How the steps of 8 lanes are mixed. Masks are 0 or -1.
struct LaneMix {
  int moves[8] = {};                  ///< whether the lane moves at all
  int pair[8] = {};                   ///< whether its last step and this direction give a further motion and change
  int hasMotion[mixingDepth][8] = {}; ///< whether motion j is stored, the newest first
  double gamma[mixingDepth][8] = {};
  double scale[8] = {}; ///< of its directions
};

/// Initial guess of 8 lanes for their next load increment: their present state, rest (`atRest`), or the present state
/// extrapolated by the previous increment (`ahead`). Masks are 0 or -1; `begins` is set for lanes that start one.
struct InitialGuess {
  int begins[8] = {}, atRest[8] = {}, ahead[8] = {};
};

/// Some rows of 8 lanes: directions [rows of the factor + 1][batchColumns], the index of each row in it, and the rows'
/// history, [leadingPast][8] each, pastStride apart.
struct MixedRows {
  const float* directions;
  const int* rows;
  int count;
  float* past;
  std::ptrdiff_t pastStride;
};

/// A symmetric matrix by the columns of its lower triangle, each from its diagonal on.
struct LowerTriangle {
  int size;
  const int *columns, *rows; ///< first entry of each column, rows ascending
  const double* values;
};

struct LaneKernels {
  /// Substitution through supernodes first .. last - 1 for x [rows + 1][batchColumns]: x becomes L^-1 x from the first
  /// supernode to the last (forward), or L^-T x from the last to the first (backward). Lanes whose block of 8 is not
  /// live (bit b for lanes 8 b .. 8 b + 7) may be left out.
  void (*forward)(const BlockedFactor&, int first, int last, unsigned live, float* x);
  void (*backward)(const BlockedFactor&, int first, int last, unsigned live, float* x);
  /// The same for one right side x [rows + 1].
  void (*forwardOne)(const BlockedFactor&, int first, int last, double* x);
  void (*backwardOne)(const BlockedFactor&, int first, int last, double* x);
  /// out[row * stride + lane] += sum over t of coefficients[row][t] monomials[t][lane], 8 lanes.
  void (*addPolynomials)(const double* coefficients, int terms, const double* monomials, int rows, double* out,
                         int stride);
  /// An element's part [3 count][8] of values [3 nodes of the mesh][batchColumns], for the 8 lanes that `values` begins
  /// with, and the opposite: values -= the element's forces.
  void (*gather)(const double* values, const int* nodes, int count, double* out);
  void (*subtract)(const double* forces, const int* nodes, int count, double* values);
  /// scale[lane] x[rows[component]][lane], at the same components, for 8 lanes of x [rows + 1][batchColumns].
  void (*gatherScaled)(const float* x, const int* rows, const double* scale, const int* nodes, int count, double* out);
  /// Adds the rows' directions to their history and their products to `sums` [mixSums][8].
  void (*sumMixed)(const MixedRows&, const LaneMix&, double* sums);
  /// Then the mixed steps, added to u [rows][batchColumns].
  void (*stepMixed)(const MixedRows&, const LaneMix&, double* u);
  /// Both for numbers that follow with the same gamma: directions and values [count][8], past
  /// [count][followingPast][8].
  void (*followMixed)(const double* directions, int count, const LaneMix&, float* past, double* values);
  /// Initial guess of lanes that start a load increment, values and before [rows][stride]; `before` becomes their
  /// present state, or rest.
  void (*beginLoads)(double* values, float* before, int rows, std::ptrdiff_t stride, const InitialGuess&);
  /// potential += 1/r and flux -= area . r / r^3 at each point, r from the source at three coordinates.
  void (*addPointSource)(const SurfacePoints&, const double* source, double* potential, double* flux);
  /// sums[8] = sum over k of matrix[k][8] values[k].
  void (*eightSums)(const double* matrix, const double* values, int count, double* sums);
  /// Of numbers [rows][batchColumns]: sums[lane] += their squares; to single precision, times scale[lane], row i
  /// becoming row order[i]; and back.
  void (*addSquares)(const double* x, int rows, double* sums);
  void (*narrow)(const double* x, const double* scale, const int* order, int rows, float* out);
  void (*widen)(const float* x, const double* scale, const int* order, int rows, double* out);
  /// from -= K x, both [rows][batchColumns].
  void (*subtractProduct)(const LowerTriangle& K, const double* x, double* from);
};
const LaneKernels& laneKernels();

/// Copies a column's values to another, in values [...][batchColumns / 8][count][8].
template <class T> void copyColumn(T* values, std::size_t size, int count, int from, int to) {
  constexpr int width = 8;
  const auto start = [&](int lane) { return std::size_t(lane / width) * count * width + lane % width; };
  for (std::size_t outer = 0; outer < size; outer += std::size_t(batchColumns) * count)
    for (std::size_t i = 0; i < std::size_t(count) * width; i += width)
      values[outer + start(to) + i] = values[outer + start(from) + i];
}

} // namespace palp
