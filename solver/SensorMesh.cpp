#include "solver/SensorMesh.h"

#include "model/DesignError.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "solver/contact/ContactEstimate.h"
#include "solver/mesh/GradedTets.h"
#include "solver/mesh/MappedHexes.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace palp {

namespace {

/// Cells for touches anywhere, in those of a mesh that is made for one touch: for the paper's block about 1 mm; in a
/// part of the face 0.8 mm, for surfaces that a decoder learns from 0.7 mm.
constexpr double kCellsAnywhere = 2.7, kCellsInPart = 2.1, kCellsToLearnFrom = 1.9;
/// Of cells and of layers at the top face, where a decoder under the field learns from touches: it takes what the mesh
/// makes of one place and not of the next for noise.
constexpr double kCellsOfField = 0.8, kLayersOfField = 0.5;
constexpr double cellsAPart = 10;     // along each axis: about as many as outside of them
constexpr int mostPartsAlongAxis = 4; // what is computed once for each part has to pay
constexpr double widerContact = 1.1;  // than expected: at the block's edges

/// Touch in the middle of the range.
Indenter middleOf(const TouchRange& range, double radius_mm, double press_N) {
  return {range.shape, radius_mm, range.rim_mm, (range.low_mm + range.high_mm) / 2, 0, Press{{0, 0, -press_N}}};
}

FineZone zoneOf(const SensorDesign& design, const TouchRange& range, double cells) {
  const Indenter middle =
      middleOf(range, (range.smallest_mm + range.largest_mm) / 2, (range.leastPress_N + range.mostPress_N) / 2);
  // Not the zones of a punch's rim: it may be anywhere. A plane has none.
  const std::vector<FineZone> zones = fineZones(design, {.areas = {}, .patches = {}, .indenters = {middle}});
  FineZone zone = zones.empty() ? FineZone{middle.place_mm, {0, 0}, design.block_mm.head<2>(), 0} : zones.front();
  zone.size_mm *= cells;
  zone.half_mm += (range.high_mm - range.low_mm) / 2;
  return zone;
}

MeshOptions withZone(const SensorDesign& design, const TouchRange& range, MeshOptions options, double cells,
                     double layers = 1) {
  if (options.mapped) return options;
  options.zones.clear();
  if (range.shape != IndenterShape::Plane) {
    FineZone zone = zoneOf(design, range, cells);
    zone.layer_mm = layers * zone.size_mm.minCoeff();
    options.zones.push_back(zone);
  }
  options.fineBorders = false;
  return options;
}

double sizeFactor(const SensorDesign& design, const MeshOptions& options) {
  return options.meshSize_mm ? *options.meshSize_mm / standardSize(design) : 1;
}

void requireMapped(const std::array<int, 3>& counts) {
  const double elements = double(counts[0]) * counts[1] * counts[2];
  if (counts[0] < 1 || counts[1] < 1 || counts[2] < 1 || elements > mostElements)
    throw DesignError("mapped mesh: " + gotExpected(std::to_string(counts[0]) + "x" + std::to_string(counts[1]) + "x" +
                                                        std::to_string(counts[2]),
                                                    "at least 1 along each direction and at most 1e6 elements in all"));
}

} // namespace

std::vector<FineDisc> fineDiscs(const LoadCase& load) {
  std::vector<FineDisc> discs;
  for (const PatchLoad& p : load.patches) discs.push_back({p.centre_mm.x(), p.centre_mm.y(), p.radius_mm});
  return discs;
}

MeshOptions meshFor(const SensorDesign& design, const LoadCase& load, MeshOptions options) {
  const bool graded = !options.mapped;
  options.discs = graded ? fineDiscs(load) : std::vector<FineDisc>{};
  options.zones = graded ? fineZones(design, load) : std::vector<FineZone>{};
  options.fineBorders = load.indenters.empty() || !load.areas.empty();
  return options;
}

MeshOptions meshForTouches(const SensorDesign& design, const TouchRange& range, MeshOptions options) {
  return withZone(design, range, std::move(options), kCellsAnywhere);
}

