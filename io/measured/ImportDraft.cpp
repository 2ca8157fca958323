#include "io/ImportDraft.h"

#include "io/measured/ImportMap.h"
#include "model/base/Error.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <unordered_map>

namespace palp {

namespace {

using Places = std::vector<ColumnPlace>;

constexpr std::array kForceAxes{ColumnMeaning::Fx, ColumnMeaning::Fy, ColumnMeaning::Fz};
constexpr std::array kRotationAxes{ColumnMeaning::RotationX, ColumnMeaning::RotationY, ColumnMeaning::RotationZ};
constexpr std::array kPositionAxes{ColumnMeaning::X, ColumnMeaning::Y};

bool isForce(ColumnMeaning meaning) {
  return std::find(kForceAxes.begin(), kForceAxes.end(), meaning) != kForceAxes.end();
}

/// Marks columns of the tables that a map names.
class Marks {
public:
  Marks(ImportDraft& draft, const std::vector<TablePreview>& tables) : draft_(draft), names_(tables.size()) {
    for (std::size_t t = 0; t < tables.size(); ++t)
      for (std::size_t c = 0; c < tables[t].columns.size(); ++c) {
        const auto [at, isNew] = names_[t].try_emplace(tables[t].columns[c].name, c);
        if (!isNew) at->second.reset(); // which names no column
      }
  }

  void add(int table, const ColumnName& column, ColumnMeaning meaning) {
    const auto t = static_cast<std::size_t>(table);
    if (t >= names_.size()) return;
    const auto index = columnOf(column, t);
    if (!index) return;
    draft_.meanings[t][*index] = meaning;
    if (meaning == ColumnMeaning::Reading) draft_.readingOrder.push_back({t, *index});
  }
  void add(int table, const ImportedValue& value, ColumnMeaning meaning) {
    for (const ImportedValue::Part& part : value.parts) add(table, part.column, meaning);
  }
  void add(int table, const std::optional<ImportedClock>& clock, ColumnMeaning meaning) {
    if (!clock) return;
    add(table, clock->column, meaning);
    if (clock->unit && draft_.timeUnit.empty()) draft_.timeUnit = clock->unit->name;
  }

private:
  /// A column by its name, or its number from 1; nothing where the table does not have it once.
  [[nodiscard]] std::optional<std::size_t> columnOf(const ColumnName& column, std::size_t table) const {
    if (const int* number = std::get_if<int>(&column)) {
      const auto index = static_cast<std::size_t>(*number) - 1;
      return index < draft_.meanings[table].size() ? std::optional(index) : std::nullopt;
    }
    const auto found = names_[table].find(std::get<std::string>(column));
    return found == names_[table].end() ? std::nullopt : found->second;
  }

