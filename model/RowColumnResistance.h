#pragma once

#include "model/SensorDesign.h"

#include <Eigen/Core>

namespace palp {

/// Displacements and pressures at the electrodes under a load; the columns follow SensorDesign::upperElectrodes_mm and
/// lowerElectrodes_mm.
struct ElectrodeDisplacements {
  Eigen::Matrix3Xd upper_mm;         ///< 3 x (row-wires * electrodes)
  Eigen::Matrix3Xd lower_mm;         ///< 3 x (column-wires * electrodes), as if the rubber carried them
  Eigen::VectorXd upperPressure_MPa; ///< hydrostatic pressure (compression positive) at each upper electrode

  /// The block at rest.
  static ElectrodeDisplacements atRest(const SensorDesign& design);
};

/// Row-column resistances [ohm], row-wires x column-wires, by Eq. (1):
/// 1/R_k = sum_i (1/g(p_i)) sum_j 1 / |D_ijk + u_i - v_jk|, D_ijk upper minus lower electrode at rest, v_jk the lower
/// electrode's displacement if the design lets it follow the rubber (else 0), g(p) the resistance rate, constant unless
/// the design has a pressure law (Fig. 1). See resources/docs/physics.md. Throws DesignError where
/// the design has the law of the field.
Eigen::MatrixXd rowColumnResistances(const SensorDesign& design, const ElectrodeDisplacements& displacements);

/// Derivatives of the resistances R_k of one row-wire [ohm per ...]; row k is column-wire k.
struct RowResistanceJacobian {
  Eigen::MatrixXd upper;    ///< [ohm/mm] columns 3 i + d: upper electrode i of the row-wire, direction d
  Eigen::MatrixXd lower;    ///< [ohm/mm] columns 3 j + d: electrode j of column-wire k itself; 0 where they are held
  Eigen::MatrixXd pressure; ///< [ohm/MPa] column i: pressure at upper electrode i; 0 without a pressure law
};

/// Resistances [ohm] of one row-wire, one per column-wire, and their derivatives on request.
Eigen::VectorXd rowResistances(const SensorDesign& design, const ElectrodeDisplacements& displacements, int rowWire,
                               RowResistanceJacobian* jacobian = nullptr);

} // namespace palp
