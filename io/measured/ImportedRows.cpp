#include "io/measured/ImportedRows.h"

#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr double kUsualGaps = 10; ///< longest gap that is interpolated, in spacings of 99 % of the values

} // namespace

/// A table with the columns that are read of it.
struct ImportedRows::Table {
  fs::path file;
  std::unique_ptr<MeasuredTable> source;
  std::vector<ChosenColumn> chosen;
  std::vector<double> values; ///< of the last row, one for each chosen column
  std::size_t rows = 0;
  bool byRow = false; ///< read together with the readings

  std::size_t add(std::size_t column, ChosenColumn::As as) {
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (chosen[i].column == column && chosen[i].as == as) return i;
    chosen.push_back({column, as});
    return chosen.size() - 1;
  }
  [[nodiscard]] std::string where() const { return file.string() + ", " + source->where(); }
};

/// Values of one group: sums of columns of a table, each part with its place among the table's chosen columns.
struct ImportedRows::Group {
  struct Part {
    std::size_t chosen;
    double factor;
  };
  struct Value {
    std::vector<Part> parts;
    double offset = 0;
    std::string name; ///< of its first column
  };
  Table* table = nullptr;
  std::vector<Value> values;
  double factor = 1; ///< of the unit
  std::unique_ptr<Series> series{};
  std::unique_ptr<Table> own{}; ///< where the group has its own clock
  std::size_t clock = 0;
  double clockFactor = 1, clockOffset_s = 0;
  const char* key = "";

  [[nodiscard]] double value(std::size_t i) const {
    double sum = values[i].offset;
    for (const Part& part : values[i].parts) sum += part.factor * table->values[part.chosen];
    return factor * sum;
  }
};

/// Values over time of a group with its own clock.
struct ImportedRows::Series {
  std::vector<double> times_s;
  std::vector<Eigen::VectorXd> values;
  double longestGap_s = 0;
  std::size_t at = 0; ///< the last interval used
  Eigen::VectorXd now;
};

ImportedRows::ImportedRows(const ImportMap& map, const std::string& mapFile, std::vector<fs::path> tables,
                           const std::stop_token& stop)
    : map_(map), mapFile_(mapFile), tables_(tables.size()), files_(std::move(tables)) {
  if (files_.size() != static_cast<std::size_t>(map.tables))
    throw Error(mapFile + ": tables: " +
                gotExpected(std::to_string(files_.size()), std::to_string(map.tables) + " for each run"));
  const auto group = [this](const ImportedGroup& source, Quantity quantity, const char* key) {
    auto made = std::make_unique<Group>();
    addGroup(*made, source, quantity, key);
    return made;
  };
  ImportedGroup readings = map.readings;
  readings.clock.reset(); // its clock is that of the rows
  readings_ =
      group(readings, map.law.kind == ReadingLaw::Kind::Conductance ? Quantity::Conductance : Quantity::Resistance,
            map.law.kind == ReadingLaw::Kind::Signal ? "signals" : "resistances");
  Table& main = table(map.readings.table);
  forces_ = group(map.forces_N, Quantity::Force, "forces");
  places_ = group(map.places_mm, Quantity::Length, "place");
  area_ = std::make_unique<Group>();
  rotation_ = std::make_unique<Group>();
  const auto sameTable = [&](Group& made, const std::vector<ImportedValue>& values) {
    made.table = &main;
    for (const ImportedValue& value : values) {
      Group::Value& added = made.values.emplace_back();
      added.offset = value.offset;
      for (const ImportedValue::Part& part : value.parts)
        added.parts.push_back({add(main, part.column, ChosenColumn::As::Number), part.factor});
    }
  };
  if (map.area) sameTable(*area_, {*map.area});
  sameTable(*rotation_, map.rotation);
  rotation_->factor = map.radiansPerUnit;
  if (map.run) run_ = add(main, *map.run, ChosenColumn::As::Label);
  if (map.time) {
    time_ = add(main, map.time->column, ChosenColumn::As::Clock);
    timeFactor_ = clockFactor(main, *map.time);
  }
  for (const auto& one : tables_)
    if (one && one->byRow) {
      one->source->choose(one->chosen);
      one->values.resize(one->chosen.size());
    }
  for (Group* one : {forces_.get(), places_.get()})
    if (one->own) loadSeries(*one, stop);
}

ImportedRows::~ImportedRows() = default;

