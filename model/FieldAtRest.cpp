#include "model/FieldAtRest.h"

#include "model/RowColumnResistance.h"

#include <cmath>
#include <numbers>

namespace palp {

WireCounts wireCounts(const SensorDesign& design) {
  return {design.rowWires(), design.electrodesPerRowWire(), design.columnWires(), design.electrodesPerColumnWire()};
}

Eigen::Matrix3Xd electrodes_mm(const SensorDesign& design) {
  Eigen::Matrix3Xd all(3, design.upper.electrodes() + design.lower.electrodes());
  all << design.upperElectrodes_mm(), design.lowerElectrodes_mm();
  return all;
}

double logConductivity(const PressureLaw& law, double pressure_MPa) {
  return pressure_MPa > 0 ? law.exponent * std::log1p(pressure_MPa / law.p0_MPa) : 0;
}

double contactResistance_ohm(const FieldLaw& law) {
  return law.contact_ohm_mm2 / (4 * std::numbers::pi * law.electrodeRadius_mm * law.electrodeRadius_mm);
}

Eigen::MatrixXd potentials_ohm(const BoxGreen& green, const FieldLaw& law, SphereModel model,
                               const Eigen::VectorXd& conductivities) {
  const double a = law.electrodeRadius_mm;
  const bool heterogeneous = conductivities.size() > 0;
  Eigen::MatrixXd p = green.value;
  if (heterogeneous)
    p.diagonal().array() += 1 / (4 * std::numbers::pi * a * conductivities.array());
  else
    p.diagonal().array() += 1 / (4 * std::numbers::pi * a);
  if (model == SphereModel::Dipoles)
    for (const Eigen::MatrixXd& slope : green.slope) {
      if (heterogeneous)
        p -= 4 * std::numbers::pi * a * a * a * slope.transpose() * conductivities.asDiagonal() * slope;
      else
        p -= 4 * std::numbers::pi * a * a * a * slope.transpose() * slope;
    }
  p *= law.resistivity_ohm_mm;
  p.diagonal().array() += contactResistance_ohm(law);
  return p;
}

Eigen::MatrixXd potentialsAtRest_ohm(const Eigen::Vector3d& block_mm,
                                     const Eigen::Ref<const Eigen::Matrix3Xd>& electrodes, const FieldLaw& law,
                                     SphereModel model) {
  return potentials_ohm(boxGreen(block_mm, electrodes), law, model);
}

TerminalNetwork networkAtRest(const SensorDesign& design, const FieldLaw& law, SphereModel model) {
  return {potentialsAtRest_ohm(design.block_mm, electrodes_mm(design), law, model), wireCounts(design), law.wire_ohm};
}

Eigen::MatrixXd resistancesAtRest_ohm(const SensorDesign& design) {
  if (const FieldLaw* law = design.field())
    return NetworkReading(networkAtRest(design, *law), law->readout).resistances_ohm();
  return rowColumnResistances(design, ElectrodeDisplacements::atRest(design));
}

} // namespace palp
