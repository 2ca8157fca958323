#pragma once

#include "model/TerminalNetwork.h"

namespace palp {

/// Where the current goes that is driven into a row-wire while a cell is read; shares of it.
struct CurrentPaths {
  double straight = 0; ///< through the rubber from the row-wire to the column-wire themselves
  double metal = 0; ///< through the metal of other wires: in at some electrodes and out at others, or to their ground
  double mostPerVolt_A = 0; ///< largest current that a row-wire is driven with at 1 V between the two wires
};

/// While one cell is read.
CurrentPaths currentPaths(const TerminalNetwork& network, const NetworkReading& reading, int rowWire, int columnWire);
/// Means over all cells, but for the largest current, which is that of all of them.
CurrentPaths currentPaths(const TerminalNetwork& network, Readout readout);

} // namespace palp
