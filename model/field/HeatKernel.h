#pragma once

#include <Eigen/Core>

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

/// Points and weights for integrals over time of products of three such kernels: the trapezoidal rule in ln t, which
/// converges as exp(-pi^2 / step) where the integrand is analytic for Re t > 0 (L. N. Trefethen, J. A. C. Weideman,
/// SIAM Review 56, 2014, section 5).
struct HeatTimes {
  Eigen::ArrayXd time;
  Eigen::ArrayXd weight;
  double before = 0; ///< weights of all earlier times, where nothing has come as far as `nearest_mm`
  double after = 0;  ///< weights / time^1.5 of all later times, where all is even over `longest_mm`
};

/// `digits` of the integrals: 16 for closed forms to rounding.
HeatTimes heatTimes(double nearest_mm, double longest_mm, double digits);

} // namespace palp
