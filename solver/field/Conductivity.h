#pragma once

#include "model/FieldAtRest.h"

#include <Eigen/Core>

namespace palp {

/// How well the deformed block conducts: k by a pressure law. The pressure is carried to the points of a quadrature and
/// the law applied there, as its kink at p = 0 lies between the nodes.
struct Conductivity {
  Eigen::VectorXd pressures_MPa{}; ///< at the nodes, quadratic between; empty: k = 1
  PressureLaw law{};

  [[nodiscard]] bool uneven() const { return pressures_MPa.size() > 0; }
  /// l = ln(k) / 2 where the pressure is p, and dl/dp.
  [[nodiscard]] double half(double p) const { return logConductivity(law, p) / 2; }
  [[nodiscard]] double halfByPressure(double p) const { return p > 0 ? law.exponent / (2 * (law.p0_MPa + p)) : 0; }
};

} // namespace palp
