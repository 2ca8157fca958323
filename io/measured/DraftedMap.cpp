#include "io/ImportDraft.h"
#include "io/StrictJson.h"
#include "model/base/Error.h"

#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>

namespace palp {

namespace {

using DraftJson = nlohmann::ordered_json;
using PlacesOf = std::vector<ColumnPlace>;

/// Writes a draft over the map that it was made from.
class DraftedMap {
public:
  DraftedMap(const ImportDraft& draft, const std::vector<TablePreview>& tables)
      : draft_(draft), before_(importDraft(draft.base, tables)), tables_(tables), map_(DraftJson::parse(draft.base)),
        names_(tables.size()) {
    for (std::size_t t = 0; t < tables.size(); ++t)
      for (const TablePreview::Column& column : tables[t].columns) ++names_[t][column.name];
  }

  std::string text() {
    if (placesOf(ColumnMeaning::Reading).empty() && !map_.contains(key(before_.kind)))
      throw Error("no column is a reading yet");
    form();
    readings();
    forces();
    positions();
    if (!map_.contains("forces") && !map_.contains("place")) throw Error("no column is a force or a position yet");
    ofReadings(ColumnMeaning::Time, "time");
    ofReadings(ColumnMeaning::Run, "run");
    ofReadings(ColumnMeaning::Area, "area");
    if (draft_.leaveOutBadRows)
      map_["bad_rows"] = "leave out";
    else
      map_.erase("bad_rows");
    requireAllTables();
    return jsonText(map_, 2) + "\n";
  }

private:
  [[nodiscard]] static const char* key(ReadingKind kind) {
    return kind == ReadingKind::Signal ? "signals" : "resistances";
  }

  [[nodiscard]] PlacesOf placesOf(ColumnMeaning meaning) const { return placesIn(draft_, meaning); }
  [[nodiscard]] static PlacesOf placesIn(const ImportDraft& draft, ColumnMeaning meaning) {
    PlacesOf all;
    for (std::size_t t = 0; t < draft.meanings.size(); ++t)
      for (std::size_t c = 0; c < draft.meanings[t].size(); ++c)
        if (draft.meanings[t][c] == meaning) all.push_back({t, c});
    return all;
  }
  /// Whether other columns have a meaning than in the map.
  [[nodiscard]] bool changed(ColumnMeaning meaning) const { return placesOf(meaning) != placesIn(before_, meaning); }

  /// By its name, or by its number where that is not unique.
  [[nodiscard]] DraftJson column(ColumnPlace place) const {
    const std::string& name = tables_[place.table].columns[place.column].name;
    const bool unique = !name.empty() && names_[place.table].at(name) == 1;
    return unique ? DraftJson(name) : DraftJson(place.column + 1);
  }

  /// "column 3 of F.csv", "Fx of F.csv".
  [[nodiscard]] std::string shown(ColumnPlace place) const {
    const DraftJson named = column(place);
    return (named.is_string() ? named.get<std::string>() : "column " + jsonText(named)) + " of " +
           tables_[place.table].file.filename().string();
  }

  /// The one table that all are in. Throws Error.
  std::size_t tableOf(const char* what, const PlacesOf& places) const {
    for (const ColumnPlace place : places)
      if (place.table != places[0].table)
        throw Error(std::string(what) + ": " + shown(places[0]) + " and " + shown(place) +
                    " are in different tables; expected all in one");
    return places[0].table;
  }

  static void setOrErase(DraftJson& group, const char* key, const std::string& text) {
    if (text.empty())
      group.erase(key);
    else
      group[key] = text;
  }

  static void setTable(DraftJson& group, std::size_t table) {
    if (table > 0)
      group["table"] = table + 1;
    else
      group.erase("table");
  }

  void form() {
    const auto letter = [this](const char* key, char value) {
      setOrErase(map_, key, value == 0 ? std::string() : std::string(1, value));
    };
    letter("separator", draft_.form.separator);
    letter("decimal", draft_.form.decimal);
    const auto line = [this](const char* key, int value, bool given) {
      if (given)
        map_[key] = value;
      else
        map_.erase(key);
    };
    line("names_line", draft_.form.namesLine, draft_.form.namesLine >= 0);
    line("first_line", draft_.form.firstLine, draft_.form.firstLine > 0);
  }

  /// In the order of the map; those that it does not have follow as they are in the tables.
  [[nodiscard]] PlacesOf orderedReadings() const {
    PlacesOf all;
    for (const ColumnPlace place : draft_.readingOrder)
      if (draft_.meaning(place) == ColumnMeaning::Reading) all.push_back(place);
    const std::set<ColumnPlace> ofMap(all.begin(), all.end());
    for (const ColumnPlace place : placesOf(ColumnMeaning::Reading))
      if (!ofMap.contains(place)) all.push_back(place);
    return all;
  }