MeshOptions meshToLearnFrom(const SensorDesign& design, const TouchRange& range, MeshOptions options) {
  return withZone(design, range, std::move(options), kCellsToLearnFrom, design.field() ? kLayersOfField : 1);
}

MeshOptions meshForPart(const SensorDesign& design, const TouchRange& part, MeshOptions options) {
  if (!design.field()) return withZone(design, part, std::move(options), kCellsInPart);
  return withZone(design, part, std::move(options), kCellsOfField * kCellsInPart, kLayersOfField);
}

std::vector<TouchRange> partsOfTouches(const SensorDesign& design, const TouchRange& range, const MeshOptions& options,
                                       std::array<int, 2>* cuts) {
  std::array<int, 2> parts{1, 1};
  const Eigen::Vector2d extent_mm = range.high_mm - range.low_mm;
  if (!options.mapped && range.shape != IndenterShape::Plane) {
    const Eigen::Vector2d cell_mm = sizeFactor(design, options) * zoneOf(design, range, kCellsInPart).size_mm;
    for (int d = 0; d < 2; ++d)
      parts[d] =
          std::clamp(static_cast<int>(std::round(extent_mm(d) / (cellsAPart * cell_mm(d)))), 1, mostPartsAlongAxis);
  }
  if (cuts) *cuts = parts;
  std::vector<TouchRange> all;
  for (int j = 0; j < parts[1]; ++j)
    for (int i = 0; i < parts[0]; ++i) {
      TouchRange part = range;
      part.low_mm += extent_mm.cwiseProduct(Eigen::Vector2d(double(i) / parts[0], double(j) / parts[1]));
      part.high_mm =
          range.low_mm + extent_mm.cwiseProduct(Eigen::Vector2d(double(i + 1) / parts[0], double(j + 1) / parts[1]));
      all.push_back(part);
    }
  return all;
}

Rectangle touchedByTouches(const SensorDesign& design, const TouchRange& range, const MeshOptions& options) {
  Eigen::Vector2d half_mm = Eigen::Vector2d::Zero();
  for (const double radius_mm : {range.smallest_mm, range.largest_mm})
    half_mm = half_mm.cwiseMax(contactEstimate(middleOf(range, radius_mm, range.mostPress_N), design).half_mm);
  const Eigen::Vector2d margin_mm =
      widerContact * half_mm + sizeFactor(design, options) * zoneOf(design, range, kCellsInPart).size_mm;
  return {range.low_mm - margin_mm, range.high_mm + margin_mm};
}

bool finerForField(const SensorDesign& design) {
  return design.field() != nullptr && (design.lowerFollowsRubber || design.pressureLaw);
}

bool finerForPressure(const SensorDesign& design) {
  return design.field() != nullptr && design.pressureLaw;
}

double standardMeshSize_mm(const SensorDesign& design) {
  return standardSize(design);
}

void requireMeshable(const SensorDesign& design, const MeshOptions& options) {
  requireValid(design);
  if (options.mapped) return requireMapped(*options.mapped);
  const double size = options.meshSize_mm.value_or(standardSize(design));
  const double smallest = std::cbrt(6 * design.block_mm.prod() / mostElements); // six tetrahedra a cube
  if (!(size >= smallest))
    throw DesignError("mesh size: " + gotExpected(size, " mm",
                                                  shortText(std::ceil(1e4 * smallest) / 1e4) +
                                                      " mm or more for this block, or the mesh would have more than "
                                                      "1e6 elements"));
}

Mesh sensorMesh(const SensorDesign& design, const MeshOptions& options, const std::stop_token& stop) {
  requireMeshable(design, options);
  if (options.mapped) return mappedMesh(design, *options.mapped);
  std::vector<FineZone> zones;
  const Grading grading = gradingFor(design, options, zones);
  Mesh mesh = gradedTets(design, grading, options.discs, zones, options.electrodesAsNodes, stop);
  mesh.size_mm = options.meshSize_mm.value_or(standardSize(design));
  return mesh;
}

} // namespace palp
