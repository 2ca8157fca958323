#include "app/gui/project/DesignStudiesFile.h"

#include "io/DesignFile.h"
#include "io/LoadFile.h"
#include "io/StrictJson.h"

#include <QJsonArray>
#include <QJsonDocument>

#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr int kMostAreas = 10000; ///< of an area: more than any design has
constexpr std::size_t kMapQuantities = 8;
constexpr double kLargest = 1e12;
constexpr double kUnbounded = -1; ///< stands for infinity, which JSON cannot say

QJsonArray jsonOf(const Eigen::Ref<const Eigen::VectorXd>& values) {
  QJsonArray array;
  for (const double value : values) array.append(value);
  return array;
}

QJsonObject designJson(const SensorDesign& design) {
  return QJsonDocument::fromJson(QByteArray::fromStdString(toJson(design))).object();
}

QJsonArray boundJson(const Eigen::Vector3d& bound) {
  return jsonOf(bound.unaryExpr([](double value) { return std::isfinite(value) ? value : kUnbounded; }));
}

Eigen::Vector3d boundOf(const JsonPlace& place) {
  const std::vector<double> numbers = place.numbers(3);
  Eigen::Vector3d bound(numbers.data());
  if ((bound.array() < 0 && bound.array() != kUnbounded).any()) place.refuse("numbers from 0, or -1 for no bound");
  return bound.unaryExpr(
      [](double value) { return value == kUnbounded ? std::numeric_limits<double>::infinity() : value; });
}

QJsonObject boundsJson(const BoundSummary& bounds) {
  return {{"centre_with_prior_percent", boundJson(bounds.centreWithPrior)},
          {"centre_without_prior_percent", boundJson(bounds.centreWithoutPrior)},
          {"all_with_prior_percent", boundJson(bounds.allWithPrior)},
          {"all_without_prior_percent", boundJson(bounds.allWithoutPrior)}};
}

BoundSummary boundsOf(const JsonPlace& place) {
  place.onlyKeys({"centre_with_prior_percent", "centre_without_prior_percent", "all_with_prior_percent",
                  "all_without_prior_percent"});
  return {boundOf(place.at("centre_with_prior_percent")), boundOf(place.at("centre_without_prior_percent")),
          boundOf(place.at("all_with_prior_percent")), boundOf(place.at("all_without_prior_percent"))};
}

SensorDesign designOf(const JsonPlace& place) {
  const SensorDesign design = readDesign(place);
  if (const auto faults = check(design); !faults.empty())
    place.refuse("a design that can be built: " + faults[0].sentence);
  return design;
}

QJsonObject sweepJson(const DesignSweepSettings& sweep) {
  QJsonObject object{{"number", QString::fromStdString(sweep.number)}, {"values", sweep.values}};
  if (!sweep.proposed) {
    object["from"] = sweep.from;
    object["to"] = sweep.to;
  }
  return object;
}

DesignSweepSettings sweepOf(const JsonPlace& place) {
  place.onlyKeys({"number", "values"}, {"from", "to"});
  DesignSweepSettings sweep;
  sweep.number = place.at("number").string();
  sweep.values = place.at("values").integer(2, 50);
  sweep.proposed = !place.has("from");
  if (!sweep.proposed) {
    sweep.from = place.at("from").number(0, 1e6);
    sweep.to = place.at("to").number(0, 1e6);
  }
  return sweep;
}

QJsonObject curveJson(const DesignSweepCurve& curve) {
  QJsonArray points;
  for (const DesignSweepCurve::Point& point : curve.points)
    points.append(QJsonObject{{"at", point.at}, {"bounds", boundsJson(point.bounds)}});
  return {{"design", designJson(curve.design)},
          {"number", QString::fromStdString(curve.number)},
          {"noise", curve.noise},
          {"points", points},
          {"left", curve.left}};
}

