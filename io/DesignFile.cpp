#include "io/DesignFile.h"

#include "io/AtomicFile.h"
#include "io/Fingerprint.h"
#include "io/StrictJson.h"
#include "model/DesignError.h"
#include "model/base/Error.h"
#include "model/base/NamedEnum.h"
#include "model/base/Text.h"

#include <array>
#include <variant>

namespace palp {

namespace {

constexpr int kNewestDesign = 1;

std::string list(const std::vector<double>& values) {
  std::string all = "[";
  for (const double value : values) all += (all.size() == 1 ? "" : ", ") + text(value);
  return all + "]";
}

std::string list(const Eigen::Vector3d& v) {
  return list(std::vector<double>{v.x(), v.y(), v.z()});
}

std::string listOfLists(const std::vector<std::vector<double>>& lists) {
  std::string all = "[";
  for (const std::vector<double>& entry : lists) all += (all.size() == 1 ? "" : ", ") + list(entry);
  return all + "]";
}

/// One list for all wires, or a list per wire.
std::string positions(const std::vector<std::vector<double>>& along) {
  return along.size() == 1 ? list(along[0]) : listOfLists(along);
}

/// One depth for all, or a list per wire.
std::string depths(const std::vector<std::vector<double>>& z) {
  return z.size() == 1 && z[0].size() == 1 ? text(z[0][0]) : listOfLists(z);
}

std::string pressureLaw(const std::optional<PressureLaw>& law) {
  if (!law) return "null";
  return R"({ "p0_MPa": )" + text(law->p0_MPa) + R"(, "exponent": )" + text(law->exponent) + " }";
}

/// The kinds of ResistanceLaw in the order of its alternatives; pairs need not be named.
enum class LawKind { Pairs, Field };
constexpr NamedEnum kLaws("law", std::array{std::pair{LawKind::Pairs, "pairs"}, std::pair{LawKind::Field, "field"}});

std::string numbersOf(const PairsLaw& law) {
  return R"("rate_ohm_per_mm": )" + text(law.rate_ohm_per_mm);
}

std::string numbersOf(const FieldLaw& law) {
  return R"("law": "field", "resistivity_ohm_mm": )" + text(law.resistivity_ohm_mm) + R"(, "electrode_radius_mm": )" +
         text(law.electrodeRadius_mm) + R"(, "contact_ohm_mm2": )" + text(law.contact_ohm_mm2) + R"(, "wire_ohm": )" +
         text(law.wire_ohm) + R"(, "readout": ")" + kReadouts.name(law.readout) + "\"";
}

std::string resistance(const SensorDesign& design) {
  return R"({ )" + std::visit([](const auto& law) { return numbersOf(law); }, design.resistance) +
         R"(, "pressure_law": )" + pressureLaw(design.pressureLaw) + " }";
}

std::string numbersOf(const MooneyRivlin& law) {
  return "\"c10_MPa\": " + text(law.c10_MPa) + ", \"c01_MPa\": " + text(law.c01_MPa);
}

std::string numbersOf(const NeoHooke& law) {
  return "\"law\": \"neo-hooke\", \"c10_MPa\": " + text(law.c10_MPa);
}

std::string numbersOf(const Yeoh& law) {
  return "\"law\": \"yeoh\", \"c10_MPa\": " + text(law.c10_MPa) + ", \"c20_MPa\": " + text(law.c20_MPa) +
         ", \"c30_MPa\": " + text(law.c30_MPa);
}

std::string numbersOf(const Gent& law) {
  return "\"law\": \"gent\", \"mu_MPa\": " + text(law.mu_MPa) + ", \"jm\": " + text(law.jm);
}

std::string numbersOf(const Ogden& law) {
  return "\"law\": \"ogden\", \"mu_MPa\": " + list(law.mu_MPa) + ", \"alpha\": " + list(law.alpha);
}

std::string range(const ForceRange& forces, int axis) {
  return list(std::vector<double>{forces.low_N(axis), forces.high_N(axis)});
}

std::vector<std::vector<double>> readPositions(const JsonPlace& place) {
  if (!place.isListOfLists()) return {place.numbers()};
  std::vector<std::vector<double>> lists;
  for (const JsonPlace& entry : place.list()) lists.push_back(entry.numbers());
  return lists;
}

std::vector<std::vector<double>> readDepths(const JsonPlace& place) {
  if (place.isNumber()) return {{place.number()}};
  if (!place.isListOfLists()) place.refuse("one depth in mm, or a list of depths for each wire");
  return readPositions(place);
}

ElectrodeLayer readLayer(const JsonPlace& place, const char* wire, const char* along) {
  ElectrodeLayer layer;
  layer.wire_mm = place.at(wire).numbers();
  layer.along_mm = readPositions(place.at(along));
  layer.z_mm = readDepths(place.at("z_mm"));
  return layer;
}

Eigen::Vector3d readVector3(const JsonPlace& place) {
  const std::vector<double> v = place.numbers(3);
  return {v[0], v[1], v[2]};
}

RubberLaw readRubberLaw(const JsonPlace& place, RubberLawKind kind) {
  // "law" may be left out for Mooney-Rivlin alone, as files had no other law once.
  const auto only = [&](std::vector<std::string> keys) {
    keys.insert(keys.end(), {"poisson_ratio", "density_t_per_mm3"});
    if (kind == RubberLawKind::MooneyRivlin)
      place.onlyKeys(keys, {"law"});
    else
      place.onlyKeys((keys.emplace_back("law"), keys));
  };
  const auto number = [&](const char* key) { return place.at(key).number(); };
  switch (kind) {
  case RubberLawKind::MooneyRivlin:
    only({"c10_MPa", "c01_MPa"});
    return MooneyRivlin{number("c10_MPa"), number("c01_MPa")};
  case RubberLawKind::NeoHooke:
    only({"c10_MPa"});
    return NeoHooke{number("c10_MPa")};
  case RubberLawKind::Yeoh:
    only({"c10_MPa", "c20_MPa", "c30_MPa"});
    return Yeoh{number("c10_MPa"), number("c20_MPa"), number("c30_MPa")};
  case RubberLawKind::Gent:
    only({"mu_MPa", "jm"});
    return Gent{number("mu_MPa"), number("jm")};
  case RubberLawKind::Ogden:
    only({"mu_MPa", "alpha"});
    return Ogden{place.at("mu_MPa").numbers(), place.at("alpha").numbers()};
  }
  return {};
}

Material readMaterial(const JsonPlace& place) {
  const RubberLawKind kind = place.has("law") ? place.at("law").named(kRubberLaws) : RubberLawKind::MooneyRivlin;
  return {readRubberLaw(place, kind), place.at("poisson_ratio").number(), place.at("density_t_per_mm3").number()};
}

std::optional<PressureLaw> readPressureLaw(const JsonPlace& place) {
  if (place.isNull()) return {};
  place.onlyKeys({"p0_MPa", "exponent"});
  return PressureLaw{place.at("p0_MPa").number(), place.at("exponent").number()};
}

ResistanceLaw readResistance(const JsonPlace& place) {
  const LawKind kind = place.has("law") ? place.at("law").named(kLaws) : LawKind::Pairs;
  if (kind == LawKind::Pairs) {
    place.onlyKeys({"rate_ohm_per_mm", "pressure_law"}, {"law"});
    return PairsLaw{place.at("rate_ohm_per_mm").number()};
  }
  place.onlyKeys(
      {"law", "resistivity_ohm_mm", "electrode_radius_mm", "contact_ohm_mm2", "wire_ohm", "readout", "pressure_law"});
  return FieldLaw{place.at("resistivity_ohm_mm").number(), place.at("electrode_radius_mm").number(),
                  place.at("contact_ohm_mm2").number(), place.at("wire_ohm").number(),
                  place.at("readout").named(kReadouts)};
}

ForceRange readForceRange(const JsonPlace& place) {
  place.onlyKeys({"x", "y", "z"});
  ForceRange forces;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> ends = place.at(std::string(1, "xyz"[axis])).numbers(2);
    forces.low_N(axis) = ends[0];
    forces.high_N(axis) = ends[1];
  }
  return forces;
}

} // namespace

