#pragma once

#include "app/gui/jobs/TouchResistances.h"
#include "app/scenes/charts/Chart.h"
#include "app/scenes/charts/Heatmap.h"
#include "model/TerminalNetwork.h"

#include <array>

namespace palp {

/// One row or column of the matrix against its index, and one of its cells.
ChartSpec curveChart(const HeatmapSpec& heatmap, const std::string& title, const std::string& xLabel,
                     const Eigen::VectorXd& values, int color, int cell);

/// How the changes by the field compare with those by Eq. (1), over all readings.
QString lawsWords(const TouchResistances& field, const TouchResistances& pairs);

/// A cell's resistance at rest and under the load; row-wire, column-wire.
QString cellWords(const TouchResistances& resistances, const std::array<int, 2>& cell);

/// Its two numbers alone; empty where there is no such cell.
QString cellNumbers(const TouchResistances& resistances, const std::array<int, 2>& cell);

/// Where the current goes while a cell is read.
QString pathWords(const TerminalNetwork& network, Readout readout, const std::array<int, 2>& cell);

} // namespace palp
