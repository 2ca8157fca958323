#include "io/measured/ImportMap.h"

#include "io/AtomicFile.h"
#include "io/Fingerprint.h"
#include "io/StrictJson.h"
#include "model/base/NamedEnum.h"

#include <array>

namespace palp {

namespace {

constexpr int kNewestMap = 1;
constexpr int kMostWires = 255;
constexpr int kMostAreas = 2500;

enum class Resistance { Ohm, Kilohm, Megohm, Code };
constexpr NamedEnum
    kResistances("unit", std::array{std::pair{Resistance::Ohm, "ohm"}, std::pair{Resistance::Kilohm, "kohm"},
                                    std::pair{Resistance::Megohm, "Mohm"}, std::pair{Resistance::Code, "code"}});
enum class Force { Newton, Millinewton, Gramforce, Kilogramforce };
constexpr NamedEnum kForces("unit",
                            std::array{std::pair{Force::Newton, "N"}, std::pair{Force::Millinewton, "mN"},
                                       std::pair{Force::Gramforce, "gf"}, std::pair{Force::Kilogramforce, "kgf"}});
enum class Length { Millimetre, Centimetre, Metre, Micrometre };
constexpr NamedEnum kLengths("unit",
                             std::array{std::pair{Length::Millimetre, "mm"}, std::pair{Length::Centimetre, "cm"},
                                        std::pair{Length::Metre, "m"}, std::pair{Length::Micrometre, "um"}});
enum class Duration { Second, Millisecond, Microsecond };
constexpr NamedEnum kDurations("unit",
                               std::array{std::pair{Duration::Second, "s"}, std::pair{Duration::Millisecond, "ms"},
                                          std::pair{Duration::Microsecond, "us"}});

constexpr double kFactors[][4] = {
    {1, 1e3, 1e6, 1}, {1, 1e-3, 9.80665e-3, 9.80665}, {1, 10, 1e3, 1e-3}, {1, 1e-3, 1e-6}};

template <class Names> double factorOf(const JsonPlace& place, const Names& names, const double* factors) {
  return factors[static_cast<std::size_t>(place.at("unit").named(names))];
}

std::vector<std::string> names(const JsonPlace& place, std::size_t count) {
  std::vector<std::string> all;
  for (const JsonPlace& entry : place.list()) all.push_back(entry.string());
  if (all.size() != count) place.refuse("a list of " + std::to_string(count) + " names of columns");
  return all;
}

std::string replaced(std::string text, const std::string& mark, int number) {
  if (const std::size_t at = text.find(mark); at != std::string::npos)
    text.replace(at, mark.size(), std::to_string(number));
  return text;
}

/// A list of names, or one name in which {row} and {column} are replaced by the numbers of the wires.
std::vector<std::string> wireNames(const JsonPlace& resistances, int rows, int columns) {
  const JsonPlace place = resistances.at("columns");
  const int first = resistances.has("first") ? resistances.at("first").integer(0, 1) : 0;
  if (!place.isString()) return names(place, static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  const std::string pattern = place.string();
  if (pattern.find("{row}") == std::string::npos || pattern.find("{column}") == std::string::npos)
    place.refuse("a list of names, or one name with {row} and {column} in it");
  std::vector<std::string> all;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      all.push_back(replaced(replaced(pattern, "{row}", first + r), "{column}", first + c));
  return all;
}

void readResistances(const JsonPlace& place, ImportMap& map) {
  place.onlyKeys({"columns", "row_wires", "column_wires", "unit"}, {"first", "ohm_per_code", "zero_ohm"});
  map.rowWires = place.at("row_wires").integer(1, kMostWires);
  map.columnWires = place.at("column_wires").integer(1, kMostWires);
  const bool codes = place.at("unit").named(kResistances) == Resistance::Code;
  if (codes != place.has("ohm_per_code"))
    place.refuse(codes ? "unit \"code\" with \"ohm_per_code\"" : "\"ohm_per_code\" only with unit \"code\"");
  const double factor =
      codes ? place.at("ohm_per_code").number(-1e12, 1e12) : factorOf(place, kResistances, kFactors[0]);
  const double zero = place.has("zero_ohm") ? place.at("zero_ohm").number(-1e12, 1e12) : 0;
  for (const std::string& name : wireNames(place, map.rowWires, map.columnWires))
    map.resistances_ohm.push_back({name, factor, zero});
}

void readForces(const JsonPlace& place, ImportMap& map) {
  place.onlyKeys({"columns", "unit"}, {"signs"});
  const double factor = factorOf(place, kForces, kFactors[1]);
  const std::vector<double> signs = place.has("signs") ? place.at("signs").numbers(3) : std::vector<double>{1, 1, 1};
  for (const double sign : signs)
    if (sign != 1 && sign != -1) place.at("signs").refuse("three numbers, each 1 or -1");
  const std::vector<std::string> columns = names(place.at("columns"), 3);
  for (std::size_t axis = 0; axis < 3; ++axis) map.forces_N.push_back({columns[axis], factor * signs[axis], 0});
}

void readPlace(const JsonPlace& place, ImportMap& map) {
  place.onlyKeys({"columns", "unit", "block_mm", "areas"});
  const double factor = factorOf(place, kLengths, kFactors[2]);
  for (const std::string& name : names(place.at("columns"), 2)) map.place_mm.push_back({name, factor, 0});
  const std::vector<double> block = place.at("block_mm").numbers(2), areas = place.at("areas").numbers(2);
  map.length_mm = block[0];
  map.width_mm = block[1];
  if (!(block[0] > 0 && block[1] > 0)) place.at("block_mm").refuse("length and width of the top face, above 0");
  for (const double count : areas)
    if (!(count >= 1 && count <= 50) || count != static_cast<int>(count))
      place.at("areas").refuse("areas along x and y, 1 to 50 each");
  map.areaColumns = static_cast<int>(areas[0]);
  map.areaRows = static_cast<int>(areas[1]);
  map.areaCount = map.areaColumns * map.areaRows;
}

char readSeparator(const JsonPlace& place) {
  const std::string text = place.string();
  if (text != "," && text != ";" && text != "\t" && text != " ") place.refuse("\",\", \";\", \"\\t\" or \" \"");
  return text[0];
}

} // namespace

ImportMap readImportMap(const std::filesystem::path& path) {
  Json json = parseJson(readFile(path), path.string());
  const JsonPlace root(json, path.string());
  formatVersion(root, "palp_import", kNewestMap);
  root.onlyKeys({"palp_import", "resistances", "forces"}, {"separator", "area", "place", "time"});
  ImportMap map;
  if (root.has("separator")) map.separator = readSeparator(root.at("separator"));
  readResistances(root.at("resistances"), map);
  readForces(root.at("forces"), map);
  if (root.has("area") && root.has("place")) root.at("place").refuse("\"area\" or \"place\", not both");
  if (root.has("area")) {
    const JsonPlace place = root.at("area");
    place.onlyKeys({"column", "count"}, {"first"});
    map.areaCount = place.at("count").integer(1, kMostAreas);
    const int first = place.has("first") ? place.at("first").integer(0, 1) : 0;
    map.area = ImportedColumn{place.at("column").string(), 1, static_cast<double>(-first)};
  }
  if (root.has("place")) readPlace(root.at("place"), map);
  if (root.has("time")) {
    const JsonPlace place = root.at("time");
    place.onlyKeys({"column", "unit"});
    map.time_s = ImportedColumn{place.at("column").string(), factorOf(place, kDurations, kFactors[3]), 0};
  }
  for (const char* key : {"separator", "time"}) json.erase(key); // two tables of one rig may differ in them
  map.fingerprint = "measured-" + fingerprint(jsonText(json));
  return map;
}

} // namespace palp
