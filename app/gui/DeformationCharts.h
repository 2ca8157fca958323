#pragma once

#include "app/scenes/Chart.h"
#include "model/RowColumnResistance.h"
#include "model/Solution.h"

namespace palp {

/// Relative residuals over all iterations, one curve a load fraction.
ChartSpec newtonChart(const std::vector<NewtonStep>& steps);

/// Displacements of a row-wire's electrodes along it, at rest and under the load (Figs. 6 and 7).
ChartSpec rowWireChart(const SensorDesign& design, const ElectrodeDisplacements& displacements, int rowWire);

} // namespace palp
