#include "io/ImportSamples.h"

#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "io/measured/ImportMap.h"
#include "io/measured/MeasuredTable.h"
#include "io/samples/SampleWriter.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "nn/ConstantReadings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp {

namespace fs = std::filesystem;

namespace {

/// Columns of the numbers of a sample in a table, and their conversion.
class RowReader {
public:
  RowReader(const ImportMap& map, MeasuredTable& table, const fs::path& mapFile, const fs::path& tableFile)
      : map_(map), table_(table), mapFile_(mapFile), tableFile_(tableFile) {
    add(map.resistances_ohm);
    add(map.forces_N);
    if (map.area) add({*map.area});
    add(map.place_mm);
    if (map.time_s) add({*map.time_s});
  }

  /// Columns of the table that no sample takes.
  [[nodiscard]] std::size_t unused() const {
    std::vector<std::size_t> used = chosen_;
    std::sort(used.begin(), used.end());
    return table_.columns().size() - static_cast<std::size_t>(std::unique(used.begin(), used.end()) - used.begin());
  }

  bool read(SampleSet& block, Eigen::Index column) {
    if (!table_.next(chosen_, values_)) return false;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      values_[i] = columns_[i].factor * values_[i] + columns_[i].offset;
      if (!std::isfinite(values_[i])) table_.refuse("column " + columns_[i].name + " is too large in its unit");
    }
    const double* next = values_.data();
    for (double& resistance : block.resistances_ohm.col(column)) {
      if (!(*next > 0))
        table_.refuse("column " + columns_[static_cast<std::size_t>(next - values_.data())].name + ": " +
                      gotExpected(*next, " ohm", "above 0"));
      resistance = *next++;
    }
    for (double& force : block.forces_N.col(column)) force = *next++;
    block.area(column) = map_.area ? areaFrom(*next++) : 0;
    if (!map_.place_mm.empty()) {
      block.area(column) = areaAt(next[0], next[1]);
      for (double& place : block.places_mm.col(column)) place = *next++;
    }
    if (map_.time_s) {
      if (*next < time_s_)
        table_.refuse("time: " + gotExpected(*next, " s", shortText(time_s_) + " s or later; sort the rows by time"));
      time_s_ = block.times_s(0, column) = *next;
    }
    return true;
  }

private:
  void add(const std::vector<ImportedColumn>& columns) {
    const std::vector<std::string>& there = table_.columns();
    for (const ImportedColumn& column : columns) {
      const auto found = std::find(there.begin(), there.end(), column.name);
      if (found == there.end())
        throw Error(mapFile_.string() + ": column \"" + column.name + "\" is not in " + tableFile_.string() +
                    ", whose columns are " + shownColumns());
      if (std::find(found + 1, there.end(), column.name) != there.end())
        throw Error(tableFile_.string() + ": column \"" + column.name + "\" appears twice");
      chosen_.push_back(static_cast<std::size_t>(found - there.begin()));
      columns_.push_back(column);
    }
  }

  [[nodiscard]] std::string shownColumns() const {
    std::string all;
    for (const std::string& name : table_.columns()) {
      if (all.size() > 100) return all + ", ...";
      all += (all.empty() ? "" : ", ") + name.substr(0, 40);
    }
    return all;
  }

  [[nodiscard]] int areaFrom(double value) const {
    if (!(value >= 0 && value < map_.areaCount) || value != std::floor(value))
      table_.refuse("area: " + gotExpected(value, " (counted from 0)",
                                           "a whole number from 0 to " + std::to_string(map_.areaCount - 1)));
    return static_cast<int>(value);
  }