DesignSweepCurve curveOf(const JsonPlace& place) {
  place.onlyKeys({"design", "number", "noise", "points", "left"});
  DesignSweepCurve curve;
  curve.design = designOf(place.at("design"));
  curve.number = place.at("number").string();
  curve.noise = place.at("noise").number(0, 1);
  curve.left = place.at("left").integer(0, 1000);
  for (const JsonPlace& point : place.at("points").list()) {
    point.onlyKeys({"at", "bounds"});
    curve.points.push_back({point.at("at").number(-kLargest, kLargest), boundsOf(point.at("bounds"))});
  }
  if (curve.points.empty()) place.at("points").refuse("a list of at least one point");
  return curve;
}

QJsonObject comparedJson(const DesignsCompared& compared) {
  QJsonArray differences;
  for (const double value : compared.difference_percent) differences.append(value);
  return {{"earlier", designJson(compared.earlier)},
          {"now", designJson(compared.now)},
          {"name", QString::fromStdString(compared.name)},
          {"load", loadJson(compared.load)},
          {"noise", compared.noise},
          {"earlier_bounds", boundsJson(compared.earlierBounds)},
          {"now_bounds", boundsJson(compared.nowBounds)},
          {"words", QString::fromStdString(compared.words)},
          {"rows", compared.rows},
          {"columns", compared.columns},
          {"difference_percent", differences}};
}

DesignsCompared comparedOf(const JsonPlace& place) {
  place.onlyKeys({"earlier", "now", "name", "load", "noise", "earlier_bounds", "now_bounds", "words", "rows", "columns",
                  "difference_percent"});
  DesignsCompared compared;
  compared.earlier = designOf(place.at("earlier"));
  compared.now = designOf(place.at("now"));
  compared.name = place.at("name").string();
  compared.load = loadOf(place.at("load"));
  compared.noise = place.at("noise").number(0, 1);
  compared.earlierBounds = boundsOf(place.at("earlier_bounds"));
  compared.nowBounds = boundsOf(place.at("now_bounds"));
  compared.words = place.at("words").string();
  compared.rows = place.at("rows").integer(0, kMostAreas);
  compared.columns = place.at("columns").integer(0, kMostAreas);
  compared.difference_percent =
      place.at("difference_percent")
          .numbers(static_cast<std::size_t>(compared.rows) * static_cast<std::size_t>(compared.columns));
  return compared;
}

QJsonObject foundJson(const FoundLayout& found) {
  return {{"from", designJson(found.from)},
          {"layout", designJson(found.layout)},
          {"before", boundsJson(found.before)},
          {"after", boundsJson(found.after)},
          {"tried", found.tried}};
}

FoundLayout foundOf(const JsonPlace& place) {
  place.onlyKeys({"from", "layout", "before", "after", "tried"});
  return {designOf(place.at("from")), designOf(place.at("layout")), boundsOf(place.at("before")),
          boundsOf(place.at("after")), place.at("tried").integer(0, 1000000000)};
}

Eigen::Vector3d vectorOf(const JsonPlace& place) {
  const std::vector<double> numbers = place.numbers(3);
  return {numbers[0], numbers[1], numbers[2]};
}

/// The keys that say what an indenter does.
void tell(const std::variant<Press, Motion>& control, QJsonObject& object) {
  if (const Press* press = std::get_if<Press>(&control)) {
    object["force_N"] = jsonOf(press->force_N);
  } else {
    object["depth_mm"] = std::get<Motion>(control).depth_mm;
    object["shift_mm"] = jsonOf(std::get<Motion>(control).shift_mm);
  }
}

QJsonObject indenterJson(const Indenter& indenter) {
  QJsonObject object{{"shape", QString::fromStdString(shapeName(indenter.shape))},
                     {"radius_mm", indenter.radius_mm},
                     {"rim_mm", indenter.rim_mm},
                     {"place_mm", jsonOf(indenter.place_mm)},
                     {"friction", indenter.friction}};
  tell(indenter.control, object);
  return object;
}

} // namespace

