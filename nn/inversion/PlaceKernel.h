#pragma once

// Private to nn: the factors of the covariance of touches.

#include "nn/inversion/SplineTable.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// Exponents (inputs x terms) of all monomials of the inputs `others` up to a degree, one of `amplitudes` or more in
/// each (no amplitudes: any); the lowest degrees first.
Eigen::MatrixXi placeMonomials(Eigen::Index inputs, const std::vector<Eigen::Index>& others,
                               const std::vector<int>& amplitudes, int degree);

/// The monomials of a table at inputs, a column each, times this power of `decay` each: its degree less `least`.
Eigen::MatrixXd monomialsOf(const SplineTable& form, const Eigen::MatrixXd& inputs, double decay, int least);

/// Coordinates of a node of a table; 0 along an axis without positions.
Eigen::Vector2d nodeOf(const SplineTable& form, int x, int y);

/// exp(-|a - b|^2 / (2 width^2)) of columns.
Eigen::MatrixXd gaussians(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double width);

} // namespace palp
