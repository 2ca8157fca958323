#include "io/ImportDraft.h"
#include "io/ImportSamples.h"
#include "io/StrictJson.h"
#include "io/measured/Units.h"
#include "model/base/Error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>

namespace palp {

namespace fs = std::filesystem;

namespace {

using OrderedJson = nlohmann::ordered_json;

/// A column of one of the tables.
struct NamedColumn {
  int table = 1;
  std::string name;
  std::string bare; ///< in lower case, without its unit and signs
  std::optional<KnownUnit> unit;
  bool date = false;
};

std::string bareName(std::string_view name) {
  std::string bare;
  for (const char letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0)
      bare.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(letter))));
  return bare;
}

/// The name without the unit at its end.
std::string_view withoutUnit(std::string_view name) {
  if (!unitInName(name)) return name;
  const std::size_t at = name.find_last_of("[(_/ ");
  return name.substr(0, at);
}

/// Those with names; of tables that repeat the columns of the first one, which are further runs, none.
std::vector<NamedColumn> columnsOf(const std::vector<TablePreview>& tables) {
  std::vector<NamedColumn> all;
  const auto names = [](const TablePreview& table) {
    std::vector<std::string> of;
    for (const TablePreview::Column& column : table.columns) of.push_back(column.name);
    return of;
  };
  for (std::size_t t = 0; t < tables.size(); ++t) {
    if (t > 0 && names(tables[t]) == names(tables[0])) continue;
    for (const auto& [name, unit, date] : tables[t].columns)
      if (!name.empty())
        all.push_back({static_cast<int>(t) + 1, name, bareName(withoutUnit(name)), knownUnit(unit), date});
  }
  return all;
}

class Guess {
public:
  explicit Guess(std::vector<NamedColumn> columns) : columns_(std::move(columns)) {}