SensorDesign readDesign(const JsonPlace& root) {
  formatVersion(root, "palp_design", kNewestDesign); // first: a newer file may well have other keys
  root.onlyKeys(
      {"palp_design", "block_mm", "material", "areas", "upper_layer", "lower_layer", "resistance", "force_range_N"});
  SensorDesign design;
  design.block_mm = readVector3(root.at("block_mm"));
  design.material = readMaterial(root.at("material"));
  const JsonPlace areas = root.at("areas").onlyKeys({"columns", "rows"});
  design.areas = {areas.at("columns").integer(), areas.at("rows").integer()};
  const JsonPlace upper = root.at("upper_layer").onlyKeys({"z_mm", "row_wire_y_mm", "electrode_x_mm"});
  design.upper = readLayer(upper, "row_wire_y_mm", "electrode_x_mm");
  const JsonPlace lower =
      root.at("lower_layer").onlyKeys({"z_mm", "column_wire_x_mm", "electrode_y_mm", "follows_rubber"});
  design.lower = readLayer(lower, "column_wire_x_mm", "electrode_y_mm");
  design.lowerFollowsRubber = lower.at("follows_rubber").boolean();
  const JsonPlace resistance = root.at("resistance");
  design.resistance = readResistance(resistance);
  design.pressureLaw = readPressureLaw(resistance.at("pressure_law"));
  design.forceRange = readForceRange(root.at("force_range_N"));
  return design;
}

