#pragma once

// Private to io: the head of a sample file and the lines below it.

#include "model/SampleSet.h"

#include <functional>
#include <istream>
#include <string>
#include <string_view>

namespace palp {

/// Names of the columns, in the order of the file, joined by commas.
std::string sampleColumns(const SampleSet& set);

/// Reads the lines of a sample file one by one, and counts them for the refusals.
class SampleLines {
public:
  SampleLines(std::istream& stream, std::string file) : stream_(stream), file_(std::move(file)) {}

  /// The next line without its end; false at the end of the file. A last line without an end is cut off: it throws
  /// Error, or counts as the end where `cutOffIsTheEnd`.
  bool next(std::string& line, bool cutOffIsTheEnd = false);
  /// Throws Error: file, line, sentence.
  [[noreturn]] void refuse(const std::string& sentence) const;
  [[nodiscard]] std::size_t line() const { return line_; }

private:
  std::istream& stream_;
  std::string file_;
  std::size_t line_ = 0;
};

/// Reads the comment lines and the names of the columns into a set without samples, whose matrices have their rows.
/// Throws Error.
SampleSet readSampleHead(SampleLines& lines);

/// Calls `write` with the lines of the set, one per sample, in pieces of a few megabytes.
void writeSampleLines(const SampleSet& set, const std::function<void(const std::string&)>& write);

/// Reads one line into the column of the set (the matrices are wide enough). Throws Error.
void readSampleLine(const SampleLines& lines, std::string_view line, SampleSet& set, Eigen::Index column);

/// Numbers of one line: area, forces, displacements, resistances.
std::size_t sampleFields(const SampleSet& head);

} // namespace palp