  /// As far as the names decide: `missing` of the result is what they do not.
  GuessedMap map(const fs::path& table) {
    OrderedJson map{{"palp_import", 1}};
    const auto fx = take({"fx", "forcex", "xforce", "shearx"}), fy = take({"fy", "forcey", "yforce", "sheary"});
    auto fz = take({"fz", "forcez", "zforce", "normalforce", "fn"});
    if (!fz && !fx && !fy) fz = take({"force", "f", "load", "kraft", "forcen"});
    const auto x = take({"x", "posx", "xpos", "px", "positionx", "xposition"});
    const auto y = take({"y", "posy", "ypos", "py", "positiony", "yposition"});
    takeTimes();
    const auto run = take({"run", "trial", "session", "recording", "experiment"});
    readings(map, table);
    if (fx || fy || fz) forces(map, fx, fy, fz);
    if (x && y) place(map, *x, *y);
    if (!map.contains("forces") && !map.contains("place")) miss(table, "forces (Fx, Fy, Fz or F) or positions (x, y)");
    if (const auto time = times_.find(readingsTable_); time != times_.end()) map["time"] = clock(time->second);
    if (run) map["run"] = run->name;
    return {jsonText(map, 2) + "\n", assumed_, missing_};
  }

private:
  std::optional<NamedColumn> take(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
      const auto found =
          std::find_if(columns_.begin(), columns_.end(), [name](const NamedColumn& one) { return one.bare == name; });
      if (found == columns_.end()) continue;
      NamedColumn column = *found;
      columns_.erase(found);
      return column;
    }
    return {};
  }

  /// The first column of each table that is named as a time.
  void takeTimes() {
    while (const auto time = take({"t", "time", "timestamp", "times", "zeit", "elapsed", "elapsedtime", "datetime"}))
      times_.try_emplace(time->table, *time);
  }

  void miss(const fs::path& table, const std::string& what) {
    if (!missing_.empty()) return;
    std::string names;
    for (const NamedColumn& column : columns_) {
      if (names.size() > 100) {
        names += ", ...";
        break;
      }
      names += (names.empty() ? "" : ", ") + column.name.substr(0, 40);
    }
    missing_ = table.string() + ": no columns are named as " + what +
               (names.empty() ? "" : "; the others are " + names) + ". A map (--map) states their meaning";
  }

  /// Which table the group is in, and its own clock where that is not the readings' table.
  void addTable(OrderedJson& group, int table) {
    if (table > 1) group["table"] = table;
    const auto time = times_.find(table);
    if (table != readingsTable_ && time != times_.end() && times_.contains(readingsTable_))
      group["time"] = clock(time->second);
  }

  void unitOf(OrderedJson& group, const NamedColumn& column, Quantity quantity, const char* otherwise,
              const char* what) {
    const bool known = column.unit && column.unit->quantity == quantity;
    group["unit"] = known ? column.unit->name : otherwise;
    assumed_.push_back(std::string(what) + ": " + column.name + (known ? ", in " : ", whose unit is not stated, in ") +
                       group["unit"].get<std::string>());
  }

  void forces(OrderedJson& map, const std::optional<NamedColumn>& fx, const std::optional<NamedColumn>& fy,
              const std::optional<NamedColumn>& fz) {
    OrderedJson group;
    const NamedColumn* any = nullptr;
    for (const auto* column : {&fx, &fy, &fz}) {
      group["columns"].push_back(*column ? OrderedJson((*column)->name) : OrderedJson(nullptr));
      if (*column && any == nullptr) any = &**column;
    }
    unitOf(group, *any, Quantity::Force, "N", "forces");
    addTable(group, any->table);
    map["forces"] = group;
  }

  void place(OrderedJson& map, const NamedColumn& x, const NamedColumn& y) {
    OrderedJson group{{"columns", {x.name, y.name}}};
    unitOf(group, x, Quantity::Length, "mm", "positions");
    addTable(group, x.table);
    map["place"] = group;
  }

  OrderedJson clock(const NamedColumn& time) {
    OrderedJson group{{"column", time.name}};
    const bool known = time.unit && time.unit->quantity == Quantity::Time;
    if (known || !time.date) group["unit"] = known ? time.unit->name : "s";
    assumed_.push_back("time: " + time.name +
                       (known       ? ", in "
                        : time.date ? ", dates"
                                    : ", whose unit is not stated, in ") +
                       (known || !time.date ? group["unit"].get<std::string>() : ""));
    return group;
  }

  /// Columns whose names are one text and then one or two numbers: R0_3, ch1, V15.
  struct Family {
    std::vector<std::pair<std::array<int, 2>, const NamedColumn*>> members;
    bool grid = false;
  };

  static std::optional<std::pair<std::string, std::vector<int>>> numbersIn(std::string_view name) {
    std::string letters;
    std::vector<int> numbers;
    for (std::size_t i = 0; i < name.size();) {
      if (std::isdigit(static_cast<unsigned char>(name[i])) == 0) {
        if (!numbers.empty() && std::isalpha(static_cast<unsigned char>(name[i])) != 0) letters += '#';
        letters.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(name[i++]))));
        continue;
      }
      int number = 0;
      const auto [end, error] = std::from_chars(name.data() + i, name.data() + name.size(), number);
      if (error != std::errc()) return {};
      numbers.push_back(number);
      i = static_cast<std::size_t>(end - name.data());
    }
    if (numbers.empty() || numbers.size() > 2) return {};
    return std::pair{letters, numbers};
  }

  void readings(OrderedJson& map, const fs::path& table) {
    std::map<std::pair<std::string, std::size_t>, Family> families;
    for (const NamedColumn& column : columns_) {
      const auto parts = numbersIn(withoutUnit(column.name));
      if (!parts) continue;
      Family& family = families[{parts->first, parts->second.size()}];
      family.grid = parts->second.size() == 2;
      family.members.push_back({{family.grid ? parts->second[0] : 0, parts->second.back()}, &column});
    }
    const Family* largest = nullptr;
    for (const auto& [key, family] : families)
      if (largest == nullptr || family.members.size() > largest->members.size()) largest = &family;
    if (largest != nullptr) return family(map, *largest, table);
    for (const char* name :
         {"resistance", "r", "signal", "adc", "voltage", "v", "counts", "capacitance", "reading", "sensor"})
      if (const auto one = take({name})) {
        Family single{{{{0, 0}, &*one}}};
        return family(map, single, table);
      }
    miss(table, "readings (R0_3, ch1, V0)");
  }

  void family(OrderedJson& map, Family family, const fs::path& table) {
    std::stable_sort(family.members.begin(), family.members.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto& [first, one] = family.members.front();
    const auto& last = family.members.back().first;
    const int rows = last[0] - first[0] + 1;
    OrderedJson group;
    for (const auto& [at, column] : family.members) group["columns"].push_back(column->name);
    const std::size_t count = family.members.size();
    if (family.grid && count % static_cast<std::size_t>(rows) == 0) {
      group["row_wires"] = rows;
      group["column_wires"] = count / static_cast<std::size_t>(rows);
    } else if (count > 255) {
      return miss(table, "readings of a complete grid (R0_0 to R9_29)");
    }
    const bool ohm = one->unit && one->unit->quantity == Quantity::Resistance;
    const bool resistances = ohm || (!one->unit && (one->bare.starts_with("r") || one->bare.starts_with("ohm")));
    std::string words = std::to_string(count) + " readings: " + one->name;
    if (count > 1) words += " to " + family.members.back().second->name;
    if (resistances) {
      group["unit"] = ohm ? one->unit->name : "ohm";
      words += std::string(", resistances") + (ohm ? " in " : ", whose unit is not stated, in ") +
               group["unit"].get<std::string>();
    } else {
      words += ", signals: differences from rest count, not ratios";
    }
    readingsTable_ = one->table;
    if (one->table > 1) group["table"] = one->table;
    map[resistances ? "resistances" : "signals"] = group;
    assumed_.insert(assumed_.begin(), words);
  }

  std::vector<NamedColumn> columns_;
  std::vector<std::string> assumed_;
  std::string missing_;
  std::map<int, NamedColumn> times_; ///< by table
  int readingsTable_ = 1;
};

} // namespace

GuessedMap guessPartOfMap(const std::vector<TablePreview>& tables) {
  std::vector<NamedColumn> columns = columnsOf(tables);
  const bool noNames = columns.empty();
  GuessedMap guessed = Guess(std::move(columns)).map(tables.front().file);
  if (noNames)
    guessed.missing =
        tables.front().file.string() + ": has no names of columns; a map (--map) names them by number, from 1";
  return guessed;
}

GuessedMap guessImportMap(const std::vector<fs::path>& tables) {
  std::vector<TablePreview> heads;
  for (const fs::path& table : tables) heads.push_back(previewTable(table, {}, 0));
  GuessedMap guessed = guessPartOfMap(heads);
  if (!guessed.missing.empty()) throw Error(guessed.missing);
  return guessed;
}

} // namespace palp
