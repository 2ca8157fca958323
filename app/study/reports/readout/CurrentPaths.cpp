#include "app/study/reports/readout/CurrentPaths.h"

#include <algorithm>
#include <cmath>

namespace palp {

CurrentPaths currentPaths(const TerminalNetwork& network, Readout readout) {
  const WireCounts& counts = network.counts();
  const NetworkReading reading(network, readout);
  const Eigen::MatrixXd& drive = reading.drive(); // potentials of the wires' ends
  const Eigen::MatrixXd ofElectrodes = network.currents() * (network.inBlock() * drive);
  const Eigen::MatrixXd in = counts.sumsByWire(ofElectrodes.cwiseMax(0)),
                        out = counts.sumsByWire((-ofElectrodes).cwiseMax(0));
  const Eigen::MatrixXd& y = network.conductances();
  CurrentPaths paths;
  for (Eigen::Index cell = 0; cell < drive.cols(); ++cell) {
    const Eigen::Index row = cell % counts.rowWires, column = counts.rowWires + cell / counts.rowWires;
    const double driven = std::abs(y.row(row).dot(drive.col(cell)));
    const double between = std::abs(drive(row, cell) - drive(column, cell));
    double metal = 0;
    for (Eigen::Index wire = 0; wire < drive.rows(); ++wire)
      if (wire != row && wire != column) metal += std::max(in(wire, cell), out(wire, cell));
    paths.straight += -y(row, column) * between / driven;
    paths.metal += metal / driven;
    paths.mostPerVolt_A = std::max(paths.mostPerVolt_A, driven / between);
  }
  paths.straight /= static_cast<double>(drive.cols());
  paths.metal /= static_cast<double>(drive.cols());
  return paths;
}

} // namespace palp
