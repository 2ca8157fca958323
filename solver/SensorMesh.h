#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"
#include "model/TouchRange.h"

#include <array>
#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// A disc of the top face whose rim the mesh is graded to: where a patch load is to act.
struct FineDisc {
  double x_mm = 0, y_mm = 0, radius_mm = 1;
  bool operator==(const FineDisc&) const = default;
};
/// A rectangle of the top face in which the mesh is to be as fine along x and y as where an indenter will touch it.
struct FineZone {
  Eigen::Vector2d centre_mm, half_mm;
  Eigen::Vector2d size_mm; ///< along x, y, where the mesh has the default size in the bulk; it scales with that
  double layer_mm = 0;     ///< along z at the top face; it scales likewise; 0: the lesser of those
  bool operator==(const FineZone&) const = default;
};
/// The discs of a load's patches.
std::vector<FineDisc> fineDiscs(const LoadCase& load);

/// Which mesh: at most one of the first two members is given. Without either it is the default mesh, graded to the
/// borders of the load areas, the free and clamped edges and the electrodes, good for about 1 % in the electrodes'
/// displacements.
struct MeshOptions {
  std::optional<double> meshSize_mm;        ///< tetrahedra: size in the bulk; the grading scales with it
  std::optional<std::array<int, 3>> mapped; ///< the paper's mapped mesh: hexahedra along x, y, z
  std::vector<FineDisc> discs{};            ///< tetrahedra: finer at these discs' rims
  bool electrodesAsNodes = true;            ///< tetrahedra: otherwise electrodes lie inside elements
  std::vector<FineZone> zones{};            ///< tetrahedra: finer in these
  bool fineBorders = true;                  ///< tetrahedra: finer at the borders of the load areas
  bool operator==(const MeshOptions&) const = default;
};

/// The options with what the load asks of a mesh of tetrahedra in place of theirs: discs and zones, and borders of the
/// load areas where an area is loaded or no indenter presses.
MeshOptions meshFor(const SensorDesign& design, const LoadCase& load, MeshOptions options);

/// The options with what touches anywhere in the range ask of a mesh of tetrahedra: cells of one size all over their
/// rectangle, from the contact of a touch in the middle of the range.
MeshOptions meshForTouches(const SensorDesign& design, const TouchRange& range, MeshOptions options);

/// The same for influence surfaces that a decoder takes off its samples, with smaller cells: what the mesh makes of one
/// place and not of the next is noise to it (resources/docs/numerics/touch-decoder.md).
MeshOptions meshToLearnFrom(const SensorDesign& design, const TouchRange& range, MeshOptions options);

/// The same for one of the parts below, with smaller cells; under the field with cells and layers at the top that are
/// smaller still.
MeshOptions meshForPart(const SensorDesign& design, const TouchRange& part, MeshOptions options);

/// Cuts the range into parts by the touch's position, along x first, each with a mesh of its own: grid lines extend
/// through the complete block, so that one mesh as fine everywhere would have several times the unknowns. One part
/// where cutting saves nothing. `cuts` prescribes their number along x and y.
std::vector<TouchRange> partsOfTouches(const SensorDesign& design, const TouchRange& range, const MeshOptions& options,
                                       std::array<int, 2>* cuts = nullptr);

/// Where touches of the range may touch the top face, with an element's width to spare.
Rectangle touchedByTouches(const SensorDesign& design, const TouchRange& range, const MeshOptions& options);

/// Elements of the largest mesh that is made.
inline constexpr double mostElements = 1e6;

/// Throws DesignError if the options allow no mesh of the design (a size that is not positive, more elements than
/// mostElements), to be called before work that needs one.
void requireMeshable(const SensorDesign& design, const MeshOptions& options);

/// Mesh of the block. By TetGen: faces follow the borders of the load areas, and all upper electrodes are nodes, or
/// none is if that would take too many elements (mesh/GradedTets.h). Or mapped hexahedra. Throws as requireMeshable
/// does, and Cancelled.
Mesh sensorMesh(const SensorDesign& design, const MeshOptions& options = {}, const std::stop_token& stop = {});

/// Whether the mesh is finer at the free side faces and at the clamped one: under the law of the field, if it depends
/// on lower electrodes that follow the rubber, or on the pressure everywhere.
bool finerForField(const SensorDesign& design);
/// Whether it is finer in the bulk too, and finer still at the clamped face: under a pressure law of the field. Designs
/// that differ in their law alone have one mesh where both are the same.
bool finerForPressure(const SensorDesign& design);

/// Size in the bulk of the default mesh.
double standardMeshSize_mm(const SensorDesign& design);

} // namespace palp
