#pragma once

// Private to nn: what the covariance of touches is made of.

#include "nn/rivals/SplineTable.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// Exponents (inputs x terms) of all monomials of the inputs `others` up to a degree, one of `strengths` or more in
/// each (no strengths: any); the lowest degrees first.
Eigen::MatrixXi placeMonomials(Eigen::Index inputs, const std::vector<Eigen::Index>& others,
                               const std::vector<int>& strengths, int degree);

/// The monomials of a table at inputs, a column each, times this power of `reach` each: its degree less `least`.
Eigen::MatrixXd monomialsOf(const SplineTable& form, const Eigen::MatrixXd& inputs, double reach, int least);

/// Places of a node of a table; 0 where there is none.
Eigen::Vector2d nodeOf(const SplineTable& form, int x, int y);

/// exp(-|a - b|^2 / (2 width^2)) of columns.
Eigen::MatrixXd gaussians(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double width);

} // namespace palp