std::string materialJson(const Material& material) {
  return "{ " + std::visit([](const auto& law) { return numbersOf(law); }, material.law) +
         ", \"poisson_ratio\": " + text(material.poissonRatio) +
         ", \"density_t_per_mm3\": " + text(material.density_t_per_mm3) + " }";
}

std::string toJson(const SensorDesign& d) {
  std::string json = "{ \"palp_design\": 1,\n";
  json += "  \"block_mm\": " + list(d.block_mm) + ",\n";
  json += "  \"material\": " + materialJson(d.material) + ",\n";
  json += "  \"areas\": { \"columns\": " + std::to_string(d.areas.columns) +
          ", \"rows\": " + std::to_string(d.areas.rows) + " },\n";
  json += "  \"upper_layer\": { \"z_mm\": " + depths(d.upper.z_mm) +
          ",\n    \"row_wire_y_mm\": " + list(d.upper.wire_mm) +
          ",\n    \"electrode_x_mm\": " + positions(d.upper.along_mm) + " },\n";
  json += "  \"lower_layer\": { \"z_mm\": " + depths(d.lower.z_mm) +
          ",\n    \"column_wire_x_mm\": " + list(d.lower.wire_mm) +
          ",\n    \"electrode_y_mm\": " + positions(d.lower.along_mm) +
          ",\n    \"follows_rubber\": " + (d.lowerFollowsRubber ? "true" : "false") + " },\n";
  json += "  \"resistance\": " + resistance(d) + ",\n";
  json += "  \"force_range_N\": { \"x\": " + range(d.forceRange, 0) + ", \"y\": " + range(d.forceRange, 1) +
          ", \"z\": " + range(d.forceRange, 2) + " } }\n";
  return json;
}

SensorDesign parseDesign(std::string_view json, const std::string& file) {
  const Json value = parseJson(json, file);
  const JsonPlace root(value, file);
  if (!root.has("palp_design")) throw Error(file + ": not a design file of Palp: palp_design is missing");
  return readDesign(root);
}

SensorDesign loadDesign(const std::filesystem::path& path) {
  SensorDesign design = parseDesign(readFile(path), path.string());
  const std::vector<DesignFault> problems = check(design);
  if (!problems.empty()) throw DesignError(path.string() + ": " + problems[0].key + ": " + problems[0].sentence);
  return design;
}

void saveDesign(const std::filesystem::path& path, const SensorDesign& design, bool force) {
  requireValid(design);
  writeFile(path, toJson(design), force);
}

std::string designFingerprint(const SensorDesign& design) {
  std::string json = toJson(design);
  std::erase_if(json, [](char c) { return c == ' ' || c == '\n'; });
  return fingerprint(json);
}

} // namespace palp