ImportedRows::Table& ImportedRows::table(int index) {
  auto& made = tables_[static_cast<std::size_t>(index)];
  if (!made) {
    made = std::make_unique<Table>();
    made->file = files_[static_cast<std::size_t>(index)];
    made->source = openTable(made->file, map_.form);
  }
  made->byRow = true;
  return *made;
}

std::size_t ImportedRows::add(Table& table, const ColumnName& column, ChosenColumn::As as) {
  const std::vector<std::string>& names = table.source->columns();
  if (const int* number = std::get_if<int>(&column)) {
    if (static_cast<std::size_t>(*number) > names.size()) refuseColumn(table, column);
    return table.add(static_cast<std::size_t>(*number) - 1, as);
  }
  const std::string& name = std::get<std::string>(column);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end() || name.empty()) refuseColumn(table, column);
  if (std::find(found + 1, names.end(), name) != names.end())
    throw Error(table.file.string() + ": " + shownColumn(column) + " appears twice; the map can name it by its number");
  return table.add(static_cast<std::size_t>(found - names.begin()), as);
}

void ImportedRows::refuseColumn(const Table& table, const ColumnName& column) const {
  const std::vector<std::string>& names = table.source->columns();
  std::string all;
  for (const std::string& name : names) {
    if (name.empty()) continue;
    if (all.size() > 100) {
      all += ", ...";
      break;
    }
    all += (all.empty() ? "" : ", ") + name.substr(0, 40);
  }
  const std::string form = table.source->form();
  throw Error(mapFile_ + ": " + shownColumn(column) + " is not in " + table.file.string() +
              (all.empty() ? ", which has " + std::to_string(names.size()) + " columns without names"
                           : ", whose columns are " + all) +
              (form.empty() ? "" : " (read with " + form + ")"));
}

double ImportedRows::unitFactor(Table& table, const ImportedGroup& group, Quantity quantity, const char* key) {
  if (map_.law.kind == ReadingLaw::Kind::Signal && quantity == Quantity::Resistance) return 1;
  if (quantity == Quantity::Resistance && map_.law.kind != ReadingLaw::Kind::Resistance) return 1;
  if (group.unit) return group.unit->factor;
  const std::vector<std::string>& names = table.source->columns();
  const std::vector<std::string> units = table.source->units();
  std::optional<KnownUnit> found;
  for (const ImportedValue& value : group.values)
    for (const ImportedValue::Part& part : value.parts) {
      const std::size_t column = table.chosen[add(table, part.column, ChosenColumn::As::Number)].column;
      auto unit = knownUnit(units[column]);
      if (!unit) unit = unitInName(names[column]);
      if (!unit || unit->quantity != quantity || (found && found->factor != unit->factor))
        throw Error(mapFile_ + ": " + key + ": has no \"unit\", and " + table.file.string() + " states none for " +
                    shownColumn(part.column) + "; expected " + unitsOf(quantity));
      found = unit;
    }
  return found ? found->factor : 1;
}

double ImportedRows::clockFactor(Table& table, const ImportedClock& clock) {
  if (clock.unit) return clock.unit->factor;
  const std::size_t column = table.chosen[add(table, clock.column, ChosenColumn::As::Clock)].column;
  if (table.source->isDate(column)) return 1;
  auto unit = knownUnit(table.source->units()[column]);
  if (!unit) unit = unitInName(table.source->columns()[column]);
  if (!unit || unit->quantity != Quantity::Time)
    throw Error(mapFile_ + ": time: has no \"unit\", and " + table.file.string() + " states none for " +
                shownColumn(clock.column) + "; expected " + unitsOf(Quantity::Time));
  return unit->factor;
}

void ImportedRows::addGroup(Group& group, const ImportedGroup& source, Quantity quantity, const char* key) {
  group.key = key;
  if (source.values.empty()) return;
  if (source.clock) { // read separately, from its first row to its last
    group.own = std::make_unique<Table>();
    group.own->file = files_[static_cast<std::size_t>(source.table)];
    group.own->source = openTable(group.own->file, map_.form);
    group.table = group.own.get();
    group.clock = add(*group.own, source.clock->column, ChosenColumn::As::Clock);
    group.clockFactor = clockFactor(*group.own, *source.clock);
    group.clockOffset_s = source.clock->offset_s;
  } else {
    group.table = &table(source.table);
  }
  for (const ImportedValue& value : source.values) {
    Group::Value& added = group.values.emplace_back();
    added.offset = value.offset;
    for (const ImportedValue::Part& part : value.parts) {
      if (added.name.empty()) added.name = shownColumn(part.column);
      added.parts.push_back({add(*group.table, part.column, ChosenColumn::As::Number), part.factor});
    }
  }
  group.factor = unitFactor(*group.table, source, quantity, key);
}

