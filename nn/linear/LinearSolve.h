#pragma once

// Private to nn.

#include "nn/RbfTrainer.h"

#include <Eigen/Core>

#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Solution of a linear system or of least squares, with what is known about its trustworthiness.
struct LinearSolution {
  Eigen::MatrixXd x; ///< unknowns x right sides
  double ridge = 0;  ///< that was used
  double condition = 0;
  int rank = 0;
  std::vector<std::string> warnings;
};

/// (a + ridge I) x = b for a symmetric, positive semi-definite a, of which the lower triangle is read. Throws Cancelled
/// between its steps.
LinearSolution solveSymmetric(Eigen::MatrixXd a, const Eigen::MatrixXd& b, LeastSquaresMethod method, double ridge,
                              double rcond, const std::stop_token& stop = {});

/// min |a x - b|^2 + ridge |x|^2. Throws Cancelled between blocks of rows.
LinearSolution solveLeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, LeastSquaresMethod method,
                                 double ridge, double rcond, double forgetting, const std::stop_token& stop = {});

/// The smallest ridge that double precision can carry on a symmetric matrix whose largest eigenvalue is about `size`.
double smallestRidge(double size);

} // namespace palp
