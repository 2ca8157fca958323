#pragma once

#include <Eigen/Core>

namespace palp {

/// Points in [-1, 1] and their weights.
struct QuadratureRule {
  Eigen::ArrayXd points;
  Eigen::ArrayXd weights;
};

/// Gauss's rule of `count` points, exact for polynomials of degree 2 count - 1 (Abramowitz and Stegun, 25.4.29).
QuadratureRule gaussLegendre(int count);

/// Gauss's rule on each of the intervals between edges (ascending), one after the other.
QuadratureRule gaussOnPanels(const Eigen::Ref<const Eigen::ArrayXd>& edges, int pointsAPanel);

} // namespace palp
