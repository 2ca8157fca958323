#include "solver/SensorMesh.h"

#include "model/DesignError.h"
#include "model/base/Text.h"
#include "solver/contact/ContactEstimate.h"
#include "solver/mesh/GradedTets.h"
#include "solver/mesh/MappedHexes.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace palp {

namespace {

/// Cells for touches anywhere, in those of a mesh that is made for one touch: for the paper's block about 1 mm.
constexpr double kCellsBesideOneTouch = 2.7;

void requireMapped(const std::array<int, 3>& counts) {
  const double elements = double(counts[0]) * counts[1] * counts[2];
  if (counts[0] < 1 || counts[1] < 1 || counts[2] < 1 || elements > mostElements)
    throw DesignError("mapped mesh " + std::to_string(counts[0]) + "x" + std::to_string(counts[1]) + "x" +
                      std::to_string(counts[2]) +
                      "; allowed is at least 1 along each direction and 1e6 elements in all");
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
  if (options.mapped) return options;
  Indenter middle{range.shape,
                  (range.smallest_mm + range.largest_mm) / 2,
                  range.rim_mm,
                  (range.low_mm + range.high_mm) / 2,
                  0,
                  Press{{0, 0, -(range.leastPress_N + range.mostPress_N) / 2}}};
  options.zones = fineZones(design, {.areas = {}, .patches = {}, .indenters = {middle}});
  options.zones.resize(
      std::min<std::size_t>(options.zones.size(), 1)); // not those of a punch's rim: it may be anywhere
  for (FineZone& zone : options.zones) {
    zone.size_mm *= kCellsBesideOneTouch;
    zone.half_mm += (range.high_mm - range.low_mm) / 2;
  }
  options.fineBorders = false;
  return options;
}

bool finerForField(const SensorDesign& design) {
  return design.field() != nullptr && (design.lowerFollowsRubber || design.pressureLaw);
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
    throw DesignError("mesh size " + text(size) + " mm; allowed is at least " + text(std::ceil(1e4 * smallest) / 1e4) +
                      " mm for this block, or there would be more than 1e6 elements");
}

Mesh sensorMesh(const SensorDesign& design, const MeshOptions& options, const std::stop_token& stop) {
  requireMeshable(design, options);
  if (options.mapped) return mappedMesh(design, *options.mapped);
  const double size = options.meshSize_mm.value_or(standardSize(design));
  Grading grading = defaultGrading(design, size);
  if (!options.fineBorders) grading.border_mm = grading.bulk_mm;
  std::vector<FineZone> zones = options.zones;
  for (FineZone& zone : zones) zone.size_mm *= size / standardSize(design);
  Mesh mesh = gradedTets(design, grading, options.discs, zones, options.electrodesAsNodes, stop);
  mesh.size_mm = size;
  return mesh;
}

} // namespace palp
