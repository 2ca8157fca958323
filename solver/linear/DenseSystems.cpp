#include "solver/linear/DenseSystems.h"

#include "solver/linear/Front.h"

#include <cblas.h>

#include <algorithm>
#include <cassert>
#include <vector>

extern "C" void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
extern "C" void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);
extern "C" void dgetrs_(const char* transposed, const int* n, const int* columns, const double* a, const int* lda,
                        const int* pivots, double* b, const int* ldb, int* info);
extern "C" void dlaswp_(const int* columns, double* a, const int* lda, const int* first, const int* last,
                        const int* pivots, const int* step);

namespace palp {

namespace {

constexpr int kWholeBelow = 768; // rows that take less than 0.1 s
constexpr int kColumnsAtOnce = 192;

/// As dgetrf, from the left to the right. Returns false if singular or cancelled.
bool factoriseByPanels(double* a, int n, std::vector<int>& pivots, const std::stop_token& stop) {
  const auto at = [&](int row, int column) { return a + std::size_t(column) * std::size_t(n) + row; };
  const int one = 1;
  for (int k = 0; k < n; k += kColumnsAtOnce) {
    const int width = std::min(kColumnsAtOnce, n - k), below = n - k, rest = n - k - width;
    int info = 0;
    dgetrf_(&below, &width, at(k, k), &n, pivots.data() + k, &info);
    if (info != 0) return false;
    const int first = k + 1, last = k + width;
    for (int i = k; i < last; ++i) pivots[static_cast<std::size_t>(i)] += k;
    dlaswp_(&k, a, &n, &first, &last, pivots.data(), &one);
    for (int c = last; c < n; c += kColumnsAtOnce) {
      if (stop.stop_requested()) return false;
      const int columns = std::min(kColumnsAtOnce, n - c);
      dlaswp_(&columns, at(0, c), &n, &first, &last, pivots.data(), &one);
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, width, columns, 1, at(k, k), n,
                  at(k, c), n);
      if (rest > 0)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rest, columns, width, -1, at(last, k), n, at(k, c), n, 1,
                    at(last, c), n);
    }
  }
  return true;
}

/// L becomes M = L^-1, and M^T M.
bool invertByPanels(Eigen::MatrixXd& lower, const std::stop_token& stop) {
  const auto n = static_cast<int>(lower.rows());
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
  const auto in = [n](Eigen::MatrixXd& A, int row, int column) {
    return A.data() + std::size_t(column) * std::size_t(n) + row;
  };
  for (int c = 0; c < n; c += kColumnsAtOnce) {
    const int columns = std::min(kColumnsAtOnce, n - c);
    for (int r = c; r < n; r += kColumnsAtOnce) {
      if (stop.stop_requested()) return false;
      const int rows = std::min(kColumnsAtOnce, n - r), below = n - r - rows;
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, rows, columns, 1, in(lower, r, r),
                  n, in(M, r, c), n);
      if (below > 0)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, below, columns, rows, -1, in(lower, r + rows, r), n,
                    in(M, r, c), n, 1, in(M, r + rows, c), n);
    }
  }
  for (int c = 0; c < n; c += kColumnsAtOnce)
    for (int r = c; r < n; r += kColumnsAtOnce) {
      if (stop.stop_requested()) return false;
      const int columns = std::min(kColumnsAtOnce, n - c), rows = std::min(kColumnsAtOnce, n - r);
      cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, rows, columns, n - r, 1, in(M, r, r), n, in(M, r, c), n, 0,
                  in(lower, r, c), n);
    }
  return true;
}

} // namespace

bool invertFromCholesky(Eigen::MatrixXd& lower, const std::stop_token& stop) {
  assert(lower.rows() == lower.cols() && "a square factor");
  useOneBlasThread();
  const auto n = static_cast<int>(lower.rows());
  if (n >= kWholeBelow) return invertByPanels(lower, stop);
  int info = 0;
  if (n > 0) dpotri_("L", &n, lower.data(), &n, &info);
  return true;
}

bool solveDense(Eigen::MatrixXd& matrix, Eigen::VectorXd& rightSide, const std::stop_token& stop) {
  assert(matrix.rows() == matrix.cols() && rightSide.size() == matrix.rows() && "a square system");
  useOneBlasThread();
  const auto n = static_cast<int>(matrix.rows());
  if (n == 0) return true;
  const int one = 1;
  int info = 0;
  std::vector<int> pivots(static_cast<std::size_t>(n));
  if (n >= kWholeBelow) {
    if (!factoriseByPanels(matrix.data(), n, pivots, stop)) return false;
  } else {
    dgetrf_(&n, &n, matrix.data(), &n, pivots.data(), &info);
    if (info != 0) return false;
  }
  dgetrs_("N", &n, &one, matrix.data(), &n, pivots.data(), rightSide.data(), &n, &info);
  return rightSide.allFinite();
}

} // namespace palp
