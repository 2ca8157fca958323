#include "nn/linear/Lapack.h"

#include "model/base/Cancelled.h"
#include "nn/NetworkError.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

// Fortran's names; Debian ships no header for LAPACK's Fortran interface without LAPACKE.
extern "C" {
void openblas_set_num_threads(int);
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*,
            const double*, const int*, const double*, double*, const int*);
void dsyrk_(const char*, const char*, const int*, const int*, const double*, const double*, const int*, const double*,
            double*, const int*);
void dsymm_(const char*, const char*, const int*, const int*, const double*, const double*, const int*, const double*,
            const int*, const double*, double*, const int*);
void dsyr2k_(const char*, const char*, const int*, const int*, const double*, const double*, const int*, const double*,
             const int*, const double*, double*, const int*);
void dtrmm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*, const double*,
            const int*, double*, const int*);
void dtrtri_(const char*, const char*, const int*, double*, const int*, int*);
void dpstrf_(const char*, const int*, double*, const int*, int*, int*, const double*, double*, int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*, const double*,
            const int*, double*, const int*);
void dgeqp3_(const int*, const int*, double*, const int*, int*, double*, double*, const int*, int*);
void dormqr_(const char*, const char*, const int*, const int*, const int*, const double*, const int*, const double*,
             double*, const int*, double*, const int*, int*);
void dlarft_(const char*, const char*, const int*, const int*, const double*, const int*, const double*, double*,
             const int*);
void dpotrf_(const char*, const int*, double*, const int*, int*);
void dsyevd_(const char*, const char*, const int*, double*, const int*, double*, double*, const int*, int*, const int*,
             int*);
void dgesdd_(const char*, const int*, const int*, double*, const int*, double*, double*, const int*, double*,
             const int*, double*, const int*, int*, int*);
}