  ImportDraft& draft_;
  std::vector<std::unordered_map<std::string, std::optional<std::size_t>>> names_;
};

std::string unitName(const std::optional<KnownUnit>& unit) {
  return unit ? unit->name : "";
}

void takeReadings(ImportDraft& draft, const ImportMap& map) {
  switch (map.law.kind) {
  case ReadingLaw::Kind::Signal:
    draft.kind = ReadingKind::Signal;
    draft.readingUnit = map.signalUnit;
    return;
  case ReadingLaw::Kind::Resistance:
  case ReadingLaw::Kind::Conductance:
    draft.kind = map.readings.values.empty() ? ReadingKind::Signal : ReadingKind::Resistance;
    draft.readingUnit = unitName(map.readings.unit);
    return;
  case ReadingLaw::Kind::Code:
    draft.kind = ReadingKind::Code;
    draft.ohmPerCode = map.law.ohmPerCode;
    draft.zero_ohm = map.law.zero_ohm;
    return;
  case ReadingLaw::Kind::DividerLow:
  case ReadingLaw::Kind::DividerHigh:
    draft.kind = map.law.kind == ReadingLaw::Kind::DividerLow ? ReadingKind::DividerLow : ReadingKind::DividerHigh;
    draft.fullScale = map.law.full;
    draft.resistor_ohm = map.law.resistor_ohm;
  }
}

TextForm textForm(const TableForm& form) {
  return {form.separator.value_or(0), form.decimal.value_or(0), form.namesLine.value_or(-1),
          form.firstLine.value_or(0)};
}

} // namespace

ImportDraft importDraft(const std::string& mapText, const std::vector<TablePreview>& tables) {
  const std::string file = "the map";
  const Json json = parseJson(mapText, file);
  const ImportMap map = importMapFrom(json, file, true);
  ImportDraft draft;
  draft.base = mapText;
  draft.form = textForm(map.form);
  draft.tables = map.tables;
  for (const TablePreview& table : tables) draft.meanings.emplace_back(table.columns.size(), ColumnMeaning::LeftOut);
  Marks marks(draft, tables);
  const int main = map.readings.table;
  for (const ImportedValue& value : map.readings.values) marks.add(main, value, ColumnMeaning::Reading);
  for (std::size_t axis = 0; axis < map.forces_N.values.size(); ++axis)
    marks.add(map.forces_N.table, map.forces_N.values[axis], kForceAxes[axis]);
  for (std::size_t axis = 0; axis < map.places_mm.values.size(); ++axis)
    marks.add(map.places_mm.table, map.places_mm.values[axis], kPositionAxes[axis]);
  for (std::size_t axis = 0; axis < map.rotation.size(); ++axis)
    marks.add(main, map.rotation[axis], kRotationAxes[axis]);
  if (map.area) marks.add(main, *map.area, ColumnMeaning::Area);
  if (map.run) marks.add(main, *map.run, ColumnMeaning::Run);
  marks.add(main, map.time, ColumnMeaning::Time);
  marks.add(map.forces_N.table, map.forces_N.clock, ColumnMeaning::ForceTime);
  marks.add(map.places_mm.table, map.places_mm.clock, ColumnMeaning::PositionTime);
  takeReadings(draft, map);
  draft.rowWires = std::max(1, map.rowWires);
  draft.forceUnit = unitName(map.forces_N.unit);
  draft.positionUnit = unitName(map.places_mm.unit);
  draft.degrees = map.radiansPerUnit != 1;
  if (map.signsAreGiven)
    for (std::size_t axis = 0; axis < 3; ++axis) draft.inverted[axis] = json["forces"]["signs"][axis] == -1;
  draft.areaCount = map.areaCount;
  if (map.area) draft.firstArea = map.area->offset < 0 ? 1 : 0;
  draft.leaveOutBadRows = map.leaveOutBadRows;
  return draft;
}

namespace {

const TablePreview::Column& columnAt(const std::vector<TablePreview>& tables, ColumnPlace place) {
  return tables[place.table].columns[place.column];
}

/// The unit that the table states for a column, where it is one of the quantity.
std::string statedUnit(const std::vector<TablePreview>& tables, ColumnPlace place,
                       std::initializer_list<Quantity> quantities) {
  const auto unit = knownUnit(columnAt(tables, place).unit);
  return unit && std::find(quantities.begin(), quantities.end(), unit->quantity) != quantities.end() ? unit->name : "";
}

void takeStatedUnits(ImportDraft& draft, const std::vector<TablePreview>& tables, ColumnPlace place,
                     ColumnMeaning meaning) {
  const auto take = [&](std::string& unit, Quantity quantity) {
    if (std::string stated = statedUnit(tables, place, {quantity}); !stated.empty()) unit = std::move(stated);
  };
  if (isForce(meaning)) take(draft.forceUnit, Quantity::Force);
  if (meaning == ColumnMeaning::X || meaning == ColumnMeaning::Y) take(draft.positionUnit, Quantity::Length);
  if (meaning == ColumnMeaning::Time) {
    take(draft.timeUnit, Quantity::Time);
    if (columnAt(tables, place).date) draft.timeUnit.clear();
  }
  if (meaning != ColumnMeaning::Reading) return;
  const std::string stated = statedUnit(tables, place, {Quantity::Resistance, Quantity::Conductance});
  if (stated.empty() || draft.kind == ReadingKind::Resistance) return;
  draft.kind = ReadingKind::Resistance;
  draft.readingUnit = stated;
}

} // namespace

void assign(ImportDraft& draft, const std::vector<TablePreview>& tables, const Places& columns, ColumnMeaning meaning) {
  if (columns.empty()) return;
  const bool many = meaning == ColumnMeaning::Reading || meaning == ColumnMeaning::LeftOut;
  if (!many)
    for (auto& table : draft.meanings) std::replace(table.begin(), table.end(), meaning, ColumnMeaning::LeftOut);
  for (const ColumnPlace place : columns) {
    draft.meanings[place.table][place.column] = meaning;
    takeStatedUnits(draft, tables, place, meaning);
    if (!many && !isForce(meaning)) return; // one column alone
  }
}

namespace {

std::vector<std::string> unitNames(std::initializer_list<Quantity> quantities) {
  std::vector<std::string> names;
  for (const Quantity quantity : quantities) {
    std::string all = unitsOf(quantity);
    if (const std::size_t last = all.find(" or "); last != std::string::npos) all.replace(last, 4, ", ");
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t end = std::min(all.find(", ", at), all.size());
      names.push_back(all.substr(at, end - at));
      at = end + 2;
    }
  }
  return names;
}

} // namespace

std::vector<std::string> resistanceUnits() {
  return unitNames({Quantity::Resistance, Quantity::Conductance});
}

std::vector<std::string> forceUnits() {
  return unitNames({Quantity::Force});
}

std::vector<std::string> lengthUnits() {
  return unitNames({Quantity::Length});
}

std::vector<std::string> timeUnits() {
  return unitNames({Quantity::Time});
}

} // namespace palp
