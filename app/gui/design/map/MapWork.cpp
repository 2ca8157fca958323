#include "app/gui/design/map/MapWork.h"

#include "app/study/reports/map/MapQuantities.h"
#include "model/DesignError.h"
#include "model/TouchRange.h"
#include "model/base/NumberText.h"
#include "solver/MeshCost.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>

namespace palp {

namespace {

constexpr double kNowhere = -1; ///< in files, for not a number, which JSON cannot represent

/// To six digits: a project holds thousands of them.
double kept(double value) {
  if (!std::isfinite(value)) return kNowhere;
  return numberIn(withDigits(value, 6)).value_or(kNowhere);
}

TouchRange rangeFor(const SensorDesign& design, const Indenter& touch) {
  TouchRange range = touchesOf(design);
  const double force_N = -touch.press()->force_N.z();
  range.shape = touch.shape;
  range.rim_mm = touch.rim_mm;
  range.smallest_mm = std::min(range.smallest_mm, touch.radius_mm);
  range.largest_mm = std::max(range.largest_mm, touch.radius_mm);
  range.leastPress_N = std::min(range.leastPress_N, force_N);
  range.mostPress_N = std::max(range.mostPress_N, force_N);
  return range;
}

std::vector<std::string> ticks(double low_mm, double high_mm, int count) {
  std::vector<std::string> words;
  for (int i = 0; i < count; ++i)
    words.push_back(text(std::round(100 * (low_mm + (high_mm - low_mm) * i / (count - 1))) / 100));
  return words;
}

ColorScale colorsOf(const Eigen::MatrixXd& values, const MapQuantity& quantity) {
  const auto all = values.reshaped();
  return fittingScale(ColorMap::Viridis, {all.begin(), all.end()}, quantity.name, quantity.unit);
}

std::string titleOf(const MappedResolution& map, const MapQuantity& quantity) {
  const FieldLaw* law = map.design.field();
  std::string readout = law != nullptr ? kReadouts.name(law->readout) : "";
  std::replace(readout.begin(), readout.end(), '_', ' ');
  std::string size = map.touch.shape == IndenterShape::Plane ? "" : " of " + text(map.touch.radius_mm) + " mm";
  std::string words = quantity.name + ", " + shapeName(map.touch.shape) + size + ", " +
                      text(-map.touch.press()->force_N.z()) + " N, " +
                      (law != nullptr ? "field, " + readout : "Eq. (1)");
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  return words;
}

} // namespace

SensorDesign mappedDesign(const SensorDesign& design, const MapSettings& settings) {
  SensorDesign mapped = design;
  if (settings.law == "pairs") {
    if (design.field() != nullptr) mapped.resistance = PairsLaw{}; // its rate does not matter in ln R
  } else if (const auto readout = kReadouts.find(settings.law)) {
    FieldLaw law = design.field() != nullptr ? *design.field() : FieldLaw{};
    law.readout = *readout;
    mapped.resistance = law;
  }
  return mapped;
}

Indenter mappedTouch(const SensorDesign& design, const MapSettings& settings) {
  const TouchRange usual = touchesOf(design);
  Indenter touch;
  touch.shape = settings.shape;
  touch.radius_mm = settings.radius_mm > 0 ? settings.radius_mm : (usual.smallest_mm + usual.largest_mm) / 2;
  if (touch.shape == IndenterShape::Flat) touch.rim_mm = 0.1 * touch.radius_mm;
  touch.place_mm = 0.5 * design.block_mm.head<2>();
  const double force_N = settings.force_N > 0 ? settings.force_N : (usual.leastPress_N + usual.mostPress_N) / 2;
  touch.control = Press{{0, 0, -force_N}};
  return touch;
}

MapFound mapResolution(const SensorDesign& design, const MeshOptions& mesh, const MapSettings& settings, double noise,
                       const std::shared_ptr<const MapBasis>& before, const ReportProgress& progress,
                       const std::stop_token& stop) {
  const SensorDesign mapped = mappedDesign(design, settings);
  const Indenter touch = mappedTouch(design, settings);
  const TouchRange range = rangeFor(mapped, touch);
  if (const auto wrong = whyInvalid(range, mapped)) throw DesignError("the map: " + *wrong);
  TouchMapRequest request;
  request.touch = touch;
  request.low_mm = range.low_mm;
  request.high_mm = range.high_mm;
  request.relativeNoise = noise;
  const double step_mm = mapped.block_mm.head<2>().minCoeff() / (settings.places - 1);
  for (Eigen::Index axis = 0; axis < 2; ++axis)
    request.places[static_cast<std::size_t>(axis)] =
        std::max(2, static_cast<int>(std::round((range.high_mm - range.low_mm)(axis) / step_mm)) + 1);
  const MeshOptions meshing = meshForTouches(mapped, range, mesh);
  MapFound found;
  if (before && before->design == mapped && before->mesh == meshing) {
    found.basis = before;
  } else {
    progress(0, "readings at rest");
    const LinearReadings readings = readingsAtRest(mapped, 0, stop);
    progress(0.2, "mesh and factorisation" + costInBrief(meshCost(mapped, meshing)));
    const HyperelasticProblem problem(mapped, sensorMesh(mapped, meshing, stop));
    if (problem.findFactor(0, stop) == 0) return {};
    progress(0.4, "influence surfaces");
    auto surfaces = InfluenceSurfaces::find(problem, readings, 0, stop);
    if (!surfaces) return {};
    problem.releaseFactor();
    found.basis = std::make_shared<const MapBasis>(MapBasis{mapped, meshing, std::move(*surfaces)});
  }
  progress(0.7, "bounds at each position");
  const TouchMap map = touchMap(found.basis->surfaces, request, 0, stop);
  found.map = {mapped, touch, noise, request.low_mm, request.high_mm, request.places, map.contactRadius_mm, {}};
  for (const MapQuantity& quantity : mapQuantities()) {
    const auto all = quantity.of(map).reshaped();
    std::vector<double>& values = found.map.values.emplace_back();
    std::transform(all.begin(), all.end(), std::back_inserter(values), kept);
  }
  return found;
}

Eigen::MatrixXd valuesOf(const MappedResolution& map, std::size_t quantity) {
  const Eigen::Map<const Eigen::MatrixXd> values(map.values[quantity].data(), map.places[0], map.places[1]);
  return values.unaryExpr(
      [](double value) { return value == kNowhere ? std::numeric_limits<double>::quiet_NaN() : value; });
}

FaceMap faceMap(const MappedResolution& map, std::size_t quantity) {
  const MapQuantity& its = mapQuantities()[quantity];
  FaceMap face{valuesOf(map, quantity), map.low_mm, map.high_mm, {}, titleOf(map, its)};
  face.colors = colorsOf(face.values, its);
  return face;
}

HeatmapSpec mapHeatmap(const MappedResolution& map, std::size_t quantity) {
  const MapQuantity& its = mapQuantities()[quantity];
  HeatmapSpec spec;
  spec.title = titleOf(map, its);
  spec.values = valuesOf(map, quantity).transpose();
  spec.colors = colorsOf(spec.values, its);
  spec.columnLabel = "x [mm]";
  spec.rowLabel = "y [mm]";
  spec.columnTicks = ticks(map.low_mm.x(), map.high_mm.x(), map.places[0]);
  spec.rowTicks = ticks(map.low_mm.y(), map.high_mm.y(), map.places[1]);
  return spec;
}

} // namespace palp