QJsonObject pathJson(const IndenterPath& path) {
  QJsonArray steps;
  for (const auto& step : path.steps) {
    QJsonObject object;
    tell(step, object);
    steps.append(object);
  }
  return {{"indenter", path.indenter}, {"steps", steps}};
}

IndenterPath pathOf(const JsonPlace& place) {
  place.onlyKeys({"indenter", "steps"});
  IndenterPath path;
  path.indenter = place.at("indenter").integer(0, kMostAreas);
  for (const JsonPlace& step : place.at("steps").list()) {
    if (path.steps.size() == kMostPathSteps)
      place.at("steps").refuse("a list of at most " + std::to_string(kMostPathSteps) + " steps");
    if (step.has("force_N")) {
      step.onlyKeys({"force_N"});
      path.steps.emplace_back(Press{vectorOf(step.at("force_N"))});
    } else {
      step.onlyKeys({"depth_mm", "shift_mm"});
      const std::vector<double> shift = step.at("shift_mm").numbers(2);
      path.steps.emplace_back(Motion{step.at("depth_mm").number(0, 1e4), {shift[0], shift[1]}});
    }
  }
  return path;
}

QJsonObject loadJson(const LoadCase& load) {
  QJsonArray areas;
  for (const AreaLoad& area : load.areas)
    areas.append(QJsonObject{{"area", area.area}, {"force_N", jsonOf(area.force_N)}});
  QJsonArray patches;
  for (const PatchLoad& patch : load.patches)
    patches.append(QJsonObject{
        {"centre_mm", jsonOf(patch.centre_mm)}, {"radius_mm", patch.radius_mm}, {"force_N", jsonOf(patch.force_N)}});
  QJsonObject object{{"areas", areas}, {"patches", patches}};
  QJsonArray indenters;
  for (const Indenter& indenter : load.indenters) indenters.append(indenterJson(indenter));
  if (!indenters.empty()) object["indenters"] = indenters; // as before where nothing new is in it
  return object;
}

LoadCase loadOf(const JsonPlace& place) {
  place.onlyKeys({"areas", "patches"}, {"indenters"});
  LoadCase load;
  for (const JsonPlace& area : place.at("areas").list()) {
    area.onlyKeys({"area", "force_N"});
    load.areas.push_back({area.at("area").integer(0, kMostAreas), vectorOf(area.at("force_N"))});
  }
  for (const JsonPlace& patch : place.at("patches").list()) {
    patch.onlyKeys({"centre_mm", "radius_mm", "force_N"});
    const std::vector<double> centre = patch.at("centre_mm").numbers(2);
    load.patches.push_back(
        {{centre[0], centre[1]}, patch.at("radius_mm").number(0, 1e4), vectorOf(patch.at("force_N"))});
  }
  if (place.has("indenters"))
    for (const JsonPlace& indenter : place.at("indenters").list()) load.indenters.push_back(readIndenter(indenter));
  return load;
}

