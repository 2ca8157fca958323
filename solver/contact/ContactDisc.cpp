#include "solver/contact/ContactDisc.h"

#include "model/base/GaussLegendre.h"

#include <cmath>
#include <numbers>

namespace palp {

namespace {

/// With t = sqrt(1 - r^2) the pressure under a flat end goes as 1 / t, Hertz's as t, and r dr = -t dt: Gauss's rule in
/// t, every other ring turned by half a step.
ContactDisc disc() {
  ContactDisc result;
  const QuadratureRule rule = gaussLegendre(contactDiscRings);
  for (int ring = 0; ring < contactDiscRings; ++ring) {
    const double t = (1 + rule.points(ring)) / 2, share = rule.weights(ring) / 2 / contactDiscAngles;
    const double r = std::sqrt(1 - t * t);
    for (int k = 0; k < contactDiscAngles; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5 * (ring % 2)) / contactDiscAngles;
      const int i = ring * contactDiscAngles + k;
      result.points.col(i) << r * std::cos(angle), r * std::sin(angle);
      result.flat(i) = share;
      result.hertz(i) = 3 * t * t * share;
    }
  }
  return result;
}

} // namespace

const ContactDisc& contactDisc() {
  static const ContactDisc unit = disc();
  return unit;
}

} // namespace palp