void ImportedRows::loadSeries(Group& group, const std::stop_token& stop) {
  Table& own = *group.own;
  own.source->choose(own.chosen);
  own.values.resize(own.chosen.size());
  group.series = std::make_unique<Series>();
  Series& series = *group.series;
  std::vector<std::string> problems;
  for (; own.source->next(own.values, problems); problems.clear()) {
    throwIfStopped(stop);
    if (!problems.empty() && !map_.leaveOutBadRows) throw Error(own.where() + ": " + problems.front());
    if (!problems.empty()) continue;
    const double time_s = group.clockFactor * own.values[group.clock] + group.clockOffset_s;
    if (!series.times_s.empty() && time_s < series.times_s.back())
      throw Error(own.where() + ": time: " +
                  gotExpected(time_s, " s", shortText(series.times_s.back()) + " s or later; sort the rows by time"));
    if (!series.times_s.empty() && time_s == series.times_s.back()) continue;
    Eigen::VectorXd values(static_cast<Eigen::Index>(group.values.size()));
    for (std::size_t i = 0; i < group.values.size(); ++i) values(static_cast<Eigen::Index>(i)) = group.value(i);
    series.times_s.push_back(time_s);
    series.values.push_back(std::move(values));
  }
  if (series.times_s.size() < 2)
    throw Error(own.file.string() + ": has fewer than two times for \"" + group.key + "\"");
  std::vector<double> gaps;
  for (std::size_t i = 1; i < series.times_s.size(); ++i) gaps.push_back(series.times_s[i] - series.times_s[i - 1]);
  const auto usual = gaps.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(gaps.size() - 1));
  std::nth_element(gaps.begin(), usual, gaps.end());
  series.longestGap_s = map_.longestGap_s > 0 ? map_.longestGap_s : kUsualGaps * *usual;
  own.rows = series.times_s.size();
}

bool ImportedRows::interpolate(Group& group, double time_s) {
  Series& series = *group.series;
  if (!(time_s >= series.times_s.front() && time_s <= series.times_s.back())) {
    ++counts_.outsideClock;
    return false;
  }
  const auto after = std::upper_bound(series.times_s.begin(), series.times_s.end(), time_s);
  series.at = std::min(static_cast<std::size_t>(after - series.times_s.begin()), series.times_s.size() - 1) - 1;
  const double gap_s = series.times_s[series.at + 1] - series.times_s[series.at];
  if (gap_s > series.longestGap_s) {
    ++counts_.inGaps;
    return false;
  }
  const double share = (time_s - series.times_s[series.at]) / gap_s;
  series.now = (1 - share) * series.values[series.at] + share * series.values[series.at + 1];
  return true;
}

void ImportedRows::take(const Group& group, double* to, std::vector<std::string>& problems) const {
  for (std::size_t i = 0; i < group.values.size(); ++i) {
    to[i] = group.series ? group.series->now(static_cast<Eigen::Index>(i)) : group.value(i);
    if (!std::isfinite(to[i])) problems.push_back(group.values[i].name + " is too large in its unit");
  }
}

void ImportedRows::resistances(Eigen::VectorXd& readings, std::vector<std::string>& problems) const {
  const ReadingLaw& law = map_.law;
  if (law.kind == ReadingLaw::Kind::Signal) return;
  for (Eigen::Index i = 0; i < readings.size(); ++i) {
    const double measured = readings(i), share = measured / law.full;
    double& ohm = readings(i);
    switch (law.kind) {
    case ReadingLaw::Kind::Signal:
      break;
    case ReadingLaw::Kind::Resistance:
      ohm = measured + law.zero_ohm;
      break;
    case ReadingLaw::Kind::Conductance:
      ohm = 1 / measured + law.zero_ohm;
      break;
    case ReadingLaw::Kind::Code:
      ohm = law.ohmPerCode * measured + law.zero_ohm;
      break;
    case ReadingLaw::Kind::DividerLow:
      ohm = law.resistor_ohm * share / (1 - share);
      break;
    case ReadingLaw::Kind::DividerHigh:
      ohm = law.resistor_ohm * (1 - share) / share;
      break;
    }
    if (ohm > 0 && std::isfinite(ohm)) continue;
    const std::string& name = readings_->values[static_cast<std::size_t>(i)].name;
    if (law.kind == ReadingLaw::Kind::DividerLow || law.kind == ReadingLaw::Kind::DividerHigh)
      problems.push_back(name + ": " +
                         gotExpected(shortText(measured), "above 0 and below \"full_scale\", " + shortText(law.full)));
    else
      problems.push_back(name + ": " + gotExpected(ohm, " ohm", "above 0 (\"signals\" are readings of any sign)"));
  }
}

