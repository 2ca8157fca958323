#pragma once

#include "model/Mesh.h"
#include "model/SensorDesign.h"

namespace palp {

/// Sizes of the graded mesh of the block.
struct Grading {
  double bulk_mm = 5;     ///< largest size, horizontally
  double border_mm = 2;   ///< across the borders of the load areas
  double edge_mm = 1;     ///< across the free edges, and so across the clamped ones
  double bottom_mm = 1.4; ///< vertically at the clamped face
  double top_mm = 1.6;    ///< vertically at the loaded face
  double vertical_mm = 3; ///< largest size, vertically
  double growth = 0.4;    ///< of the size with the distance
};

/// The default grading times a factor.
Grading defaultGrading(const SensorDesign& design, double factor);

/// Quadratic tetrahedra by TetGen: the block is meshed in coordinates stretched to the grading, load areas as facets
/// and upper electrodes as points, and mapped back.
Mesh gradedTets(const SensorDesign& design, const Grading& grading);

} // namespace palp
