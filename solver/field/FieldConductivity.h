#pragma once

#include "model/FieldAtRest.h"

#include <Eigen/Core>

namespace palp {

/// FieldConductivity k of the deformed block by a pressure law. The pressure is interpolated to the points of a
/// quadrature and the law applied there, since its kink at p = 0 lies between the nodes.
struct FieldConductivity {
  Eigen::VectorXd pressures_MPa{}; ///< at the nodes, quadratic between; empty: k = 1
  PressureLaw law{};

  [[nodiscard]] bool heterogeneous() const { return pressures_MPa.size() > 0; }
  /// l = ln(k) / 2 where the pressure is p, and dl/dp.
  [[nodiscard]] double halfLogConductivity(double p) const { return logConductivity(law, p) / 2; }
  [[nodiscard]] double halfLogConductivitySlope(double p) const {
    return p > 0 ? law.exponent / (2 * (law.p0_MPa + p)) : 0;
  }
};

} // namespace palp