bool ImportedRows::nextOfTables(std::vector<std::string>& problems) {
  bool any = false, all = true;
  const Table* ended = nullptr;
  for (const auto& one : tables_) {
    if (!one || !one->byRow) continue;
    const std::size_t before = problems.size();
    const bool more = one->source->next(one->values, problems);
    for (std::size_t i = before; i < problems.size(); ++i) problems[i] = one->where() + ": " + problems[i];
    if (more) ++one->rows;
    any = any || more;
    all = all && more;
    if (!more) ended = one.get();
  }
  if (any && !all)
    throw Error(
        ended->file.string() + ": has " + std::to_string(ended->rows) +
        " rows; the other table of the same run has more (tables with clocks of their own have \"time\" in the map)");
  return any;
}

bool ImportedRows::next(ImportedRow& row, std::vector<std::string>& problems) {
  const Table& main = *tables_[static_cast<std::size_t>(map_.readings.table)];
  while (nextOfTables(problems)) {
    if (!problems.empty()) return true;
    if (map_.time) {
      row.time_s = timeFactor_ * main.values[time_] + map_.time->offset_s;
      bool inside = true;
      for (Group* group : {forces_.get(), places_.get()})
        inside = inside && (!group->own || interpolate(*group, row.time_s));
      if (!inside) continue;
    }
    row.readings.resize(static_cast<Eigen::Index>(readings_->values.size()));
    take(*readings_, row.readings.data(), problems);
    resistances(row.readings, problems);
    take(*forces_, row.force_N.data(), problems);
    take(*places_, row.place_mm.data(), problems);
    take(*area_, &row.area, problems);
    if (!rotation_->values.empty()) {
      Eigen::Vector3d vector;
      take(*rotation_, vector.data(), problems);
      const double angle = vector.norm();
      if (angle > 0) row.force_N = Eigen::AngleAxisd(-angle, vector / angle) * row.force_N;
    }
    if (map_.run) row.run = main.values[run_];
    for (std::string& problem : problems) problem = main.where() + ": " + problem;
    return true;
  }
  return false;
}

std::string ImportedRows::where() const {
  return tables_[static_cast<std::size_t>(map_.readings.table)]->where();
}

double ImportedRows::share() const {
  return tables_[static_cast<std::size_t>(map_.readings.table)]->source->share();
}

std::size_t ImportedRows::unusedColumns() const {
  std::set<std::pair<std::string, std::size_t>> used;
  std::map<std::string, std::size_t> all;
  const auto count = [&](const Table& table) {
    all[table.file.string()] = table.source->columns().size();
    for (const ChosenColumn& chosen : table.chosen) used.emplace(table.file.string(), chosen.column);
  };
  for (const auto& one : tables_)
    if (one) count(*one);
  for (const Group* group : {forces_.get(), places_.get()})
    if (group->own) count(*group->own);
  std::size_t sum = 0;
  for (const auto& [file, columns] : all) sum += columns;
  return sum - used.size();
}

std::vector<std::string> ImportedRows::notes() const {
  std::vector<std::string> all;
  for (const auto& one : tables_)
    if (one && !one->source->form().empty()) all.push_back(one->file.string() + ": " + one->source->form());
  for (const Group* group : {forces_.get(), places_.get()}) {
    if (!group->series) continue;
    const auto& times_s = group->series->times_s;
    all.push_back(std::string(group->key) + ": " +
                  shortText(static_cast<double>(times_s.size() - 1) / (times_s.back() - times_s.front())) +
                  " values per second of their own clock, interpolated to the times of the readings");
  }
  return all;
}

} // namespace palp