namespace {

QJsonObject mapJson(const MapSettings& map) {
  return {{"shape", QString::fromStdString(shapeName(map.shape))},
          {"radius_mm", map.radius_mm},
          {"force_N", map.force_N},
          {"places", map.places},
          {"law", QString::fromStdString(map.law)}};
}

MapSettings mapOf(const JsonPlace& place) {
  place.onlyKeys({"shape", "radius_mm", "force_N", "places", "law"});
  MapSettings map;
  map.shape = place.at("shape").named(kIndenterShapes);
  map.radius_mm = place.at("radius_mm").number(0, 1e4);
  map.force_N = place.at("force_N").number(0, 1e4);
  map.places = place.at("places").integer(2, kMostMapPlaces);
  map.law = place.at("law").string();
  if (!map.law.empty() && map.law != "pairs" && !kReadouts.find(map.law))
    place.at("law").refuse("empty, pairs, or " + kReadouts.allowed());
  return map;
}

QJsonObject mappedJson(const MappedResolution& mapped) {
  QJsonArray values;
  for (const std::vector<double>& quantity : mapped.values)
    values.append(
        jsonOf(Eigen::Map<const Eigen::VectorXd>(quantity.data(), static_cast<Eigen::Index>(quantity.size()))));
  return {{"design", designJson(mapped.design)},
          {"touch", indenterJson(mapped.touch)},
          {"noise", mapped.noise},
          {"low_mm", jsonOf(mapped.low_mm)},
          {"high_mm", jsonOf(mapped.high_mm)},
          {"places", QJsonArray{mapped.places[0], mapped.places[1]}},
          {"contact_radius_mm", mapped.contactRadius_mm},
          {"values", values}};
}

MappedResolution mappedOf(const JsonPlace& place) {
  place.onlyKeys({"design", "touch", "noise", "low_mm", "high_mm", "places", "contact_radius_mm", "values"});
  MappedResolution mapped;
  mapped.design = designOf(place.at("design"));
  mapped.touch = readIndenter(place.at("touch"));
  mapped.noise = place.at("noise").number(0, 1);
  mapped.low_mm = Eigen::Vector2d(place.at("low_mm").numbers(2).data());
  mapped.high_mm = Eigen::Vector2d(place.at("high_mm").numbers(2).data());
  if (!(mapped.high_mm.array() > mapped.low_mm.array()).all()) place.at("high_mm").refuse("a place beyond low_mm");
  const std::vector<JsonPlace> counts = place.at("places").list();
  if (counts.size() != 2) place.at("places").refuse("two whole numbers");
  mapped.places = {counts[0].integer(2, kMostMapPlaces * 100), counts[1].integer(2, kMostMapPlaces * 100)};
  mapped.contactRadius_mm = place.at("contact_radius_mm").number(0, 1e6);
  const std::size_t count = static_cast<std::size_t>(mapped.places[0]) * static_cast<std::size_t>(mapped.places[1]);
  for (const JsonPlace& quantity : place.at("values").list()) mapped.values.push_back(quantity.numbers(count));
  if (mapped.values.size() != kMapQuantities)
    place.at("values").refuse(std::to_string(kMapQuantities) + " lists of numbers");
  return mapped;
}

} // namespace

QJsonObject studiesJson(const DesignStudies& studies) {
  QJsonObject object;
  if (studies.scaleWires) object["scale_wires"] = true;
  if (studies.sweep != DesignSweepSettings{}) object["sweep"] = sweepJson(studies.sweep);
  if (studies.found) object["found_layout"] = foundJson(*studies.found);
  if (studies.curve) object["sweep_curve"] = curveJson(*studies.curve);
  if (studies.compared) object["comparison"] = comparedJson(*studies.compared);
  if (studies.map != MapSettings{}) object["map"] = mapJson(studies.map);
  if (studies.mapped) object["mapped_resolution"] = mappedJson(*studies.mapped);
  return object;
}

DesignStudies studiesOf(const JsonPlace& place) {
  place.onlyKeys({}, {"scale_wires", "sweep", "found_layout", "sweep_curve", "comparison", "map", "mapped_resolution"});
  DesignStudies studies;
  if (place.has("scale_wires")) studies.scaleWires = place.at("scale_wires").boolean();
  if (place.has("sweep")) studies.sweep = sweepOf(place.at("sweep"));
  if (place.has("found_layout")) studies.found = foundOf(place.at("found_layout"));
  if (place.has("sweep_curve")) studies.curve = curveOf(place.at("sweep_curve"));
  if (place.has("comparison")) studies.compared = comparedOf(place.at("comparison"));
  if (place.has("map")) studies.map = mapOf(place.at("map"));
  if (place.has("mapped_resolution")) studies.mapped = mappedOf(place.at("mapped_resolution"));
  return studies;
}

} // namespace palp
