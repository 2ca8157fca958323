#pragma once

#include "model/RowColumnResistance.h"

#include <QString>

#include <optional>

namespace palp {

/// Row-column resistances [ohm] at rest and under a load, row-wires x column-wires.
struct TouchResistances {
  Eigen::MatrixXd rest_ohm, now_ohm;
};

/// By the law of the design; empty where whyNoResistances() says why.
std::optional<TouchResistances> resistancesOf(const SensorDesign& design, const ElectrodeDisplacements& electrodes);

/// Why there are no resistances of a touch on this design; empty where there are.
QString whyNoResistances(const SensorDesign& design);

} // namespace palp
