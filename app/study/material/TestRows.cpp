#include "app/study/material/TestRows.h"

#include "io/AtomicFile.h"
#include "io/CsvText.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace palp {

namespace {

constexpr double kLeastStretch = 0.01, kMostStretch = 100;
constexpr std::size_t kMostRows = 100000;

/// A column that gives the stretch or the stress: value = offset + factor * number.
struct Column {
  const char* name;
  double offset, factor;
};
constexpr Column kStretches[] = {{"stretch", 0, 1}, {"strain", 1, 1}, {"strain_percent", 1, 0.01}};
constexpr Column kStresses[] = {{"stress_MPa", 0, 1}, {"stress_kPa", 0, 1e-3}, {"stress_Pa", 0, 1e-6}};
constexpr const char* kExpectedColumns = "one of stretch, strain, strain_percent; one of stress_MPa, stress_kPa, "
                                         "stress_Pa; and, if wanted, mode and weight";

std::string trimmed(const std::string& field) {
  const auto first = field.find_first_not_of(" \t\r"), last = field.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : field.substr(first, last - first + 1);
}

char separatorOf(const std::string& header) {
  for (const char separator : {';', '\t'})
    if (header.find(separator) != std::string::npos) return separator;
  return ',';
}

/// What the columns of a file are; -1: it has none of that kind.
struct Header {
  char separator = ',';
  int columns = 0, stretch = -1, stress = -1, mode = -1, weight = -1;
  Column stretchColumn{}, stressColumn{};
};

class RowReader {
public:
  RowReader(std::string file, TestMode mode) : file_(std::move(file)), mode_(mode) {}

  std::vector<TestRow> read(std::string_view csv) {
    std::istringstream lines{std::string(csv)};
    std::string line;
    std::vector<TestRow> rows;
    bool begun = false;
    while (std::getline(lines, line)) {
      ++line_;
      if (line_ == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3); // the mark that spreadsheets write
      if (trimmed(line).empty() || line.starts_with("#")) continue;
      if (begun)
        rows.push_back(rowOf(line));
      else
        readHeader(line);
      begun = true;
      if (rows.size() > kMostRows) refuse("more than " + std::to_string(kMostRows) + " rows; expected fewer");
    }
    if (rows.empty()) throw Error(file_ + ": no rows of a test; expected a header with " + kExpectedColumns);
    return rows;
  }

private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(file_ + ", line " + std::to_string(line_) + ": " + what);
  }

  /// The column's place, where it is the first of its kind.
  void take(int& place, int column, const std::string& name) const {
    if (place >= 0) refuse("a second column of this kind: " + gotExpected(quotedText(name), kExpectedColumns));
    place = column;
  }

  void readHeader(const std::string& line) {
    header_.separator = separatorOf(line);
    for (const std::string& field : csvFields(line, header_.separator)) {
      const std::string name = trimmed(field);
      const int column = header_.columns++;
      const auto isNamed = [&](const Column& known) { return name == known.name; };
      if (const auto* found = std::find_if(std::begin(kStretches), std::end(kStretches), isNamed);
          found != std::end(kStretches)) {
        take(header_.stretch, column, name);
        header_.stretchColumn = *found;
      } else if (const auto* stress = std::find_if(std::begin(kStresses), std::end(kStresses), isNamed);
                 stress != std::end(kStresses)) {
        take(header_.stress, column, name);
        header_.stressColumn = *stress;
      } else if (name == "mode") {
        take(header_.mode, column, name);
      } else if (name == "weight") {
        take(header_.weight, column, name);
      } else {
        refuse("unknown column: " + gotExpected(quotedText(name), kExpectedColumns));
      }
    }
    if (header_.stretch < 0 || header_.stress < 0)
      refuse("a column is missing: " + gotExpected(quotedText(trimmed(line)), kExpectedColumns));
  }

  [[nodiscard]] double numberOf(const std::vector<std::string>& fields, int column, const char* name) const {
    const std::string field = trimmed(fields[static_cast<std::size_t>(column)]);
    const auto value = numberIn(field);
    if (!value || !std::isfinite(*value)) refuse(std::string(name) + ": " + gotExpected(quotedText(field), "a number"));
    return *value;
  }

  [[nodiscard]] TestRow rowOf(const std::string& line) const {
    const std::vector<std::string> fields = csvFields(line, header_.separator);
    if (static_cast<int>(fields.size()) != header_.columns)
      refuse(gotExpected(std::to_string(fields.size()) + " fields",
                         std::to_string(header_.columns) + ", as the header has"));
    TestRow row{.mode = mode_};
    const Column &stretch = header_.stretchColumn, &stress = header_.stressColumn;
    row.stretch = stretch.offset + stretch.factor * numberOf(fields, header_.stretch, stretch.name);
    row.stress_MPa = stress.factor * numberOf(fields, header_.stress, stress.name);
    if (!(row.stretch >= kLeastStretch && row.stretch <= kMostStretch))
      refuse("stretch: " + gotExpected(row.stretch, "", "0.01 to 100 (1 at rest; a strain counts from 0)"));
    if (header_.weight >= 0) row.weight = numberOf(fields, header_.weight, "weight");
    if (!(row.weight >= 0)) refuse("weight: " + gotExpected(row.weight, "", "0 or more"));
    if (header_.mode >= 0) {
      const std::string name = trimmed(fields[static_cast<std::size_t>(header_.mode)]);
      const auto mode = kTestModes.find(name);
      if (!mode) refuse("mode: " + gotExpected(quotedText(name), kTestModes.allowed()));
      row.mode = *mode;
    }
    return row;
  }

  std::string file_;
  TestMode mode_;
  int line_ = 0;
  Header header_;
};

} // namespace

std::vector<TestRow> parseTestRows(std::string_view csv, const std::string& file, TestMode mode) {
  return RowReader(file, mode).read(csv);
}

std::vector<TestRow> readTestRows(const std::filesystem::path& path, TestMode mode) {
  return parseTestRows(readFile(path), path.string(), mode);
}

} // namespace palp
