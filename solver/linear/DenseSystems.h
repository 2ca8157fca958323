#pragma once

#include <Eigen/Core>

namespace palp {

/// Small full matrices by OpenBLAS's LAPACK on one thread.

/// The lower triangle of L becomes that of (L L^T)^-1.
void invertFromCholesky(Eigen::MatrixXd& lower);

/// Solves A x = b in place by LU with row pivots; A is overwritten. False: A is singular.
[[nodiscard]] bool solveDense(Eigen::MatrixXd& matrix, Eigen::VectorXd& rightSide);

} // namespace palp