  void readings() {
    const PlacesOf places = orderedReadings();
    DraftJson group = map_.value(key(before_.kind), DraftJson::object());
    map_.erase("signals");
    map_.erase("resistances");
    if (changed(ColumnMeaning::Reading)) {
      if (places.empty()) throw Error("no column is a reading yet");
      setTable(group, tableOf("readings", places));
      group["columns"] = DraftJson::array();
      for (const ColumnPlace place : places) group["columns"].push_back(column(place));
      group.erase("first");
    }
    if (changed(ColumnMeaning::Reading) || draft_.rowWires != before_.rowWires) wires(group, places.size());
    if (draft_.kind != before_.kind || draft_.readingUnit != before_.readingUnit || lawChanged()) law(group);
    map_[key(draft_.kind)] = std::move(group);
  }

  void wires(DraftJson& group, std::size_t count) const {
    group.erase("row_wires");
    group.erase("column_wires");
    if (draft_.rowWires == 1) return;
    const auto rows = static_cast<std::size_t>(draft_.rowWires);
    if (count % rows != 0)
      throw Error(std::to_string(count) + " readings cannot be of " + std::to_string(rows) +
                  " row-wires with equally many column-wires");
    group["row_wires"] = rows;
    group["column_wires"] = count / rows;
  }

  [[nodiscard]] bool lawChanged() const {
    return draft_.ohmPerCode != before_.ohmPerCode || draft_.zero_ohm != before_.zero_ohm ||
           draft_.fullScale != before_.fullScale || draft_.resistor_ohm != before_.resistor_ohm;
  }

  void law(DraftJson& group) const {
    for (const char* key : {"unit", "ohm_per_code", "zero_ohm", "divider", "full_scale", "resistor_ohm"})
      group.erase(key);
    switch (draft_.kind) {
    case ReadingKind::Signal:
    case ReadingKind::Resistance:
      return setOrErase(group, "unit", draft_.readingUnit);
    case ReadingKind::Code:
      group["unit"] = "code";
      group["ohm_per_code"] = draft_.ohmPerCode;
      if (draft_.zero_ohm != 0) group["zero_ohm"] = draft_.zero_ohm;
      return;
    case ReadingKind::DividerLow:
    case ReadingKind::DividerHigh:
      group["divider"] = draft_.kind == ReadingKind::DividerLow ? "low" : "high";
      group["full_scale"] = draft_.fullScale;
      group["resistor_ohm"] = draft_.resistor_ohm;
    }
  }

  /// The columns of one value: null, one, or a sum.
  [[nodiscard]] DraftJson value(const PlacesOf& places) const {
    if (places.empty()) return nullptr;
    if (places.size() == 1) return column(places[0]);
    DraftJson sum = DraftJson::array();
    for (const ColumnPlace place : places) sum.push_back(column(place));
    return {{"sum", sum}};
  }

  /// A list of values, of which those whose columns did not change stay as the map has them.
  template <std::size_t Count>
  PlacesOf values(DraftJson& group, const std::array<ColumnMeaning, Count>& meanings) const {
    PlacesOf all;
    DraftJson list = DraftJson::array();
    for (std::size_t axis = 0; axis < Count; ++axis) {
      const PlacesOf places = placesOf(meanings[axis]);
      all.insert(all.end(), places.begin(), places.end());
      const bool kept = group.contains("columns") && !changed(meanings[axis]);
      list.push_back(kept ? group["columns"][axis] : value(places));
    }
    group["columns"] = std::move(list);
    return all;
  }

  [[nodiscard]] static bool isEmpty(const DraftJson& group) {
    return std::all_of(group["columns"].begin(), group["columns"].end(),
                       [](const DraftJson& one) { return one.is_null(); });
  }

  /// Of one column; what else a clock of the map has stays.
  void clock(DraftJson& group, ColumnMeaning meaning, std::optional<std::size_t> table) const {
    const PlacesOf places = placesOf(meaning);
    if (changed(meaning) && places.empty()) {
      group.erase("time");
      return;
    }
    if (!places.empty() && table && places[0].table != *table)
      throw Error(kColumnMeanings.name(meaning) + ": " + shown(places[0]) + "; expected a column of " +
                  tables_[*table].file.filename().string() +
                  ", as its values (other tables have \"Time of forces\" and \"Time of positions\")");
    if (!changed(meaning) && (draft_.timeUnit == before_.timeUnit || !group.contains("time"))) return;
    DraftJson& time = group["time"];
    if (!time.is_object()) time = {{"column", time}};
    if (!places.empty()) time["column"] = column(places[0]);
    setOrErase(time, "unit", draft_.timeUnit);
    if (!places.empty() && tables_[places[0].table].columns[places[0].column].date) time.erase("unit");
  }