namespace palp::lapack {
namespace {

int size(Eigen::Index n) {
  return static_cast<int>(n);
}
int leading(Eigen::Index rows) {
  return size(std::max<Eigen::Index>(1, rows));
}

void require(int info, const char* routine) {
  if (info != 0)
    throw NetworkError(std::string(routine) + " failed (info " + std::to_string(info) +
                       "): the samples contain values that are not finite, or too large for double precision");
}

/// dgemm and its kin believe the sizes they are given: a wrong one reads beyond the matrix.
void requireSame(Eigen::Index a, Eigen::Index b, const char* what) {
  if (a != b)
    throw NetworkError(std::string(what) + ": matrices of " + std::to_string(a) + " and " + std::to_string(b) +
                       " entries do not fit together");
}

} // namespace

Eigen::MatrixXd product(const Input& a, bool transposeA, const Input& b, bool transposeB) {
  openblas_set_num_threads(1);
  const int m = size(transposeA ? a.cols() : a.rows()), k = size(transposeA ? a.rows() : a.cols());
  const int n = size(transposeB ? b.rows() : b.cols());
  requireSame(k, transposeB ? b.cols() : b.rows(), "product");
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(m, n);
  if (m == 0 || n == 0 || k == 0) return c;
  const double one = 1, zero = 0;
  const int lda = leading(a.outerStride()), ldb = leading(b.outerStride()), ldc = leading(m);
  dgemm_(transposeA ? "T" : "N", transposeB ? "T" : "N", &m, &n, &k, &one, a.data(), &lda, b.data(), &ldb, &zero,
         c.data(), &ldc);
  return c;
}

void subtractProduct(const Input& a, const Input& b, Eigen::Ref<Eigen::MatrixXd> c) {
  openblas_set_num_threads(1);
  const int m = size(a.rows()), n = size(b.rows()), k = size(a.cols());
  requireSame(k, b.cols(), "subtracted product");
  requireSame(m, c.rows(), "subtracted product");
  requireSame(n, c.cols(), "subtracted product");
  if (m == 0 || n == 0 || k == 0) return;
  const double minus = -1, one = 1;
  const int lda = leading(a.outerStride()), ldb = leading(b.outerStride()), ldc = leading(c.outerStride());
  dgemm_("N", "T", &m, &n, &k, &minus, a.data(), &lda, b.data(), &ldb, &one, c.data(), &ldc);
}

Eigen::MatrixXd gram(const Eigen::MatrixXd& a, const std::stop_token& stop) {
  openblas_set_num_threads(1);
  const int n = size(a.cols()), lda = leading(a.rows()), ldc = leading(n);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
  if (n == 0) return c;
  const double one = 1;
  for (Eigen::Index first = 0; first < a.rows(); first += kRowsAtOnce) {
    throwIfStopped(stop);
    const int k = size(std::min(kRowsAtOnce, a.rows() - first));
    dsyrk_("L", "T", &n, &k, &one, a.data() + first, &lda, &one, c.data(), &ldc);
  }
  c.triangularView<Eigen::StrictlyUpper>() = c.transpose();
  return c;
}

Eigen::MatrixXd symmetricProduct(const Input& a, const Input& b) {
  openblas_set_num_threads(1);
  const int m = size(b.rows()), n = size(b.cols());
  requireSame(a.rows(), a.cols(), "symmetric product");
  requireSame(a.cols(), m, "symmetric product");
  const int lda = leading(a.outerStride()), ldb = leading(b.outerStride()), ldc = leading(m);
  Eigen::MatrixXd c(m, n);
  if (m == 0 || n == 0) return c;
  const double one = 1, zero = 0;
  dsymm_("L", "L", &m, &n, &one, a.data(), &lda, b.data(), &ldb, &zero, c.data(), &ldc);
  return c;
}

void subtractRankTwo(const Input& u, const Input& v, Eigen::Ref<Eigen::MatrixXd> c) {
  openblas_set_num_threads(1);
  const int n = size(c.rows()), k = size(u.cols());
  for (const Eigen::Index rows : {c.cols(), u.rows(), v.rows()}) requireSame(n, rows, "subtracted rank two");
  requireSame(k, v.cols(), "subtracted rank two");
  const int ldu = leading(u.outerStride()), ldv = leading(v.outerStride()), ldc = leading(c.outerStride());
  if (n == 0 || k == 0) return;
  const double minus = -1, one = 1;
  dsyr2k_("L", "N", &n, &k, &minus, u.data(), &ldu, v.data(), &ldv, &one, c.data(), &ldc);
}

std::vector<int> semidefinitePivots(Eigen::MatrixXd& a) {
  openblas_set_num_threads(1);
  requireSame(a.rows(), a.cols(), "pivots");
  const int n = size(a.rows());
  std::vector<int> pivots(static_cast<std::size_t>(n));
  if (n == 0) return pivots;
  int rank = 0, info = 0;
  const double usual = -1; // n eps max a_ii
  Eigen::VectorXd work(2 * n);
  dpstrf_("L", &n, a.data(), &n, pivots.data(), &rank, &usual, work.data(), &info);
  pivots.resize(static_cast<std::size_t>(rank));
  for (int& pivot : pivots) --pivot;
  return pivots;
}

PivotedQr::PivotedQr(Eigen::MatrixXd a, std::size_t fixed)
    : qr_(std::move(a)), tau_(std::min(qr_.rows(), qr_.cols())), pivots_(static_cast<std::size_t>(qr_.cols()), 0) {
  if (tau_.size() == 0) return;
  openblas_set_num_threads(1);
  std::fill_n(pivots_.begin(), fixed, 1); // dgeqp3 leaves these where they are
  const int m = size(qr_.rows()), n = size(qr_.cols()), query = -1;
  int info = 0;
  double best = 0;
  dgeqp3_(&m, &n, qr_.data(), &m, pivots_.data(), tau_.data(), &best, &query, &info);
  const int workSize = static_cast<int>(best);
  Eigen::VectorXd work(workSize);
  dgeqp3_(&m, &n, qr_.data(), &m, pivots_.data(), tau_.data(), work.data(), &workSize, &info);
  require(info, "the pivoted QR factorisation");
}

Eigen::Index PivotedQr::rank(double rcond) const {
  if (tau_.size() == 0) return 0;
  const Eigen::VectorXd diagonal = qr_.diagonal().cwiseAbs();
  const double least = rcond * diagonal.maxCoeff();
  Eigen::Index rank = 0;
  while (rank < diagonal.size() && diagonal(rank) > least) ++rank;
  return rank;
}

double PivotedQr::condition() const {
  if (tau_.size() == 0) return 1;
  const Eigen::VectorXd diagonal = qr_.diagonal().cwiseAbs();
  const double least = diagonal.minCoeff();
  return least > 0 ? diagonal.maxCoeff() / least : std::numeric_limits<double>::infinity();
}

PivotedQr::BlockReflector PivotedQr::blockReflector() const {
  const Eigen::Index count = tau_.size();
  BlockReflector result{qr_.leftCols(count).triangularView<Eigen::UnitLower>(), Eigen::MatrixXd::Zero(count, count)};
  const int n = size(qr_.rows()), k = size(count), ldv = leading(n), ldt = leading(k);
  if (k > 0) dlarft_("F", "C", &n, &k, result.v.data(), &ldv, tau_.data(), result.t.data(), &ldt);
  return result;
}

Eigen::MatrixXd PivotedQr::applyQTransposed(Eigen::MatrixXd b) const {
  const int m = size(b.rows()), n = size(b.cols()), k = size(tau_.size()), lda = leading(qr_.rows()), query = -1;
  requireSame(qr_.rows(), m, "product with Q");
  if (m == 0 || n == 0 || k == 0) return b;
  openblas_set_num_threads(1);
  int info = 0;
  double best = 0;
  dormqr_("L", "T", &m, &n, &k, qr_.data(), &lda, tau_.data(), b.data(), &m, &best, &query, &info);
  const int workSize = static_cast<int>(best);
  Eigen::VectorXd work(workSize);
  dormqr_("L", "T", &m, &n, &k, qr_.data(), &lda, tau_.data(), b.data(), &m, work.data(), &workSize, &info);
  require(info, "the product with Q");
  return b;
}

Eigen::MatrixXd PivotedQr::solveRotated(const Eigen::Ref<const Eigen::MatrixXd>& qTransposedB,
                                        Eigen::Index rank) const {
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(qr_.cols(), qTransposedB.cols());
  if (rank == 0) return x;
  const Eigen::MatrixXd leadingPart =
      qr_.topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd(qTransposedB.topRows(rank)));
  for (Eigen::Index k = 0; k < rank; ++k) x.row(pivots_[static_cast<std::size_t>(k)] - 1) = leadingPart.row(k);
  return x;
}

