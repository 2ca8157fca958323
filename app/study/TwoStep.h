#pragma once

#include "io/Decoder.h"

#include <Eigen/Core>

namespace palp {

/// One row-wire's inversion of Eq. (1).
struct Inversion {
  Eigen::MatrixXd displacements_mm; ///< (3 electrodes) x samples
  double condition = 0;             ///< of d ln R / d u at rest
  int rank = 0;
  int worstIterations = 0;
  double worstResidual = 0; ///< largest |R - R(u)| / R left
};

/// Displacements of a row-wire's electrodes whose Eq. (1) gives the resistances [ohm] (column-wires x samples), by
/// damped Gauss-Newton from rest, the step of least norm where the system is singular. Throws Error where the system
/// is not square and where lower electrodes or resistivity follow the rubber, for then u alone does not decide R.
Inversion invertRowResistances(const SensorDesign& design, int rowWire,
                               const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm);

/// Step 1 alone: displacements [mm] of all rows, rows stacked, from their resistances, rows stacked.
Eigen::MatrixXd displacementsOf(const TwoStep& decoder, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm);
/// Both steps.
Eigen::MatrixXd predict(const TwoStep& decoder, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm);

} // namespace palp
