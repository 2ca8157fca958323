#include "io/samples/SampleArrays.h"

#include "io/SampleFile.h"
#include "io/SampleHead.h"
#include "model/Indenter.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace palp {

namespace {

constexpr std::array kWholeKeys{
    "palp_samples", "seed", "per_area", "first_sample", "row_wires", "column_wires", "electrodes_per_row_wire",
    "area_count"};
constexpr std::array kRealKeys{"solver_tolerance", "surrogate_error"};
constexpr Eigen::Index kMostAtOnce = 4096;
constexpr Eigen::Index kChunk_bytes = 1 << 20; ///< HDF5 caches a chunk of this size by default

constexpr std::size_t kLarge_bytes = 1 << 22;

template <class Keys> bool isAmong(const Keys& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

template <class Number> Number numberFrom(const std::string& text) {
  Number value{};
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Memory that nobody has touched yet: on huge pages, whose first touch takes a third of the time.
void hintHugePages(Eigen::MatrixXd& values) {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t page = 1 << 16; // a multiple of every system's
  const auto first = reinterpret_cast<std::uintptr_t>(values.data()), inside = (first + page - 1) / page * page;
  const std::size_t bytes = static_cast<std::size_t>(values.size()) * sizeof(double);
  if (bytes >= kLarge_bytes)
    madvise(reinterpret_cast<void*>(inside), (bytes - (inside - first)) / page * page, MADV_HUGEPAGE);
#endif
}

std::uint64_t asSize(int count) {
  return static_cast<std::uint64_t>(count);
}

} // namespace

std::vector<SampleArray> sampleArrays(const SampleSet& head) {
  std::vector<SampleArray> arrays;
  const auto areas =
      head.forces_N.rows() == 3 ? std::vector<std::uint64_t>{3} : std::vector<std::uint64_t>{asSize(head.areaCount), 3};
  if (head.times_s.rows() > 0) arrays.push_back({"time_s", "s", {}, &SampleSet::times_s});
  if (head.runs.rows() > 0) arrays.push_back({"run", "1", {}, &SampleSet::runs});
  if (head.touches.rows() > 0)
    arrays.push_back(
        {"touches",
         "shape (0 sphere, 1 pin, 2 flat, 3 cylinder-x, 4 cylinder-y, 5 plane), size mm, friction 1, x mm, y mm",
         {kTouchRows},
         &SampleSet::touches});
  if (head.places_mm.rows() > 0) arrays.push_back({"places_mm", "mm", {2}, &SampleSet::places_mm});
  arrays.push_back({"forces_N", "N", areas, &SampleSet::forces_N});
  if (head.secondTouch.rows() > 0)
    arrays.push_back(
        {"beside", "as touches, then the force N along x, y, z", {asSize(kSecondTouchRows)}, &SampleSet::secondTouch});
  if (head.displacements_mm.rows() > 0)
    arrays.push_back({"displacements_mm",
                      "mm",
                      {asSize(head.rowWires), asSize(head.electrodesPerRowWire), 3},
                      &SampleSet::displacements_mm});
  if (head.resistances_ohm.rows() > 0)
    arrays.push_back({head.origin.ofSignals ? "signals" : "resistances_ohm",
                      head.origin.ofSignals ? "as measured" : "ohm",
                      {asSize(head.rowWires), asSize(head.columnWires)},
                      &SampleSet::resistances_ohm});
  return arrays;
}

void resizeSamples(SampleSet& set, Eigen::Index samples) {
  set.area.conservativeResize(samples);
  for (const SampleArray& array : sampleArrays(set)) {
    Eigen::MatrixXd& values = set.*array.values;
    if (values.cols() > 0) {
      values.conservativeResize(Eigen::NoChange, samples);
      continue;
    }
    values.resize(values.rows(), samples); // without a copy
    hintHugePages(values);
  }
  for (const auto part : kSampleParts)
    if ((set.*part).rows() == 0) (set.*part).resize(0, samples);
}

SampleSet samplesBetween(const SampleSet& set, Eigen::Index first, Eigen::Index count) {
  SampleSet part;
  part.origin = set.origin;
  part.rowWires = set.rowWires;
  part.electrodesPerRowWire = set.electrodesPerRowWire;
  part.columnWires = set.columnWires;
  part.areaCount = set.areaCount;
  part.area = set.area.segment(first, count);
  for (const auto values : kSampleParts) {
    const Eigen::Index rows = (set.*values).rows(); // of a head too: they say what there is
    if (rows == 0 || (set.*values).cols() == 0)
      (part.*values).resize(rows, rows == 0 ? count : 0);
    else
      part.*values = (set.*values).middleCols(first, count);
  }
  return part;
}

std::vector<std::pair<std::string, HeadValue>> headValues(const SampleSet& head) {
  std::vector<std::pair<std::string, HeadValue>> values;
  std::istringstream lines(sampleFileHead(head));
  for (std::string line; std::getline(lines, line) && line.starts_with("# ");) {
    const std::size_t colon = line.find(": ");
    const std::string key = line.substr(2, colon - 2), value = line.substr(colon + 2);
    if (isAmong(kWholeKeys, key))
      values.emplace_back(key, numberFrom<std::uint64_t>(value));
    else if (isAmong(kRealKeys, key))
      values.emplace_back(key, numberFrom<double>(value));
    else
      values.emplace_back(key, value);
  }
  return values;
}

std::vector<std::string> arrayNames(const SampleSet& head) {
  std::vector<std::string> names{kAreaArray};
  for (const SampleArray& array : sampleArrays(head)) names.push_back(array.name);
  return names;
}

std::vector<std::string> columnNames(const SampleSet& head) {
  std::vector<std::string> names;
  std::istringstream all(sampleColumns(head));
  for (std::string name; std::getline(all, name, ',');) names.push_back(name);
  return names;
}

SampleSet headFrom(const std::filesystem::path& file, const std::map<std::string, std::string>& values,
                   const std::vector<std::string>& columns) {
  std::string text;
  for (const auto& [key, value] : values) {
    if ((key + value).find('\n') != std::string::npos)
      throw Error(file.string() + ": " + key + ": " + gotExpected("several lines", "one"));
    text += "# " + key + ": " + value + "\n";
  }
  for (std::size_t i = 0; i < columns.size(); ++i) text += (i == 0 ? "" : ",") + columns[i];
  std::istringstream stream(text + "\n");
  SampleLines lines(stream, file.string() + ", as lines of CSV");
  return readSampleHead(lines);
}

void requireSamples(const std::filesystem::path& file, const SampleSet& set, Eigen::Index first, Eigen::Index count,
                    Eigen::Index before, bool finite) {
  const auto refuse = [&](Eigen::Index sample, const std::string& sentence) {
    throw Error(file.string() + ", sample " + std::to_string(before + sample) + ": " + sentence);
  };
  const bool together = set.origin.areas == "together";
  const int low = together ? -1 : 0, high = together ? -1 : set.areaCount - 1;
  for (Eigen::Index i = first; i < first + count; ++i)
    if (set.area(i) < low || set.area(i) > high)
      refuse(i, "area: " +
                    gotExpected(std::to_string(set.area(i)), together ? "-1: by the head all areas are loaded together"
                                                                      : "0 to " + std::to_string(high)));
  for (const auto part : {&SampleSet::touches, &SampleSet::secondTouch})
    for (Eigen::Index i = first; (set.*part).rows() > 0 && i < first + count; ++i) {
      const double shape = (set.*part)(kTouchShape, i);
      if (!(shape >= 0 && shape < static_cast<double>(kIndenterShapes.all().size()) && shape == std::floor(shape)))
        refuse(i,
               "shape: " + gotExpected(shape, "",
                                       "a whole number from 0 to " + std::to_string(kIndenterShapes.all().size() - 1)));
    }
  if (finite) return;
  for (const SampleArray& array : sampleArrays(set)) {
    const auto values = (set.*array.values).middleCols(first, count);
    if (values.allFinite()) continue;
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index row = 0; row < values.rows(); ++row)
        if (!std::isfinite(values(row, i)))
          refuse(first + i, array.name + " number " + std::to_string(row) + ": " +
                                gotExpected(values(row, i), "", "a finite number"));
  }
}

Eigen::Index samplesAtOnce(const SampleSet& head) {
  Eigen::Index largest = 1;
  for (const SampleArray& array : sampleArrays(head)) largest = std::max(largest, (head.*array.values).rows());
  Eigen::Index samples = kMostAtOnce;
  while (samples > 1 && samples * largest * static_cast<Eigen::Index>(sizeof(double)) > kChunk_bytes) samples /= 2;
  return samples;
}

} // namespace palp