bool choleskyInPlace(Eigen::Ref<Eigen::MatrixXd> a) {
  openblas_set_num_threads(1);
  requireSame(a.rows(), a.cols(), "Cholesky's factor");
  const int n = size(a.rows()), lda = leading(a.outerStride());
  int info = 0;
  if (n > 0) dpotrf_("L", &n, a.data(), &lda, &info);
  a.triangularView<Eigen::StrictlyUpper>().setZero();
  return info == 0 && a.allFinite();
}

Eigen::MatrixXd solveLower(const Input& l, Eigen::MatrixXd b, bool transposed) {
  openblas_set_num_threads(1);
  requireSame(l.rows(), l.cols(), "triangular solution");
  requireSame(l.cols(), b.rows(), "triangular solution");
  const int n = size(b.rows()), m = size(b.cols()), lda = leading(l.outerStride()), ldb = leading(n);
  const double one = 1;
  if (n > 0 && m > 0) dtrsm_("L", "L", transposed ? "T" : "N", "N", &n, &m, &one, l.data(), &lda, b.data(), &ldb);
  return b;
}

void invertLowerInPlace(Eigen::Ref<Eigen::MatrixXd> l) {
  constexpr int smallest = 64;
  openblas_set_num_threads(1);
  const int n = size(l.rows()), lda = leading(l.outerStride());
  if (n <= smallest) {
    int info = 0;
    if (n > 0) dtrtri_("L", "N", &n, l.data(), &lda, &info);
    return require(info, "the inverse of a triangle");
  }
  // [A 0; B C]^-1 = [A^-1 0; -C^-1 B A^-1 C^-1], which lives in products: dtrtri takes three times as long.
  const int half = n / 2, rest = n - half;
  const double minus = -1, one = 1;
  double* b = l.data() + half;
  const double* c = b + static_cast<std::ptrdiff_t>(half) * lda;
  invertLowerInPlace(l.topLeftCorner(half, half));
  invertLowerInPlace(l.bottomRightCorner(rest, rest));
  dtrmm_("R", "L", "N", "N", &rest, &half, &minus, l.data(), &lda, b, &lda);
  dtrmm_("L", "L", "N", "N", &rest, &half, &one, c, &lda, b, &lda);
}

