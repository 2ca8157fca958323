#include "solver/linear/Front.h"

#include <cblas.h>

#include <algorithm>
#include <vector>

extern "C" void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace palp {

namespace {

constexpr int tile = frontTile;
constexpr int worthConverting = 96; // columns whose products are faster in single precision, with the conversions

int tiles(int n) {
  return (n + tile - 1) / tile;
}

bool factoriseDiagonal(double* a, int n, int stride) {
  int info = 0;
  dpotrf_("L", &n, a, &stride, &info);
  return info == 0;
}

/// target -= rows columns^T for one tile; the lower triangle alone where the tile lies on the diagonal.
void updateTile(const double* rows, int m, const double* columns, int n, int depth, int stride, double* target,
                int targetStride, double beta, bool diagonal) {
  if (diagonal) {
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, depth, -1, columns, stride, beta, target, targetStride);
    rows += n;
    target += n;
    m -= n;
  }
  if (m > 0)
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, m, n, depth, -1, rows, stride, columns, stride, beta, target,
                targetStride);
}

/// The same by products in single precision, a square at a time.
void updateTileInSingle(const float* rows, int m, const float* columns, int n, int depth, int stride, double* target,
                        int targetStride, double beta, bool diagonal) {
  UnsetArray<float> product(std::size_t(tile) * n);
  for (int first = 0; first < m; first += tile) {
    const int some = std::min(tile, m - first);
    cblas_sgemm(CblasColMajor, CblasNoTrans, CblasTrans, some, n, depth, 1, rows + first, stride, columns, stride, 0,
                product.data(), tile);
    for (int j = 0; j < n; ++j) {
      double* to = target + first + std::size_t(j) * targetStride;
      const float* from = product.data() + std::size_t(j) * tile;
      const int begin = diagonal && first == 0 ? j : 0;
      if (beta == 0)
        for (int i = begin; i < some; ++i) to[i] = -double(from[i]);
      else
        for (int i = begin; i < some; ++i) to[i] -= double(from[i]);
    }
  }
}

/// C -= L L^T for the lower trapezium C (height x width) by tiles of columns, each cut into tiles of rows; `columnOf`
/// is C's column, addressed by rows, and `strideOf` the distance to the next.
template <class ColumnOf, class StrideOf>
bool subtractProduct(const double* L, int height, int width, int depth, int stride, const ColumnOf& columnOf,
                     const StrideOf& strideOf, double beta, UpdatePrecision products, const TaskRunner& run) {
  struct Task {
    int row, rows, column, columns;
  };
  std::vector<Task> tasks;
  for (int c = 0; c < width; c += tile) {
    const int columns = std::min(tile, width - c);
    for (int r = c; r < height; r += 4 * tile) tasks.push_back({r, std::min(4 * tile, height - r), c, columns});
  }
  const double flops = double(height) * width * depth;
  if (products == UpdatePrecision::Single && depth >= worthConverting) {
    UnsetArray<float> copy(std::size_t(height) * depth);
    const bool copied = run(depth, double(height) * depth, [&](int c) {
      std::copy_n(L + std::size_t(c) * stride, height, copy.data() + std::size_t(c) * height);
    });
    return copied && run(static_cast<int>(tasks.size()), flops, [&](int t) {
             const auto [row, rows, column, columns] = tasks[t];
             updateTileInSingle(copy.data() + row, rows, copy.data() + column, columns, depth, height,
                                columnOf(column) + row, strideOf(column), beta, row == column);
           });
  }
  return run(static_cast<int>(tasks.size()), flops, [&](int t) {
    const auto [row, rows, column, columns] = tasks[t];
    updateTile(L + row, rows, L + column, columns, depth, stride, columnOf(column) + row, strideOf(column), beta,
               row == column);
  });
}

} // namespace

UpdateMatrix::UpdateMatrix(int size) : size_(size) {
  std::size_t numbers = 0;
  for (int j = 0; j < size; j += tile) numbers += std::size_t(std::min(tile, size - j)) * stride(j);
  values_.resize(numbers);
}

std::size_t UpdateMatrix::start(int j) const {
  const std::size_t block = j / tile, size = size_;
  const std::size_t before = tile * block * size - tile * tile * (block * (block - 1) / 2);
  return before + (j - block * tile) * (size - block * tile) - block * tile;
}

void UpdateMatrix::forgetBefore(int j) {
  values_.forgetFirst(j < size_ ? start(j) + j / tile * tile : values_.size());
}

// Right-looking, a tile of columns at a time: L11 of the tile by dpotrf, the rows below it by dtrsm, and what the tile
// takes from the panel's remaining columns by dsyrk and dgemm; U after the last tile.
FrontOutcome factoriseFront(double* panel, int height, int width, UpdateMatrix& update, UpdatePrecision products,
                            const TaskRunner& run) {
  for (int k = 0; k < width; k += tile) {
    const int depth = std::min(tile, width - k), below = height - k - depth;
    double* diagonal = panel + k + std::size_t(k) * height;
    if (!factoriseDiagonal(diagonal, depth, height)) return FrontOutcome::NotPositiveDefinite;
    double* L = diagonal + depth;
    const bool solved = run(tiles(below), double(below) * depth * depth, [&](int t) {
      cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, std::min(tile, below - t * tile),
                  depth, 1, diagonal, height, L + t * tile, height);
    });
    if (!solved) return FrontOutcome::Stopped;
    double* rest = L + std::size_t(depth) * height;
    if (!subtractProduct(
            L, below, width - k - depth, depth, height, [&](int c) { return rest + std::size_t(c) * height; },
            [&](int) { return height; }, 1, products, run))
      return FrontOutcome::Stopped;
  }
  if (update.size() > 0 &&
      !subtractProduct(
          panel + width, update.size(), update.size(), width, height, [&](int c) { return update.column(c); },
          [&](int c) { return update.stride(c); }, 0, products, run))
    return FrontOutcome::Stopped;
  return FrontOutcome::Done;
}

void useOneBlasThread() {
  openblas_set_num_threads(1);
}

} // namespace palp
