#pragma once

#include <Eigen/Eigenvalues>

#include <limits>

namespace palp {

/// Diagonal of the inverse of a symmetric matrix, as of an information matrix the variances; infinite where the matrix
/// is singular to rounding or not finite.
template <class Matrix> Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> inverseDiagonal(const Matrix& a) {
  using Vector = Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1>;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(a);
  if (!(eigen.eigenvalues().minCoeff() > 1e-14 * eigen.eigenvalues().maxCoeff()))
    return Vector::Constant(a.rows(), std::numeric_limits<double>::infinity());
  return eigen.eigenvectors().cwiseAbs2() * eigen.eigenvalues().cwiseInverse();
}

} // namespace palp
