#include "io/ImportSamples.h"

#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "io/measured/ImportMap.h"
#include "io/measured/ImportedRows.h"
#include "io/samples/SampleWriter.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"
#include "nn/ConstantReadings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kProblemsShown = 10;
constexpr std::size_t kFewForces = 10; ///< too few to judge their signs
constexpr double kNearlyAll = 0.9;     ///< share of forces that pull
constexpr double kAnotherUnit = 100;   ///< ratio of forces to the design's range
constexpr double kManyLeftOut = 0.05;  ///< share of rows

void requireFits(const ImportMap& map, const SensorDesign& design, const std::string& mapFile) {
  const auto refuse = [&](const std::string& what, int found, int wanted) {
    throw Error(mapFile + ": " + std::to_string(found) + " " + what + "; the design has " + std::to_string(wanted));
  };
  if (map.rowWires != design.rowWires()) refuse("row-wires", map.rowWires, design.rowWires());
  if (map.columnWires != design.columnWires()) refuse("column-wires", map.columnWires, design.columnWires());
  if (map.areaCount != design.areas.count()) refuse("areas", map.areaCount, design.areas.count());
  if (map.law.kind == ReadingLaw::Kind::Signal)
    throw Error(mapFile +
                ": signals; the readings of a design are resistances (\"resistances\", with a unit or divider)");
}

std::string printableName(std::string name) {
  for (char& letter : name)
    if (letter < ' ' || letter > '~') letter = '_';
  return name;
}

SampleSet headOf(const ImportMap& map, const SensorDesign* design, const fs::path& table, bool runs) {
  SampleSet head;
  head.origin.designFingerprint = design != nullptr ? designFingerprint(*design) : map.fingerprint;
  if (design != nullptr && design->field() != nullptr) head.origin.readout = design->field()->readout;
  head.origin.seed = 0;
  head.origin.perArea = 0; // of no request
  head.origin.mesh = kImportedFrom + printableName(table.filename().string());
  head.origin.ofSignals = map.law.kind == ReadingLaw::Kind::Signal;
  head.rowWires = map.rowWires;
  head.electrodesPerRowWire = design != nullptr ? design->electrodesPerRowWire() : 1;
  head.columnWires = map.columnWires;
  head.areaCount = map.areaCount;
  head.times_s.resize(map.time ? 1 : 0, 0);
  head.runs.resize(runs ? 1 : 0, 0);
  head.places_mm.resize(map.places_mm.values.empty() ? 0 : 2, 0);
  head.forces_N.resize(3, 0);
  head.resistances_ohm.resize(static_cast<Eigen::Index>(map.readings.values.size()), 0);
  return head;
}

/// The area that a row belongs to. `problem` gets what is wrong with it, if anything.
int areaOf(const ImportMap& map, const ImportedRow& row, std::string& problem) {
  if (map.area) {
    if (!(row.area >= 0 && row.area < map.areaCount) || row.area != std::floor(row.area))
      problem = "area: " + gotExpected(row.area, " (counted from 0)",
                                       "a whole number from 0 to " + std::to_string(map.areaCount - 1));
    return problem.empty() ? static_cast<int>(row.area) : 0;
  }
  if (!(map.length_mm > 0)) return 0;
  const double x_mm = row.place_mm.x(), y_mm = row.place_mm.y();
  if (!(x_mm >= 0 && x_mm <= map.length_mm && y_mm >= 0 && y_mm <= map.width_mm)) {
    problem =
        "position: " + gotExpected(shortText(x_mm) + ", " + shortText(y_mm) + " mm",
                                   "0 to " + shortText(map.length_mm) + " and 0 to " + shortText(map.width_mm) + " mm");
    return 0;
  }
  const int i = std::min(map.areaColumns - 1, static_cast<int>(x_mm / map.length_mm * map.areaColumns));
  const int j = std::min(map.areaRows - 1, static_cast<int>(y_mm / map.width_mm * map.areaRows));
  return j * map.areaColumns + i;
}

/// Rows that cannot be used.
class BadRows {
public:
  void add(const std::string& problem) {
    if (shown_.size() < kProblemsShown) shown_.push_back(problem);
    ++count_;
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::string& first() const { return shown_.front(); }

  void refuse() const {
    if (count_ == 0) return;
    if (count_ == 1) throw Error(shown_.front());
    std::string all = shown_.front();
    const std::string table = all.substr(0, all.find(", ") + 2); // which the others need not repeat
    for (std::size_t i = 1; i < shown_.size(); ++i)
      all += "; " + (shown_[i].starts_with(table) ? shown_[i].substr(table.size()) : shown_[i]);
    throw Error(all + (count_ > shown_.size() ? "; ..." : "") + ": " + std::to_string(count_) +
                " rows cannot be used (--leave-out-bad-rows imports the others)");
  }

private:
  std::vector<std::string> shown_;
  std::size_t count_ = 0;
};

/// What the forces look like over all rows.
struct ForceRanges {
  std::size_t count = 0, pull = 0;
  double largest_N = 0;

