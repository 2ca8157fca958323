#pragma once

// Private to nn: the prior mean of the components of touches.

#include "nn/inversion/SplineTable.h"

#include <Eigen/Core>

#include <functional>
#include <stop_token>
#include <vector>

namespace palp {

/// Components (a row each) at scaled parameters, a column each.
using PriorComponents = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& scaled)>;

/// Prior components as a table of this form (`form` has no coefficients): at each node the monomials that fit them best
/// on a grid of the other parameters, over the ranges that these have in the samples (`scaled`, a column each). At rest
/// all amplitudes are 0. Throws Cancelled.
SplineTable priorTable(const SplineTable& form, const std::vector<int>& amplitudes, const Eigen::MatrixXd& scaled,
                       const PriorComponents& prior, const std::stop_token& stop);

} // namespace palp