  void forces() {
    DraftJson group = map_.value("forces", DraftJson::object());
    const PlacesOf all = values(group, std::array{ColumnMeaning::Fx, ColumnMeaning::Fy, ColumnMeaning::Fz});
    map_.erase("forces");
    if (isEmpty(group)) {
      if (!placesOf(ColumnMeaning::ForceTime).empty()) throw Error("no column is a force yet");
      return;
    }
    if (!all.empty()) setTable(group, tableOf("forces", all));
    if (draft_.forceUnit != before_.forceUnit) setOrErase(group, "unit", draft_.forceUnit);
    if (draft_.inverted != before_.inverted) {
      group["signs"] = DraftJson::array();
      for (const bool turned : draft_.inverted) group["signs"].push_back(turned ? -1 : 1);
    }
    clock(group, ColumnMeaning::ForceTime, all.empty() ? std::optional<std::size_t>() : all[0].table);
    rotation(group);
    map_["forces"] = std::move(group);
  }

  void rotation(DraftJson& group) {
    DraftJson turned = group.value("rotation", DraftJson::object());
    const PlacesOf all =
        values(turned, std::array{ColumnMeaning::RotationX, ColumnMeaning::RotationY, ColumnMeaning::RotationZ});
    group.erase("rotation");
    if (isEmpty(turned)) return;
    for (const DraftJson& one : turned["columns"])
      if (one.is_null()) throw Error("the rotation needs three columns, x, y and z");
    if (!all.empty()) requireOfReadings("rotation", all);
    if (!turned.contains("unit") || draft_.degrees != before_.degrees) turned["unit"] = draft_.degrees ? "deg" : "rad";
    group["rotation"] = std::move(turned);
  }

  void positions() {
    DraftJson group = map_.value("place", DraftJson::object());
    const PlacesOf all = values(group, std::array{ColumnMeaning::X, ColumnMeaning::Y});
    map_.erase("place");
    if (isEmpty(group)) {
      if (!placesOf(ColumnMeaning::PositionTime).empty()) throw Error("no columns are positions, x and y, yet");
      return;
    }
    for (const DraftJson& one : group["columns"])
      if (one.is_null()) throw Error("a position needs two columns, x and y");
    if (!all.empty()) setTable(group, tableOf("positions", all));
    if (draft_.positionUnit != before_.positionUnit) setOrErase(group, "unit", draft_.positionUnit);
    clock(group, ColumnMeaning::PositionTime, all.empty() ? std::optional<std::size_t>() : all[0].table);
    map_["place"] = std::move(group);
  }

  void requireOfReadings(const char* what, const PlacesOf& places) const {
    const PlacesOf readings = placesOf(ColumnMeaning::Reading);
    for (const ColumnPlace place : places)
      if (!readings.empty() && place.table != readings[0].table)
        throw Error(std::string(what) + ": " + shown(place) + "; expected a column of " +
                    tables_[readings[0].table].file.filename().string() + ", the table of the readings");
  }

  /// Time, run or area, which are in the table of the readings.
  void ofReadings(ColumnMeaning meaning, const char* name) {
    const PlacesOf readings = placesOf(ColumnMeaning::Reading), places = placesOf(meaning);
    if (meaning == ColumnMeaning::Time) {
      if (DraftJson& group = map_[key(draft_.kind)]; group.contains("time")) {
        map_["time"] = group["time"]; // in one of its two places
        group.erase("time");
      }
      return clock(map_, meaning, readings.empty() ? std::optional<std::size_t>() : readings[0].table);
    }
    requireOfReadings(name, places);
    const bool ofArea = meaning == ColumnMeaning::Area;
    const bool counted = ofArea && (draft_.areaCount != before_.areaCount || draft_.firstArea != before_.firstArea);
    if (!changed(meaning) && !(counted && map_.contains(name))) return;
    if (places.empty() && changed(meaning)) {
      map_.erase(name);
    } else if (ofArea) {
      if (changed(meaning)) map_[name]["column"] = column(places[0]);
      map_[name]["count"] = draft_.areaCount;
      map_[name]["first"] = draft_.firstArea;
    } else {
      map_[name] = column(places[0]);
    }
  }

  /// Tables without a column that is used would be taken for further recordings.
  void requireAllTables() const {
    for (std::size_t t = tables_.size(); t-- > 1;) {
      const auto& meanings = draft_.meanings[t];
      if (std::any_of(meanings.begin(), meanings.end(),
                      [](ColumnMeaning one) { return one != ColumnMeaning::LeftOut; }))
        return;
      throw Error(tables_[t].file.filename().string() + ": none of its columns is used yet");
    }
  }

  const ImportDraft& draft_;
  ImportDraft before_;
  const std::vector<TablePreview>& tables_;
  DraftJson map_;
  std::vector<std::unordered_map<std::string, int>> names_; ///< how often each table has each name
};

} // namespace

std::string mapText(const ImportDraft& draft, const std::vector<TablePreview>& tables) {
  return DraftedMap(draft, tables).text();
}

} // namespace palp