  void add(const Eigen::Vector3d& force_N) {
    ++count;
    if (force_N.z() > 0) ++pull;
    largest_N = std::max(largest_N, force_N.cwiseAbs().maxCoeff());
  }

  void warn(const ImportMap& map, const SensorDesign* design, std::vector<std::string>& warnings) const {
    if (count >= kFewForces && !map.signsAreGiven &&
        static_cast<double>(pull) > kNearlyAll * static_cast<double>(count))
      warnings.push_back(
          (pull == count ? "all " + std::to_string(count) : std::to_string(pull) + " of " + std::to_string(count)) +
          " forces pull (Fz above 0); pressing is negative: \"signs\": [1, 1, -1] in the map?");
    if (design == nullptr || !(largest_N > 0)) return;
    const double range_N =
        std::max(design->forceRange.low_N.cwiseAbs().maxCoeff(), design->forceRange.high_N.cwiseAbs().maxCoeff());
    const double ratio = largest_N / range_N;
    if (ratio > kAnotherUnit || ratio < 1 / kAnotherUnit)
      warnings.push_back("the largest force, " + shortText(largest_N) + " N, is " + shortText(ratio) +
                         " times the design's range: another unit?");
  }
};

/// The samples of all runs, written block by block.
class Import {
public:
  Import(const ImportRequest& request, ImportMap map, std::string mapFile)
      : request_(request), map_(std::move(map)), mapFile_(std::move(mapFile)) {
    const auto perRun = static_cast<std::size_t>(map_.tables);
    if (request.tables.size() % perRun != 0)
      throw Error(mapFile_ + ": tables: " +
                  gotExpected(std::to_string(request.tables.size()), std::to_string(perRun) + " for each run"));
    runs_ = request.tables.size() / perRun;
    map_.leaveOutBadRows = map_.leaveOutBadRows || request.leaveOutBadRows;
    if (request.design != nullptr) requireFits(map_, *request.design, mapFile_);
    block_ = headOf(map_, request.design, request.tables.front(), map_.run || runs_ > 1);
    result_.design = block_.origin.designFingerprint;
  }

  Imported run(const std::function<void(double)>& progress, const std::stop_token& stop) {
    std::unique_ptr<SampleWriter> writer;
    for (std::size_t run = 0; run < runs_; ++run) {
      const auto first = request_.tables.begin() + static_cast<std::ptrdiff_t>(run) * map_.tables;
      ImportedRows rows(map_, mapFile_, {first, first + map_.tables}, stop);
      if (!writer) writer = std::make_unique<SampleWriter>(request_.output, block_, request_.force);
      readRun(rows, run, *writer, progress, stop);
      result_.leftOut += rows.counts().outsideClock + rows.counts().inGaps;
      result_.unusedColumns = rows.unusedColumns();
      if (run == 0) result_.notes = rows.notes(); // the others are read alike
      noteLeftOut(rows.counts());
    }
    if (!map_.leaveOutBadRows) bad_.refuse();
    if (result_.samples == 0)
      throw Error(request_.tables.front().string() + ": has no rows " +
                  (result_.leftOut + bad_.count() > 0 ? "that can be used" : "below the names of its columns"));
    finish();
    writer->finish(stop);
    return std::move(result_);
  }

private:
  void readRun(ImportedRows& rows, std::size_t run, SampleWriter& writer, const std::function<void(double)>& progress,
               const std::stop_token& stop) {
    const Eigen::Index atOnce = samplesAtOnce(block_);
    for (bool more = true; more;) {
      resizeSamples(block_, atOnce);
      Eigen::Index count = 0;
      while (count < atOnce && (more = rows.next(row_, problems_))) {
        throwIfStopped(stop);
        if (take(rows, run, count)) ++count;
      }
      resizeSamples(block_, count);
      if (map_.leaveOutBadRows || bad_.count() == 0) writer.append(block_);
      readings_.add(block_.resistances_ohm);
      result_.samples += static_cast<std::size_t>(count);
      if (progress) progress((static_cast<double>(run) + rows.share()) / static_cast<double>(runs_));
    }
  }

