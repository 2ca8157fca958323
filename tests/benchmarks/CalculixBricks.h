#pragma once

#include "model/LoadCase.h"
#include "model/SensorDesign.h"

#include <array>

namespace palp::bench {

/// CalculiX with C3D20R bricks on a uniform grid, its best element on this block: the deck, its run with two threads
/// and the displacements of the upper electrodes, which must lie on vertical edges of the grid (20 x 20 for the
/// paper's). The load acts by its exact integral over the bricks' faces.
struct CalculixAnswer {
  bool ran = false;   ///< false: ccx is not installed, or it failed
  double seconds = 0; ///< the whole process, input reading included
  Eigen::Matrix3Xd upper_mm;
};
CalculixAnswer calculixBricks(const SensorDesign& design, const std::array<int, 3>& counts, const LoadCase& load);

} // namespace palp::bench
