#include "app/study/reports/readout/CurrentPaths.h"

#include <algorithm>
#include <cmath>

namespace palp {

CurrentPaths currentPaths(const TerminalNetwork& network, const NetworkReading& reading, int rowWire, int columnWire) {
  const WireCounts& counts = network.counts();
  const Eigen::VectorXd drive = reading.potentials(rowWire, columnWire); // of the wires' ends
  const Eigen::VectorXd ofElectrodes = network.currents() * (network.inBlock() * drive);
  const Eigen::VectorXd in = counts.sumsByWire(ofElectrodes.cwiseMax(0)),
                        out = counts.sumsByWire((-ofElectrodes).cwiseMax(0));
  const Eigen::MatrixXd& y = network.conductances();
  const Eigen::Index row = rowWire, column = counts.rowWires + columnWire;
  const double driven = std::abs(y.row(row).dot(drive)), between = std::abs(drive(row) - drive(column));
  CurrentPaths paths{-y(row, column) * between / driven, 0, driven / between};
  for (Eigen::Index wire = 0; wire < drive.size(); ++wire)
    if (wire != row && wire != column) paths.metal += std::max(in(wire), out(wire)) / driven;
  return paths;
}

CurrentPaths currentPaths(const TerminalNetwork& network, Readout readout) {
  const WireCounts& counts = network.counts();
  const NetworkReading reading(network, readout);
  CurrentPaths mean;
  for (int column = 0; column < counts.columnWires; ++column)
    for (int row = 0; row < counts.rowWires; ++row) {
      const CurrentPaths cell = currentPaths(network, reading, row, column);
      mean.straight += cell.straight / (counts.rowWires * counts.columnWires);
      mean.metal += cell.metal / (counts.rowWires * counts.columnWires);
      mean.mostPerVolt_A = std::max(mean.mostPerVolt_A, cell.mostPerVolt_A);
    }
  return mean;
}

} // namespace palp
