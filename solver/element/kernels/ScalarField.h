#pragma once

#include "solver/element/LaneKernels.h"

// Plain loops: the compiler makes packs of them.

namespace palp::PALP_KERNEL {

PALP_INLINE void addSource(const SurfacePoints& p, const double* source, double* __restrict__ potential,
                           double* __restrict__ flux) {
  const double cx = source[0], cy = source[1], cz = source[2];
  for (std::ptrdiff_t k = 0; k < p.count; ++k) {
    const double x = p.x[k] - cx, y = p.y[k] - cy, z = p.z[k] - cz;
    const double inverse = 1 / __builtin_sqrt(x * x + y * y + z * z);
    potential[k] += inverse;
    flux[k] -= (x * p.ax[k] + y * p.ay[k] + z * p.az[k]) * (inverse * inverse * inverse);
  }
}

/// sums[row] = sum over k of matrix[k][row] values[k], 8 rows.
PALP_INLINE void sumsOfEight(const double* matrix, const double* values, int count, double* sums) {
  Pack partial[8 / packSize] = {};
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < 8 / packSize; ++i) partial[i] += load(matrix + 8 * k + i * packSize) * values[k];
  for (int i = 0; i < 8 / packSize; ++i) store(sums + i * packSize, partial[i]);
}

PALP_INLINE void squaresOfLanes(const double* x, int rows, double* __restrict__ sums) {
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < batchColumns; ++k)
      sums[k] += x[std::size_t(i) * batchColumns + k] * x[std::size_t(i) * batchColumns + k];
}

PALP_INLINE void scaledFloats(const double* __restrict__ x, const double* __restrict__ scale, const int* order,
                              int rows, float* __restrict__ out) {
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < batchColumns; ++k)
      out[std::size_t(order[i]) * batchColumns + k] = float(x[std::size_t(i) * batchColumns + k] * scale[k]);
}

PALP_INLINE void scaledDoubles(const float* __restrict__ x, const double* __restrict__ scale, const int* order,
                               int rows, double* __restrict__ out) {
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < batchColumns; ++k)
      out[std::size_t(i) * batchColumns + k] = scale[k] * double(x[std::size_t(order[i]) * batchColumns + k]);
}

/// from -= K x.
PALP_INLINE void subtractOfLanes(const LowerTriangle& K, const double* x, double* from) {
  constexpr int packs = batchColumns / packSize;
  for (int j = 0; j < K.size; ++j) {
    const double* own = x + std::size_t(j) * batchColumns;
    double* out = from + std::size_t(j) * batchColumns;
    for (int p = 0; p < packs; p += packs < 4 ? packs : 4) { // as many as there are registers for
      constexpr int some = packs < 4 ? packs : 4;
      Pack at[some], sum[some];
      const int diagonal = K.columns[j];
      for (int i = 0; i < some; ++i) {
        at[i] = load(own + (p + i) * packSize);
        sum[i] = load(out + (p + i) * packSize) - K.values[diagonal] * at[i];
      }
      for (int k = diagonal + 1; k < K.columns[j + 1]; ++k) {
        const std::size_t row = std::size_t(K.rows[k]) * batchColumns + std::size_t(p) * packSize;
        const double value = K.values[k];
        for (int i = 0; i < some; ++i) {
          sum[i] -= value * load(x + row + i * packSize);
          store(from + row + i * packSize, load(from + row + i * packSize) - value * at[i]);
        }
      }
      for (int i = 0; i < some; ++i) store(out + (p + i) * packSize, sum[i]);
    }
  }
}

} // namespace palp::PALP_KERNEL
