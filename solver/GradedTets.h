#pragma once

#include "model/Mesh.h"
#include "model/SensorDesign.h"

namespace palp {

/// Sizes of the graded mesh of the block.
struct Grading {
  double bulk_mm = 4;      ///< largest size, horizontally
  double border_mm = 1;    ///< across the borders of the load areas
  double edge_mm = 1.25;   ///< across the free edges, and so across the clamped ones
  double bottom_mm = 0.75; ///< vertically at the clamped face
  double top_mm = 0.5;     ///< vertically at the loaded face
  double vertical_mm = 2;  ///< largest size, vertically
  double growth = 0.5;     ///< of the size with the distance
};

/// The grading for a size in the bulk; the other sizes follow from the block and its areas.
Grading defaultGrading(const SensorDesign& design, double size_mm);
/// The size of the default mesh.
double standardSize(const SensorDesign& design);

/// Quadratic tetrahedra by TetGen on the points of a graded grid and the upper electrodes, load areas as facets.
/// TetGen sees the grid squeezed along its diagonal to a body-centred cubic lattice, whose Delaunay tetrahedra are all
/// alike; in the block they are path simplices, which no stretching along the axes makes obtuse.
Mesh gradedTets(const SensorDesign& design, const Grading& grading);

} // namespace palp
