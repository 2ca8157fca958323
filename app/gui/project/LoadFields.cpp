#include "app/gui/project/ProjectFields.h"

#include "io/DesignFile.h"
#include "io/LoadFile.h"

namespace palp {

namespace {

constexpr Within kAreas{0, 10000}; ///< more than any design has

/// Adds the keys of a force or of a motion.
void write(const std::variant<Press, Motion>& control, Json& object) {
  if (const Press* press = std::get_if<Press>(&control)) {
    object["force_N"] = jsonOf(press->force_N);
  } else {
    object["depth_mm"] = jsonOf(std::get<Motion>(control).depth_mm);
    object["shift_mm"] = jsonOf(std::get<Motion>(control).shift_mm);
  }
}

Json stepsJson(const IndenterPath& path) {
  Json steps = Json::array();
  for (const auto& step : path.steps) write(step, steps.emplace_back(Json::object()));
  return steps;
}

void readSteps(const JsonPlace& place, IndenterPath& path) {
  for (const JsonPlace& step : place.list()) {
    if (path.steps.size() == kMostPathSteps)
      place.refuse("a list of at most " + std::to_string(kMostPathSteps) + " steps");
    if (step.has("force_N")) {
      Press press;
      readJson(step.onlyKeys({"force_N"}).at("force_N"), press.force_N);
      path.steps.emplace_back(press);
    } else {
      step.onlyKeys({"depth_mm", "shift_mm"});
      Motion motion{step.at("depth_mm").number(0, 1e4)};
      readJson(step.at("shift_mm"), motion.shift_mm);
      path.steps.emplace_back(motion);
    }
  }
}

} // namespace

Json jsonOf(const SensorDesign& design) {
  return Json::parse(toJson(design));
}

void readJson(const JsonPlace& place, SensorDesign& design) {
  design = readDesign(place);
}

Json jsonOf(const Indenter& indenter) {
  Json object{{"shape", shapeName(indenter.shape)},
              {"radius_mm", jsonOf(indenter.radius_mm)},
              {"rim_mm", jsonOf(indenter.rim_mm)},
              {"place_mm", jsonOf(indenter.place_mm)},
              {"friction", jsonOf(indenter.friction)}};
  write(indenter.control, object);
  return object;
}

void readJson(const JsonPlace& place, Indenter& indenter) {
  indenter = readIndenter(place);
}

static void describe(JsonFields& fields, AreaLoad& area) {
  fields.field("area", area.area, kAreas);
  fields.field("force_N", area.force_N);
}

static void describe(JsonFields& fields, PatchLoad& patch) {
  fields.field("centre_mm", patch.centre_mm);
  fields.field("radius_mm", patch.radius_mm, Within{0, 1e4});
  fields.field("force_N", patch.force_N);
}

void describe(JsonFields& fields, LoadCase& load) {
  fields.field("areas", load.areas);
  fields.field("patches", load.patches);
  fields.sparse("indenters", load.indenters, {});
}

void describe(JsonFields& fields, IndenterPath& path) {
  fields.field("indenter", path.indenter, kAreas);
  fields.custom(
      "steps", JsonFields::kAlways, [&] { return stepsJson(path); },
      [&](const JsonPlace& place) { readSteps(place, path); });
}

} // namespace palp