  [[nodiscard]] int areaAt(double x_mm, double y_mm) const {
    if (!(x_mm >= 0 && x_mm <= map_.length_mm && y_mm >= 0 && y_mm <= map_.width_mm))
      table_.refuse("position: " +
                    gotExpected(shortText(x_mm) + ", " + shortText(y_mm) + " mm",
                                "0 to " + shortText(map_.length_mm) + " and 0 to " + shortText(map_.width_mm) + " mm"));
    const int i = std::min(map_.areaColumns - 1, static_cast<int>(x_mm / map_.length_mm * map_.areaColumns));
    const int j = std::min(map_.areaRows - 1, static_cast<int>(y_mm / map_.width_mm * map_.areaRows));
    return j * map_.areaColumns + i;
  }

  const ImportMap& map_;
  MeasuredTable& table_;
  const fs::path &mapFile_, &tableFile_;
  std::vector<std::size_t> chosen_;
  std::vector<ImportedColumn> columns_;
  std::vector<double> values_;
  double time_s_ = -std::numeric_limits<double>::infinity();
};

void requireFits(const ImportMap& map, const SensorDesign& design, const fs::path& mapFile) {
  const auto refuse = [&](const std::string& what, int found, int wanted) {
    throw Error(mapFile.string() + ": " + std::to_string(found) + " " + what + "; the design has " +
                std::to_string(wanted));
  };
  if (map.rowWires != design.rowWires()) refuse("row-wires", map.rowWires, design.rowWires());
  if (map.columnWires != design.columnWires()) refuse("column-wires", map.columnWires, design.columnWires());
  if (map.areaCount != design.areas.count()) refuse("areas", map.areaCount, design.areas.count());
}

SampleSet headOf(const ImportMap& map, const SensorDesign* design, const fs::path& table) {
  SampleSet head;
  head.origin.designFingerprint = design != nullptr ? designFingerprint(*design) : map.fingerprint;
  if (design != nullptr && design->field() != nullptr) head.origin.readout = design->field()->readout;
  head.origin.seed = 0;
  head.origin.perArea = 0; // of no request
  std::string name = table.filename().string();
  for (char& letter : name)
    if (letter < ' ' || letter > '~') letter = '_';
  head.origin.mesh = kImportedFrom + name;
  head.rowWires = map.rowWires;
  head.electrodesPerRowWire = design != nullptr ? design->electrodesPerRowWire() : 1;
  head.columnWires = map.columnWires;
  head.areaCount = map.areaCount;
  head.times_s.resize(map.time_s ? 1 : 0, 0);
  head.places_mm.resize(map.place_mm.empty() ? 0 : 2, 0);
  head.forces_N.resize(3, 0);
  head.resistances_ohm.resize(static_cast<Eigen::Index>(map.resistances_ohm.size()), 0);
  return head;
}

} // namespace

Imported importSamples(const fs::path& table, const fs::path& mapFile, const SensorDesign* design,
                       const fs::path& output, bool force, const std::function<void(double)>& progress,
                       const std::stop_token& stop) {
  requireFree(output, force);
  const ImportMap map = readImportMap(mapFile);
  if (design != nullptr) requireFits(map, *design, mapFile);
  const auto source = openTable(table, map.separator);
  RowReader rows(map, *source, mapFile, table);
  SampleSet block = headOf(map, design, table);
  Imported result{0, rows.unused(), block.origin.designFingerprint};
  SampleWriter writer(output, block, force);
  ConstantReadings readings;
  const Eigen::Index atOnce = samplesAtOnce(block);
  for (Eigen::Index count = atOnce; count == atOnce;) {
    resizeSamples(block, atOnce);
    for (count = 0; count < atOnce && rows.read(block, count); ++count) throwIfStopped(stop);
    resizeSamples(block, count);
    writer.append(block);
    readings.add(block.resistances_ohm);
    result.samples += static_cast<std::size_t>(count);
    if (progress) progress(source->share());
  }
  if (result.samples == 0) throw Error(table.string() + ": has no rows below the names of its columns");
  result.constant = readings.inWords(
      [&block](Eigen::Index i) {
        return "R_r" + std::to_string(i / block.columnWires) + "_c" + std::to_string(i % block.columnWires);
      },
      "ohm");
  writer.finish(stop);
  return result;
}

} // namespace palp
