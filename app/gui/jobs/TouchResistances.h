#pragma once

#include "model/RowColumnResistance.h"

#include <QString>

#include <optional>

namespace palp {

/// Row-column resistances [ohm] at rest and under a load, row-wires x column-wires.
struct TouchResistances {
  Eigen::MatrixXd rest_ohm, now_ohm;
};

/// By Eq. (1); nullopt where the design has another law: whyNoResistances() names the scene that shows it.
std::optional<TouchResistances> resistancesOf(const SensorDesign& design, const ElectrodeDisplacements& electrodes);

/// Empty by Eq. (1).
QString whyNoResistances(const SensorDesign& design);

} // namespace palp
