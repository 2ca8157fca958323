#include "nn/Lapack.h"

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
    throw NetworkError(std::string(routine) + " found no answer (info " + std::to_string(info) +
                       "): the samples hold values that are no numbers, or are too large for double precision");
}

} // namespace

Eigen::MatrixXd product(const Eigen::MatrixXd& a, bool transposeA, const Eigen::MatrixXd& b, bool transposeB) {
  openblas_set_num_threads(1);
  const int m = size(transposeA ? a.cols() : a.rows()), k = size(transposeA ? a.rows() : a.cols());
  const int n = size(transposeB ? b.rows() : b.cols());
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(m, n);
  if (m == 0 || n == 0 || k == 0) return c;
  const double one = 1, zero = 0;
  const int lda = leading(a.rows()), ldb = leading(b.rows()), ldc = leading(m);
  dgemm_(transposeA ? "T" : "N", transposeB ? "T" : "N", &m, &n, &k, &one, a.data(), &lda, b.data(), &ldb, &zero,
         c.data(), &ldc);
  return c;
}

Eigen::MatrixXd gram(const Eigen::MatrixXd& a) {
  openblas_set_num_threads(1);
  const int n = size(a.cols()), k = size(a.rows()), lda = leading(a.rows()), ldc = leading(n);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
  if (n == 0 || k == 0) return c;
  const double one = 1, zero = 0;
  dsyrk_("L", "T", &n, &k, &one, a.data(), &lda, &zero, c.data(), &ldc);
  c.triangularView<Eigen::StrictlyUpper>() = c.transpose();
  return c;
}

PivotedQr::PivotedQr(Eigen::MatrixXd a)
    : qr_(std::move(a)), tau_(std::min(qr_.rows(), qr_.cols())), pivots_(static_cast<std::size_t>(qr_.cols()), 0) {
  if (tau_.size() == 0) return;
  openblas_set_num_threads(1);
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
  Eigen::Index rank = 0;
  while (rank < tau_.size() && std::abs(qr_(rank, rank)) > rcond * std::abs(qr_(0, 0))) ++rank;
  return rank;
}

double PivotedQr::condition() const {
  if (tau_.size() == 0) return 1;
  const double last = std::abs(qr_(tau_.size() - 1, tau_.size() - 1));
  return last > 0 ? std::abs(qr_(0, 0)) / last : std::numeric_limits<double>::infinity();
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

bool choleskyInPlace(Eigen::MatrixXd& a) {
  openblas_set_num_threads(1);
  const int n = size(a.rows()), lda = leading(n);
  int info = 0;
  if (n > 0) dpotrf_("L", &n, a.data(), &lda, &info);
  a.triangularView<Eigen::StrictlyUpper>().setZero();
  return info == 0 && a.allFinite();
}

Eigen::MatrixXd solveLower(const Eigen::MatrixXd& l, Eigen::MatrixXd b, bool transposed) {
  openblas_set_num_threads(1);
  const int n = size(b.rows()), m = size(b.cols()), lda = leading(n);
  const double one = 1;
  if (n > 0 && m > 0) dtrsm_("L", "L", transposed ? "T" : "N", "N", &n, &m, &one, l.data(), &lda, b.data(), &lda);
  return b;
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
  Eigen::MatrixXd squared = gram(a);
  stopIfAsked(stop);
  const SymmetricEigen eigen = symmetricEigen(std::move(squared));
  stopIfAsked(stop);
  const Eigen::Index all = eigen.values.size();
  Eigen::Index kept = 0;
  while (kept < std::min(all, a.rows()) && eigen.values(all - 1 - kept) > 1e-14 * eigen.values(all - 1)) ++kept;
  ThinSvd result;
  result.values = eigen.values.tail(kept).cwiseSqrt().reverse();
  result.vTransposed = eigen.vectors.rightCols(kept).rowwise().reverse().transpose();
  result.u = product(a, false, result.vTransposed, true) * result.values.cwiseInverse().asDiagonal();
  return result;
}

} // namespace palp::lapack
