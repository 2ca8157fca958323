#include "solver/contact/ContactDisc.h"

#include <array>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

/// Gauss's rule of five points on (0, 1).
constexpr std::array ringNodes{0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332};
constexpr std::array ringWeights{0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                                 0.118463442528095};
constexpr int anglesARing = contactDiscPoints / static_cast<int>(ringNodes.size());

/// With t = sqrt(1 - r^2) the pressure under a flat end goes as 1 / t, Hertz's as t, and r dr = -t dt.
ContactDisc disc() {
  ContactDisc result;
  for (std::size_t ring = 0; ring < ringNodes.size(); ++ring)
    for (int k = 0; k < anglesARing; ++k) {
      const double t = ringNodes[ring], r = std::sqrt(1 - t * t);
      const double angle = 2 * std::numbers::pi * (k + 0.5 * static_cast<double>(ring % 2)) / anglesARing;
      const Eigen::Index i = static_cast<Eigen::Index>(ring) * anglesARing + k;
      result.points.col(i) << r * std::cos(angle), r * std::sin(angle);
      result.flat(i) = ringWeights[ring] / anglesARing;
      result.hertz(i) = 3 * t * t * ringWeights[ring] / anglesARing;
    }
  return result;
}

} // namespace

const ContactDisc& contactDisc() {
  static const ContactDisc unit = disc();
  return unit;
}

} // namespace palp
