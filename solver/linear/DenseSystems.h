#pragma once

#include <Eigen/Core>

#include <stop_token>

namespace palp {

/// Full matrices by OpenBLAS on one thread. Large ones (a plane presses on thousands of nodes) are worked through in
/// blocks of columns, between which a stop request is honoured.

/// The lower triangle of L becomes that of (L L^T)^-1. False: stopped.
[[nodiscard]] bool invertFromCholesky(Eigen::MatrixXd& lower, const std::stop_token& stop = {});

/// Solves A x = b in place by LU with row pivots; A is overwritten. False: A is singular, or stopped.
[[nodiscard]] bool solveDense(Eigen::MatrixXd& matrix, Eigen::VectorXd& rightSide, const std::stop_token& stop = {});

} // namespace palp
