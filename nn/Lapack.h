#pragma once

// Private to nn: the few LAPACK and BLAS routines it uses, in Eigen's types. Always one BLAS thread, so that results do
// not depend on the number of cores.

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp::lapack {

/// op(a) op(b) by dgemm.
Eigen::MatrixXd product(const Eigen::MatrixXd& a, bool transposeA, const Eigen::MatrixXd& b, bool transposeB);
/// a^T a by dsyrk, both triangles.
Eigen::MatrixXd gram(const Eigen::MatrixXd& a);

/// A P = Q R with column pivoting (dgeqp3).
class PivotedQr {
public:
  explicit PivotedQr(Eigen::MatrixXd a);
  [[nodiscard]] Eigen::Index rows() const { return qr_.rows(); }
  /// Number of diagonal entries of R above rcond times the first.
  [[nodiscard]] Eigen::Index rank(double rcond) const;
  /// |R_11 / R_kk|, k the smaller size: an estimate of the condition; infinite where R_kk is 0.
  [[nodiscard]] double condition() const;
  /// Q^T b; Q is rows x rows.
  [[nodiscard]] Eigen::MatrixXd applyQTransposed(Eigen::MatrixXd b) const;
  /// V and T of Q = I - V T V^T (dlarft): for few columns and wide b, products with them are much faster than applyQ.
  struct BlockReflector {
    Eigen::MatrixXd v, t;
  };
  [[nodiscard]] BlockReflector blockReflector() const;
  /// Basic least-squares solution with the first `rank` pivots from Q^T b; other unknowns are 0.
  [[nodiscard]] Eigen::MatrixXd solveRotated(const Eigen::Ref<const Eigen::MatrixXd>& qTransposedB,
                                             Eigen::Index rank) const;
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b, Eigen::Index rank) const {
    return solveRotated(applyQTransposed(b), rank);
  }

private:
  Eigen::MatrixXd qr_;
  Eigen::VectorXd tau_;
  std::vector<int> pivots_; ///< from 1
};

/// Lower Cholesky factor in place (upper triangle set to 0); false where the matrix is not positive definite.
bool choleskyInPlace(Eigen::MatrixXd& a);
/// l^-1 b and l^-T b for a lower factor.
Eigen::MatrixXd solveLower(const Eigen::MatrixXd& l, Eigen::MatrixXd b, bool transposed);

/// a = V diag(values) V^T, values ascending (dsyevd).
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetricEigen(Eigen::MatrixXd a);

/// a = U diag(values) V^T, thin, values descending (dgesdd).
struct ThinSvd {
  Eigen::MatrixXd u;
  Eigen::VectorXd values;
  Eigen::MatrixXd vTransposed;
};
ThinSvd thinSvd(Eigen::MatrixXd a);
/// The same through the eigenvalues of a^T a: much faster for many rows, but singular values below 1e-7 of the largest
/// are left out. For regressors with noise, where they carry nothing. Throws Cancelled between its parts.
ThinSvd svdOfGram(const Eigen::MatrixXd& a, const std::stop_token& stop = {});

} // namespace palp::lapack
