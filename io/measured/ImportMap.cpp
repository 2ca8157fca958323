#include "io/measured/ImportMap.h"

#include "io/AtomicFile.h"
#include "io/Fingerprint.h"
#include "model/base/NamedEnum.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace palp {

namespace {

constexpr int kNewestMap = 1;
constexpr int kMostWires = 255;
constexpr int kMostAreas = 2500;
constexpr int kMostTables = 16;
constexpr int kLargestColumn = 200'000;

constexpr NamedEnum kDates("order of dates", std::array{std::pair{DateOrder::DayFirst, "day first"},
                                                        std::pair{DateOrder::MonthFirst, "month first"}});
constexpr NamedEnum kDividers("divider", std::array{std::pair{ReadingLaw::Kind::DividerLow, "low"},
                                                    std::pair{ReadingLaw::Kind::DividerHigh, "high"}});
enum class Angle { Radian, Degree };
constexpr NamedEnum kAngles("unit", std::array{std::pair{Angle::Radian, "rad"}, std::pair{Angle::Degree, "deg"}});

ColumnName columnName(const JsonPlace& place) {
  if (place.isString()) return place.string();
  if (!place.isNumber()) place.refuse("the name of a column, or its number from 1");
  return place.integer(1, kLargestColumn);
}

/// A column, or {"column", "factor", "offset"}, or {"sum": [...], "offset"}; null: not measured.
ImportedValue readValue(const JsonPlace& place) {
  if (place.isNull()) return {};
  if (place.isString() || place.isNumber()) return {{{columnName(place)}}};
  const auto number = [](const JsonPlace& of, const char* key, double otherwise) {
    return of.has(key) ? of.at(key).number(-1e12, 1e12) : otherwise;
  };
  ImportedValue value;
  value.offset = number(place, "offset", 0);
  if (!place.has("sum")) {
    place.onlyKeys({"column"}, {"factor", "offset"});
    value.parts.push_back({columnName(place.at("column")), number(place, "factor", 1)});
    return value;
  }
  place.onlyKeys({"sum"}, {"offset"});
  for (const JsonPlace& part : place.at("sum").list()) {
    if (part.isString() || part.isNumber()) {
      value.parts.push_back({columnName(part)});
      continue;
    }
    part.onlyKeys({"column"}, {"factor"});
    value.parts.push_back({columnName(part.at("column")), number(part, "factor", 1)});
  }
  if (value.parts.empty()) place.at("sum").refuse("a list of columns");
  return value;
}

std::vector<ImportedValue> readValues(const JsonPlace& place) {
  std::vector<ImportedValue> all;
  for (const JsonPlace& entry : place.list()) all.push_back(readValue(entry));
  return all;
}

std::vector<ImportedValue> readValues(const JsonPlace& place, std::size_t count) {
  auto all = readValues(place);
  if (all.size() != count) place.refuse("a list of " + std::to_string(count) + " names of columns");
  return all;
}

std::optional<KnownUnit> readUnit(const JsonPlace& place, std::initializer_list<Quantity> quantities) {
  if (!place.has("unit")) return {};
  const auto unit = knownUnit(place.at("unit").string());
  std::string expected;
  for (const Quantity quantity : quantities) {
    if (unit && unit->quantity == quantity) return unit;
    expected += (expected.empty() ? "" : ", ") + unitsOf(quantity);
  }
  place.at("unit").refuse(expected);
}

ImportedClock readClock(const JsonPlace& place) {
  if (place.isString() || place.isNumber()) return {columnName(place), {}};
  place.onlyKeys({"column"}, {"unit", "offset_s"});
  return {columnName(place.at("column")), readUnit(place, {Quantity::Time}),
          place.has("offset_s") ? place.at("offset_s").number(-1e12, 1e12) : 0};
}

/// Which table the values are in, and their clock.
void readTable(const JsonPlace& place, ImportMap& map, ImportedGroup& group) {
  if (place.has("table")) group.table = place.at("table").integer(1, kMostTables) - 1;
  if (place.has("time")) group.clock = readClock(place.at("time"));
  map.tables = std::max(map.tables, group.table + 1);
}

std::string replaced(std::string text, const std::string& mark, int number) {
  if (const std::size_t at = text.find(mark); at != std::string::npos)
    text.replace(at, mark.size(), std::to_string(number));
  return text;
}

/// A list of columns, or one name in which {row} and {column} are replaced by the numbers of the wires.
void readWires(const JsonPlace& place, ImportMap& map) {
  const JsonPlace columns = place.at("columns");
  const auto count = [&place](const char* key, int otherwise) {
    return place.has(key) ? place.at(key).integer(1, kMostWires) : otherwise;
  };
  map.rowWires = count("row_wires", 1);
  map.columnWires = count("column_wires", 1);
  const int first = place.has("first") ? place.at("first").integer(0, 1) : 0;
  if (!columns.isString()) {
    auto& values = map.readings.values = readValues(columns);
    if (values.empty() || values.size() > static_cast<std::size_t>(kMostWires) * kMostWires)
      columns.refuse("a list of 1 or more columns");
    if (!place.has("row_wires") && !place.has("column_wires") && values.size() <= kMostWires)
      map.columnWires = static_cast<int>(values.size());
    const auto expected = static_cast<std::size_t>(map.rowWires) * static_cast<std::size_t>(map.columnWires);
    if (values.size() != expected) columns.refuse("a list of " + std::to_string(expected) + " names of columns");
    for (const ImportedValue& value : values)
      if (value.parts.empty()) columns.refuse("columns without null");
    return;
  }
  const std::string pattern = columns.string();
  if (pattern.find("{column}") == std::string::npos || (map.rowWires > 1 && pattern.find("{row}") == std::string::npos))
    columns.refuse("a list of names, or one name with {row} and {column} in it");
  for (int r = 0; r < map.rowWires; ++r)
    for (int c = 0; c < map.columnWires; ++c)
      map.readings.values.push_back({{{replaced(replaced(pattern, "{row}", first + r), "{column}", first + c)}}});
}

/// Resistances by their unit: "ohm", "uS", "code", or a divider.
void readResistances(const JsonPlace& place, ImportMap& map) {
  place.onlyKeys({"columns"}, {"row_wires", "column_wires", "unit", "first", "ohm_per_code", "zero_ohm", "divider",
                               "full_scale", "resistor_ohm", "table", "time"});
  const bool isCode = place.has("unit") && place.at("unit").string() == "code";
  if (place.has("divider")) {
    for (const char* key : {"unit", "ohm_per_code", "zero_ohm"})
      if (place.has(key)) place.at(key).refuse("nothing next to \"divider\"");
    map.law.kind = place.at("divider").named(kDividers);
    map.law.full = place.at("full_scale").number(1e-12, 1e12);
    map.law.resistor_ohm = place.at("resistor_ohm").number(1e-6, 1e12);
  } else if (isCode) {
    if (!place.has("ohm_per_code")) place.refuse("unit \"code\" with \"ohm_per_code\"");
    map.law.kind = ReadingLaw::Kind::Code;
    map.law.ohmPerCode = place.at("ohm_per_code").number(-1e12, 1e12);
  } else {
    if (place.has("ohm_per_code")) place.refuse("\"ohm_per_code\" only with unit \"code\"");
    map.readings.unit = readUnit(place, {Quantity::Resistance, Quantity::Conductance});
    if (map.readings.unit && map.readings.unit->quantity == Quantity::Conductance)
      map.law.kind = ReadingLaw::Kind::Conductance;
  }
  if (place.has("zero_ohm")) map.law.zero_ohm = place.at("zero_ohm").number(-1e12, 1e12);
  readTable(place, map, map.readings);
  readWires(place, map);
}

void readSignals(const JsonPlace& place, ImportMap& map) {
  place.onlyKeys({"columns"}, {"row_wires", "column_wires", "unit", "first", "table", "time"});
  map.law.kind = ReadingLaw::Kind::Signal;
  if (place.has("unit")) map.signalUnit = place.at("unit").string();
  readTable(place, map, map.readings);
  readWires(place, map);
}

void readForces(const JsonPlace& place, ImportMap& map) {
  place.onlyKeys({"columns"}, {"unit", "signs", "rotation", "table", "time"});
  map.forces_N.unit = readUnit(place, {Quantity::Force});
  map.signsAreGiven = place.has("signs");
  const std::vector<double> signs = map.signsAreGiven ? place.at("signs").numbers(3) : std::vector<double>{1, 1, 1};
  for (const double sign : signs)
    if (sign != 1 && sign != -1) place.at("signs").refuse("three numbers, each 1 or -1");
  map.forces_N.values = readValues(place.at("columns"), 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ImportedValue& value = map.forces_N.values[axis];
    value.offset *= signs[axis];
    for (ImportedValue::Part& part : value.parts) part.factor *= signs[axis];
  }
  readTable(place, map, map.forces_N);
  if (!place.has("rotation")) return;
  const JsonPlace rotation = place.at("rotation");
  rotation.onlyKeys({"columns", "unit"});
  map.rotation = readValues(rotation.at("columns"), 3);
  map.radiansPerUnit = rotation.at("unit").named(kAngles) == Angle::Radian ? 1 : std::numbers::pi / 180;
}

void readPlace(const JsonPlace& place, ImportMap& map) {
  place.onlyKeys({"columns"}, {"unit", "block_mm", "areas", "table", "time"});
  map.places_mm.unit = readUnit(place, {Quantity::Length});
  map.places_mm.values = readValues(place.at("columns"), 2);
  for (const ImportedValue& value : map.places_mm.values)
    if (value.parts.empty()) place.at("columns").refuse("two columns without null");
  readTable(place, map, map.places_mm);
  if (place.has("block_mm") != place.has("areas")) place.refuse("\"block_mm\" and \"areas\", both or none");
  if (!place.has("block_mm")) return;
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

void readArea(const JsonPlace& place, ImportMap& map) {
  place.onlyKeys({"column", "count"}, {"first"});
  map.areaCount = place.at("count").integer(1, kMostAreas);
  const int first = place.has("first") ? place.at("first").integer(0, 1) : 0;
  map.area = ImportedValue{{{columnName(place.at("column"))}}, static_cast<double>(-first)};
}

char readLetter(const JsonPlace& place, std::string_view allowed, const char* expected) {
  const std::string text = place.string();
  if (text.size() != 1 || allowed.find(text[0]) == std::string_view::npos) place.refuse(expected);
  return text[0];
}

void readForm(const JsonPlace& root, TableForm& form) {
  constexpr int mostLines = 250;
  if (root.has("separator"))
    form.separator = readLetter(root.at("separator"), ",;\t ", "\",\", \";\", \"\\t\" or \" \"");
  if (root.has("decimal")) form.decimal = readLetter(root.at("decimal"), ".,", "\".\" or \",\"");
  if (root.has("names_line")) form.namesLine = root.at("names_line").integer(0, mostLines);
  if (root.has("first_line")) form.firstLine = root.at("first_line").integer(1, mostLines);
  if (root.has("dates")) form.dates = root.at("dates").named(kDates);
}

/// Keys that describe how a table is written, in which two tables of one rig may differ.
constexpr std::array kKeysOfTheTable{"separator", "decimal", "names_line", "first_line",    "dates",
                                     "time",      "run",     "bad_rows",   "longest_gap_s", "about"};

} // namespace

std::string shownColumn(const ColumnName& column) {
  if (const int* number = std::get_if<int>(&column)) return "column " + std::to_string(*number);
  return "column \"" + std::get<std::string>(column) + "\"";
}

ImportMap importMapFrom(Json json, const std::string& file) {
  const JsonPlace root(json, file);
  formatVersion(root, "palp_import", kNewestMap);
  root.onlyKeys({"palp_import"},
                {"resistances", "signals", "forces", "separator", "decimal", "names_line", "first_line", "dates",
                 "area", "place", "time", "run", "bad_rows", "longest_gap_s", "about"});
  if (root.has("about")) (void)root.at("about").string();
  ImportMap map;
  readForm(root, map.form);
  if (root.has("resistances") == root.has("signals")) root.refuse("\"resistances\" or \"signals\", one of both");
  if (root.has("resistances"))
    readResistances(root.at("resistances"), map);
  else
    readSignals(root.at("signals"), map);
  if (root.has("forces"))
    readForces(root.at("forces"), map);
  else if (!root.has("place"))
    root.refuse("\"forces\", \"place\", or both");
  if (root.has("area") && root.has("place") && root.at("place").has("areas"))
    root.at("place").refuse("\"area\" or \"place\" with \"areas\", not both");
  if (root.has("area")) readArea(root.at("area"), map);
  if (root.has("place")) readPlace(root.at("place"), map);
  if (root.has("time")) map.time = readClock(root.at("time"));
  if (map.readings.clock) {
    if (map.time) root.at("time").refuse("the time of the readings once: here or next to their columns");
    map.time = map.readings.clock;
  }
  if (root.has("run")) {
    const JsonPlace run = root.at("run");
    if (!run.isString() && !run.isNumber()) run.onlyKeys({"column"});
    map.run = columnName(run.has("column") ? run.at("column") : run);
  }
  if (root.has("longest_gap_s")) map.longestGap_s = root.at("longest_gap_s").number(1e-9, 1e9);
  if (root.has("bad_rows")) {
    const std::string what = root.at("bad_rows").string();
    if (what != "refuse" && what != "leave out") root.at("bad_rows").refuse("\"refuse\" or \"leave out\"");
    map.leaveOutBadRows = what == "leave out";
  }
  for (const ImportedGroup* group : {&map.forces_N, &map.places_mm})
    if (group->clock && !map.time) root.refuse("\"time\" of the readings, to which other values are interpolated");
  for (const char* key : kKeysOfTheTable) json.erase(key);
  map.fingerprint = "measured-" + fingerprint(jsonText(json));
  return map;
}

ImportMap readImportMap(const std::filesystem::path& path) {
  return importMapFrom(parseJson(readFile(path), path.string()), path.string());
}

} // namespace palp