  /// The row as a sample; false if it cannot be used.
  bool take(const ImportedRows& rows, std::size_t run, Eigen::Index column) {
    int area = 0;
    if (problems_.empty()) {
      std::string problem;
      area = areaOf(map_, row_, problem);
      if (!problem.empty()) problems_.push_back(rows.where() + ": " + problem);
    }
    if (!problems_.empty()) {
      bad_.add(problems_.front());
      problems_.clear();
      return false;
    }
    block_.area(column) = area;
    block_.resistances_ohm.col(column) = row_.readings;
    block_.forces_N.col(column) = row_.force_N;
    if (block_.places_mm.rows() > 0) block_.places_mm.col(column) = row_.place_mm;
    bool begins = false;
    const double number = runNumber(rows, run, begins);
    if (block_.runs.rows() > 0) block_.runs(0, column) = number;
    if (map_.time) {
      requireLater(rows, begins);
      block_.times_s(0, column) = row_.time_s;
    }
    if (!map_.forces_N.values.empty()) forces_.add(row_.force_N);
    return true;
  }

  /// Runs of the map's column and of the files, numbered in the order of their first rows. Sets `begins` for the first
  /// row of one.
  double runNumber(const ImportedRows& rows, std::size_t run, bool& begins) {
    const std::pair<std::size_t, double> key{run, map_.run ? row_.run : 0.0};
    const auto [number, isNew] = numbers_.try_emplace(key, static_cast<double>(numbers_.size()));
    if (!isNew && key != lastRun_)
      throw Error(rows.where() + ": run: got a run that ended before, expected the rows of each run one after the "
                                 "other; sort the rows by run");
    lastRun_ = key;
    begins = isNew;
    return number->second;
  }

  void requireLater(const ImportedRows& rows, bool begins) {
    if (!begins && row_.time_s < lastTime_s_)
      throw Error(rows.where() + ": time: " +
                  gotExpected(row_.time_s, " s",
                              shortText(lastTime_s_) + " s or later; sort the rows by time" +
                                  (map_.run ? "" : ", or name the column of the \"run\"")));
    lastTime_s_ = row_.time_s;
  }

  void noteLeftOut(const ImportedCounts& counts) {
    if (counts.outsideClock > 0)
      result_.notes.push_back(std::to_string(counts.outsideClock) +
                              " rows left out: before or after the other table's clock");
    if (counts.inGaps > 0)
      result_.notes.push_back(std::to_string(counts.inGaps) + " rows left out: in gaps of the other table");
  }

  void finish() {
    result_.leftOut += bad_.count();
    if (bad_.count() > 0)
      result_.notes.push_back(std::to_string(bad_.count()) + " bad rows left out, the first: " + bad_.first());
    const auto all = static_cast<double>(result_.samples + result_.leftOut);
    if (static_cast<double>(result_.leftOut) > kManyLeftOut * all)
      result_.warnings.push_back(std::to_string(result_.leftOut) + " of " + shortText(all) + " rows were left out");
    result_.runs = std::max<std::size_t>(1, numbers_.size());
    forces_.warn(map_, request_.design, result_.warnings);
    const bool signals = block_.origin.ofSignals;
    result_.constant = readings_.inWords(
        [this, signals](Eigen::Index i) {
          return (signals ? "S_r" : "R_r") + std::to_string(i / block_.columnWires) + "_c" +
                 std::to_string(i % block_.columnWires);
        },
        signals ? map_.signalUnit : "ohm");
  }

  const ImportRequest& request_;
  ImportMap map_;
  std::string mapFile_;
  std::size_t runs_ = 1;
  SampleSet block_;
  ImportedRow row_;
  std::vector<std::string> problems_;
  BadRows bad_;
  ForceRanges forces_;
  ConstantReadings readings_;
  std::map<std::pair<std::size_t, double>, double> numbers_; ///< of the runs
  std::pair<std::size_t, double> lastRun_;
  double lastTime_s_ = 0;
  Imported result_;
};

} // namespace

Imported importSamples(const ImportRequest& request, const std::function<void(double)>& progress,
                       const std::stop_token& stop) {
  requireFree(request.output, request.force);
  if (!request.map.empty())
    return Import(request, readImportMap(request.map), request.map.string()).run(progress, stop);
  const GuessedMap guessed = guessImportMap(request.tables);
  const std::string name = "the map that the names of the columns state";
  Imported result = Import(request, importMapFrom(parseJson(guessed.json, name), name), name).run(progress, stop);
  result.notes.insert(result.notes.begin(), guessed.assumed.begin(), guessed.assumed.end());
  return result;
}

} // namespace palp
