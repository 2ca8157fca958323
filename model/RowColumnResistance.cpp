#include "model/RowColumnResistance.h"

#include <cmath>

namespace palp {

namespace {

/// Conductivity 1/g(p) [mm/ohm] and its derivative by the pressure.
struct PairConductivity {
  double value;
  double slope;
};

PairConductivity pairConductivity(const SensorDesign& design, double pressure_MPa) {
  const double atRest = 1 / std::get<PairsLaw>(design.resistance).rate_ohm_per_mm;
  if (!design.pressureLaw || !(pressure_MPa > 0)) return {atRest, 0};
  const auto [p0, n] = *design.pressureLaw;
  const double value = atRest * std::pow(1 + pressure_MPa / p0, n);
  return {value, value * n / (p0 + pressure_MPa)};
}

} // namespace

ElectrodeDisplacements ElectrodeDisplacements::atRest(const SensorDesign& design) {
  return {Eigen::Matrix3Xd::Zero(3, design.upper.electrodes()), Eigen::Matrix3Xd::Zero(3, design.lower.electrodes()),
          Eigen::VectorXd::Zero(design.upper.electrodes())};
}

Eigen::VectorXd rowResistances(const SensorDesign& design, const ElectrodeDisplacements& displacements, int rowWire,
                               RowResistanceJacobian* jacobian) {
  requirePairs(design, "resistances by Eq. (1)");
  const int electrodes = design.electrodesPerRowWire();
  const int columns = design.columnWires();
  const int perColumn = design.electrodesPerColumnWire();
  const Eigen::Matrix3Xd upper = design.upperElectrodes_mm().middleCols(rowWire * electrodes, electrodes) +
                                 displacements.upper_mm.middleCols(rowWire * electrodes, electrodes);
  Eigen::Matrix3Xd lower = design.lowerElectrodes_mm();
  if (design.lowerFollowsRubber) lower += displacements.lower_mm;

  if (jacobian) {
    jacobian->upper = Eigen::MatrixXd::Zero(columns, 3 * electrodes);
    jacobian->lower = Eigen::MatrixXd::Zero(columns, 3 * perColumn);
    jacobian->pressure = Eigen::MatrixXd::Zero(columns, electrodes);
  }
  Eigen::VectorXd resistances(columns);
  for (int k = 0; k < columns; ++k) {
    double conductance = 0; // of the column-wire, 1/R_k
    for (int i = 0; i < electrodes; ++i) {
      const PairConductivity sigma =
          pairConductivity(design, displacements.upperPressure_MPa(rowWire * electrodes + i));
      double inverseDistances = 0;
      for (int j = 0; j < perColumn; ++j) {
        const Eigen::Vector3d distance = upper.col(i) - lower.col(k * perColumn + j);
        const double inverse = 1 / distance.norm();
        inverseDistances += inverse;
        if (!jacobian) continue;
        const Eigen::RowVector3d slope = sigma.value * inverse * inverse * inverse * distance.transpose();
        jacobian->upper.block<1, 3>(k, 3 * i) -= slope;
        if (design.lowerFollowsRubber) jacobian->lower.block<1, 3>(k, 3 * j) += slope;
      }
      conductance += sigma.value * inverseDistances;
      if (jacobian) jacobian->pressure(k, i) = sigma.slope * inverseDistances;
    }
    resistances(k) = 1 / conductance;
  }
  if (jacobian) { // so far the derivatives of 1/R; dR = -R^2 d(1/R)
    const Eigen::VectorXd factor = -resistances.cwiseAbs2();
    for (Eigen::MatrixXd* part : {&jacobian->upper, &jacobian->lower, &jacobian->pressure})
      *part = factor.asDiagonal() * *part;
  }
  return resistances;
}

Eigen::MatrixXd rowColumnResistances(const SensorDesign& design, const ElectrodeDisplacements& displacements) {
  Eigen::MatrixXd resistances(design.rowWires(), design.columnWires());
  for (int row = 0; row < design.rowWires(); ++row)
    resistances.row(row) = rowResistances(design, displacements, row).transpose();
  return resistances;
}

} // namespace palp
