#pragma once

#include "app/study/reports/layout/AreaResponse.h"

#include <Eigen/Core>

#include <stop_token>

namespace palp {

/// Cramer-Rao bounds of the force in the middle of the range, area known, in % of the force range; 3 forces x areas.
/// Infinite where the resistances do not determine the force. With prior: as NoiseBound's.
struct LayoutBound {
  Eigen::Matrix3Xd withoutPrior_percent;
  Eigen::Matrix3Xd withPrior_percent;

  /// Root mean square over the areas.
  [[nodiscard]] Eigen::Vector3d withoutPrior() const;
  [[nodiscard]] Eigen::Vector3d withPrior() const;
  /// Geometric mean of the three forces of withoutPrior().
  [[nodiscard]] double mean() const;
};

/// From Fisher's information of the forces in units of the range, J' J / noise^2 with J = d ln R / d(F / range); one an
/// area.
LayoutBound boundOf(const std::vector<Eigen::Matrix3d>& information);

/// d ln R / dF [1/N] by Eq. (1) around the middle of the response, row-wires x column-wires for Fx, Fy, Fz. One an
/// area.
std::vector<std::array<Eigen::MatrixXd, 3>> logSensitivity(const SensorDesign& layout, const AreaResponse& response);

/// Of one row-wire, or of all with row-wire -1, for relative resistance noise; by Eq. (1), or by the field at rest and
/// the read-out of the layout's law. The rest as FieldResponse's.
LayoutBound layoutBound(const SensorDesign& layout, const AreaResponse& response, int rowWire, double relativeNoise,
                        int threads = 0, double fineness = 1, const std::stop_token& stop = {});

/// Singular values of d ln R / d u of a row-wire at rest [1/mm], largest first.
Eigen::VectorXd resistanceSingularValues(const SensorDesign& layout, int rowWire);

/// Largest over smallest; infinite where the smallest is 0.
double condition(const Eigen::VectorXd& singularValues);

} // namespace palp