SymmetricEigen symmetricEigen(Eigen::MatrixXd a) {
  openblas_set_num_threads(1);
  const int n = size(a.rows()), query = -1;
  SymmetricEigen result{Eigen::VectorXd(n), {}};
  if (n == 0) return result;
  int info = 0, bestInteger = 0;
  double best = 0;
  dsyevd_("V", "L", &n, a.data(), &n, result.values.data(), &best, &query, &bestInteger, &query, &info);
  const int workSize = static_cast<int>(best);
  Eigen::VectorXd work(workSize);
  std::vector<int> integers(static_cast<std::size_t>(bestInteger));
  dsyevd_("V", "L", &n, a.data(), &n, result.values.data(), work.data(), &workSize, integers.data(), &bestInteger,
          &info);
  require(info, "the eigen-decomposition");
  result.vectors = std::move(a);
  return result;
}

ThinSvd thinSvd(Eigen::MatrixXd a) {
  openblas_set_num_threads(1);
  const int m = size(a.rows()), n = size(a.cols()), k = std::min(m, n), query = -1;
  ThinSvd result{Eigen::MatrixXd(m, k), Eigen::VectorXd(k), Eigen::MatrixXd(k, n)};
  if (k == 0) return result;
  std::vector<int> integers(static_cast<std::size_t>(8 * k));
  int info = 0;
  double best = 0;
  const auto decompose = [&](double* work, const int* workSize) {
    dgesdd_("S", &m, &n, a.data(), &m, result.values.data(), result.u.data(), &m, result.vTransposed.data(), &k, work,
            workSize, integers.data(), &info);
    require(info, "the singular value decomposition");
  };
  decompose(&best, &query);
  const int workSize = static_cast<int>(best);
  Eigen::VectorXd work(workSize);
  decompose(work.data(), &workSize);
  return result;
}

ThinSvd svdOfGram(const Eigen::MatrixXd& a, const std::stop_token& stop) {
  Eigen::MatrixXd squared = gram(a, stop);
  throwIfStopped(stop);
  const SymmetricEigen eigen = symmetricEigen(std::move(squared));
  throwIfStopped(stop);
  const Eigen::Index all = eigen.values.size();
  Eigen::Index kept = 0;
  while (kept < std::min(all, a.rows()) && eigen.values(all - 1 - kept) > 1e-14 * eigen.values(all - 1)) ++kept;
  ThinSvd result;
  result.values = eigen.values.tail(kept).cwiseSqrt().reverse();
  result.vTransposed = eigen.vectors.rightCols(kept).rowwise().reverse().transpose();
  const Eigen::MatrixXd columns = result.vTransposed.transpose() * result.values.cwiseInverse().asDiagonal();
  result.u.resize(a.rows(), kept);
  for (Eigen::Index first = 0; first < a.rows(); first += kRowsAtOnce) {
    throwIfStopped(stop);
    const Eigen::Index rows = std::min(kRowsAtOnce, a.rows() - first);
    result.u.middleRows(first, rows) = product(a.middleRows(first, rows), false, columns, false);
  }
  return result;
}

} // namespace palp::lapack
