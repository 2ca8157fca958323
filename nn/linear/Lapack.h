#pragma once

// Private to nn: the few LAPACK and BLAS routines it uses, in Eigen's types. Always one BLAS thread, so that results do
// not depend on the number of cores. Sizes that do not fit together throw NetworkError.

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp::lapack {

using Input = Eigen::Ref<const Eigen::MatrixXd>;

/// Rows of a tall matrix between two looks at the stop token: some 20 ms of work.
inline constexpr Eigen::Index kRowsAtOnce = 1024;

/// op(a) op(b) by dgemm.
Eigen::MatrixXd product(const Input& a, bool transposeA, const Input& b, bool transposeB);
/// c -= a b^T.
void subtractProduct(const Input& a, const Input& b, Eigen::Ref<Eigen::MatrixXd> c);
/// a^T a by dsyrk, both triangles. Throws Cancelled between blocks of rows.
Eigen::MatrixXd gram(const Eigen::MatrixXd& a, const std::stop_token& stop = {});
/// a b for a symmetric a, of which the lower triangle is read.
Eigen::MatrixXd symmetricProduct(const Input& a, const Input& b);
/// c -= u v^T + v u^T in the lower triangle of c.
void subtractRankTwo(const Input& u, const Input& v, Eigen::Ref<Eigen::MatrixXd> c);

/// Pivots of Cholesky's factorisation with diagonal pivoting (dpstrf) of a semidefinite matrix, of which the lower
/// triangle is read and overwritten: as many as there are above rounding.
std::vector<int> semidefinitePivots(Eigen::MatrixXd& a);

/// A P = Q R with column pivoting (dgeqp3).
class PivotedQr {
public:
  /// The first `fixed` columns stay where they are (three times as fast where those are nearly all), the others are
  /// taken by their norms.
  explicit PivotedQr(Eigen::MatrixXd a, std::size_t fixed = 0);
  [[nodiscard]] Eigen::Index rows() const { return qr_.rows(); }
  /// Number of leading diagonal entries of R above rcond times the largest.
  [[nodiscard]] Eigen::Index rank(double rcond) const;
  /// Largest over smallest |R_kk|: an estimate of the condition; infinite where one is 0.
  [[nodiscard]] double condition() const;
  /// R, columns x columns, for no fewer rows than columns.
  [[nodiscard]] Eigen::MatrixXd r() const { return qr_.topRows(qr_.cols()).triangularView<Eigen::Upper>(); }
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
bool choleskyInPlace(Eigen::Ref<Eigen::MatrixXd> a);
/// l^-1 b and l^-T b for a lower factor.
Eigen::MatrixXd solveLower(const Input& l, Eigen::MatrixXd b, bool transposed);

/// l^-1 in place of a lower factor; the upper triangle is left as it is.
void invertLowerInPlace(Eigen::Ref<Eigen::MatrixXd> l);

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
