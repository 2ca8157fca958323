#pragma once

// Private to nn: what the covariance of touches is made of.

#include <Eigen/Core>

#include <vector>

namespace palp {

/// Exponents (inputs x terms) of all monomials of the inputs `others` up to a degree, one of `strengths` or more in
/// each (no strengths: any); the lowest degrees first.
Eigen::MatrixXi placeMonomials(Eigen::Index inputs, const std::vector<Eigen::Index>& others,
                               const std::vector<int>& strengths, int degree);

/// exp(-|a - b|^2 / (2 width^2)) of columns.
Eigen::MatrixXd gaussians(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double width);

} // namespace palp
