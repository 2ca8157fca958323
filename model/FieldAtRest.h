#pragma once

#include "model/BoxGreen.h"
#include "model/SensorDesign.h"
#include "model/TerminalNetwork.h"

#include <Eigen/Core>

namespace palp {

struct BoxGreen;

/// How far the electrodes' size is taken into account: as point sources alone, or with the dipoles that the field of
/// all others induces in the conducting spheres.
enum class SphereModel { Monopoles, Dipoles };

WireCounts wireCounts(const SensorDesign& design);
/// Positions 3 x electrodes [mm] at rest in the order of WireCounts.
Eigen::Matrix3Xd electrodes_mm(const SensorDesign& design);

/// The matrix P [ohm] between small spheres of radius a in the insulated box at rest (electrodes x electrodes):
///   P_pq = rho G(x_p, x_q),   P_pp = rho (1 / (4 pi a) + G_reg(x_p)) + contact / (4 pi a^2),
/// and with dipoles   - 4 pi a^3 rho sum_s grad G(x_s, x_p) . grad G(x_s, x_q): a conducting sphere in a field E has
/// the dipole moment 4 pi a^3 E. The error is of fourth order in a over a distance.
Eigen::MatrixXd potentialsAtRest_ohm(const Eigen::Vector3d& block_mm,
                                     const Eigen::Ref<const Eigen::Matrix3Xd>& electrodes_mm, const FieldLaw& law,
                                     SphereModel model = SphereModel::Dipoles);

/// The same of any block, from Green's function between its electrodes (as BoxGreen has it) for conductivity 1, or for
/// one that varies and is `conductivities` at the electrodes.
Eigen::MatrixXd potentials_ohm(const BoxGreen& green, const FieldLaw& law, SphereModel model = SphereModel::Dipoles,
                               const Eigen::VectorXd& conductivities = {});
/// ln of the conductivity over that without pressure: n ln(1 + max(p, 0) / p0).
double logConductivity(const PressureLaw& law, double pressure_MPa);
/// Of one electrode's contact with the rubber: contact / (4 pi a^2).
double contactResistance_ohm(const FieldLaw& law);

/// The wires of a design at rest under a law of the field.
TerminalNetwork networkAtRest(const SensorDesign& design, const FieldLaw& law,
                              SphereModel model = SphereModel::Dipoles);
/// Resistances [ohm] of a design at rest by its own law, row-wires x column-wires.
Eigen::MatrixXd resistancesAtRest_ohm(const SensorDesign& design);

} // namespace palp
