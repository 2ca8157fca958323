#pragma once

#include "model/Mesh.h"
#include "model/SensorDesign.h"
#include "solver/SensorMesh.h"

#include <stop_token>
#include <vector>

namespace palp {

/// Sizes of the graded mesh of the block.
struct Grading {
  Eigen::Vector2d bulk_mm{4, 4};         ///< largest sizes along x and y
  Eigen::Vector2d border_mm{0.75, 0.75}; ///< across the borders of the load areas
  Eigen::Vector2d edge_mm{1.25, 1.25};   ///< across the free edges, and so across the clamped ones
  double bottom_mm = 0.75;               ///< vertically at the clamped face
  double top_mm = 0.5;                   ///< vertically at the loaded face
  double vertical_mm = 2;                ///< largest size, vertically
  double growth = 0.5;                   ///< of the size with the distance
};

/// The grading for a size in the bulk; the other sizes follow from the block and its areas.
Grading defaultGrading(const SensorDesign& design, double size_mm);
/// The size of the default mesh.
double standardSize(const SensorDesign& design);

/// The grading that the options ask for; `zones` become theirs at that size.
Grading gradingFor(const SensorDesign& design, const MeshOptions& options, std::vector<FineZone>& zones);
/// Elements of the mesh for the options, but for lines that electrodes bring in addition.
double gradedElements(const SensorDesign& design, const MeshOptions& options);

/// Quadratic tetrahedra by TetGen on the points of a graded grid whose lines meet the load areas' borders and, where
/// `electrodesAsNodes`, the upper electrodes. Each cell becomes six path simplices, mirrored from cell to cell: no
/// stretching along the axes makes them obtuse, and the mirroring halves the error of equal cells. Electrodes that lie
/// too irregularly, so that to be nodes they would take four times the cells or cells thinner than 1/200 of the
/// wanted size, all stay inside elements. Throws DesignError where there are too many elements, and Cancelled.
Mesh gradedTets(const SensorDesign& design, const Grading& grading, const std::vector<FineDisc>& discs = {},
                const std::vector<FineZone>& zones = {}, bool electrodesAsNodes = true,
                const std::stop_token& stop = {});

} // namespace palp
