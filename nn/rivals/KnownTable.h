#pragma once

// Private to nn: what is known beforehand of the components of touches.

#include "nn/rivals/SplineTable.h"

#include <Eigen/Core>

#include <functional>
#include <stop_token>
#include <vector>

namespace palp {

/// Components (a row each) at scaled causes, a column each.
using KnownComponents = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& scaled)>;

/// Known components as a table of this form, which comes without coefficients: at each node the monomials that fit them
/// best on a grid of the other causes, over the ranges that these have in the samples (`scaled`, a column each). At
/// rest all strengths are 0. Throws Cancelled.
SplineTable knownTable(const SplineTable& form, const std::vector<int>& strengths, const Eigen::MatrixXd& scaled,
                       const KnownComponents& known, const std::stop_token& stop);

} // namespace palp
