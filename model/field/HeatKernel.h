#pragma once

#include "model/field/GaussLegendre.h"

namespace palp {

/// A kernel and its first two derivatives by the distance s.
struct KernelJet {
  double value = 0;
  double slope = 0;
  double curvature = 0;
};

/// Heat kernel theta(s, t) on a circle of circumference 2 L, of which the one of a rod 0..L with insulated ends is
/// made: k(a, b) = theta(a - b) + theta(a + b). Images for t < L^2 / pi and cosines above: seven or three terms give
/// 1e-16 (Jacobi's imaginary transformation of the theta function). s within -2 L .. 2 L.
KernelJet circleKernel(double s, double time, double length);

/// Points and weights for integrals over time of products of three such kernels, by Gauss's rule in ln t.
struct HeatTimes {
  Eigen::ArrayXd time;
  Eigen::ArrayXd weight;
  double first = 0; ///< before it nothing has come as far as `nearest_mm`
  double last = 0;  ///< after it all is even over `longest_mm`
};

/// With 14 points a panel the integrals are good to 1e-16, with 7 to 1e-8.
HeatTimes heatTimes(double nearest_mm, double longest_mm, int pointsAPanel);

} // namespace palp
