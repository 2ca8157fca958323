#pragma once

#include "model/Mesh.h"

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp {

/// Where the current goes while a row-wire and a column-wire are read: lines along it, each of the same current.
struct CurrentLines {
  int rowWire = 0;
  int columnWire = 0;
  Eigen::Matrix3Xd places_mm;       ///< in the deformed block
  Eigen::Matrix3Xd displacement_mm; ///< of the existing rubber
  std::vector<double> density;      ///< current density [A/mm2] for 1 A driven into the row-wire
  std::vector<std::vector<int>> lines;
  double current_A = 0; ///< of each line, for 1 A driven into the row-wire
};

/// What the lines are made of: at the nodes of the mesh, and at the electrodes in the deformed block.
struct CurrentSources {
  Eigen::Matrix3Xd displacement_mm;
  Eigen::Matrix3Xd density; ///< [A/mm2] for 1 A driven into the row-wire
  Eigen::Matrix3Xd electrodes_mm;
  Eigen::VectorXd electrodes_A; ///< from each into the rubber, for the same
  double electrodeRadius_mm = 0.2;
};

/// Followed from the electrodes that current leaves, through wires that are read and those that are not, to those that
/// take it up. Throws Cancelled where it is stopped.
CurrentLines currentLines(const Mesh& mesh, const CurrentSources& sources, const std::stop_token& stop);

} // namespace palp
