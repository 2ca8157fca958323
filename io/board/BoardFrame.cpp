#include "io/board/BoardFrame.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr std::uint32_t kShort = 0;
constexpr std::uint32_t kOpen = 0xFFFFFF;
constexpr std::uint32_t kNotMeasured = 0xFFFFFE;
constexpr double kFullScale = 1 << 24;

const char* word(ReadingState state) {
  switch (state) {
  case ReadingState::Missing:
    return "no reading received";
  case ReadingState::Good:
    return "good";
  case ReadingState::Short:
    return "short";
  case ReadingState::Open:
    return "open";
  case ReadingState::NotMeasured:
    return "not measured";
  }
  return "";
}

std::string columnsInWords(int first, int last) {
  return first == last ? "column-wire " + std::to_string(first)
                       : "column-wires " + std::to_string(first) + " to " + std::to_string(last);
}

std::vector<int> expectedRows(const BoardFrame& frame) {
  std::vector<int> rows;
  for (int row = 0; row < static_cast<int>(frame.rowExpected.size()); ++row)
    if (frame.rowExpected[static_cast<std::size_t>(row)]) rows.push_back(row);
  return rows;
}

} // namespace

bool BoardFrame::rowGood(int row) const {
  return (state.row(row).array() == ReadingState::Good).all();
}

DecodedReading decodeCode(std::uint32_t code, double reference_ohm) {
  if (code == kShort) return {ReadingState::Short, 0};
  if (code >= kOpen) return {ReadingState::Open, 0};
  if (code == kNotMeasured) return {ReadingState::NotMeasured, 0};
  return {ReadingState::Good, reference_ohm * code / (kFullScale - code)};
}

std::uint32_t encodeResistance(double resistance_ohm, double reference_ohm) {
  if (std::isinf(resistance_ohm)) return kOpen;
  if (!(resistance_ohm > 0)) return kShort;
  const double code = std::round(kFullScale * resistance_ohm / (resistance_ohm + reference_ohm));
  return static_cast<std::uint32_t>(std::clamp(code, 1.0, static_cast<double>(kNotMeasured - 1)));
}

std::vector<std::string> wireFaults(const BoardFrame& frame) {
  const std::vector<int> rows = expectedRows(frame);
  const auto columns = static_cast<int>(frame.state.cols());
  std::vector<std::string> faults;
  std::vector<bool> wholeColumn(static_cast<std::size_t>(columns));
  for (int column = 0; column < columns && rows.size() > 1; ++column) {
    const ReadingState first = frame.state(rows[0], column);
    const bool all = first != ReadingState::Good &&
                     std::all_of(rows.begin(), rows.end(), [&](int row) { return frame.state(row, column) == first; });
    wholeColumn[static_cast<std::size_t>(column)] = all;
  }
  for (const int row : rows) { // a complete row comes first: with it, every column looks bad
    const ReadingState first = frame.state(row, 0);
    if (first != ReadingState::Good && (frame.state.row(row).array() == first).all()) {
      faults.push_back("row-wire " + std::to_string(row) + ": " + word(first));
      continue;
    }
    for (int column = 0; column < columns; ++column) {
      const ReadingState bad = frame.state(row, column);
      if (bad == ReadingState::Good || wholeColumn[static_cast<std::size_t>(column)]) continue;
      const int from = column;
      while (column + 1 < columns && frame.state(row, column + 1) == bad &&
             !wholeColumn[static_cast<std::size_t>(column) + 1])
        ++column;
      faults.push_back("row-wire " + std::to_string(row) + ", " + columnsInWords(from, column) + ": " + word(bad));
    }
  }
  const bool everything = std::all_of(wholeColumn.begin(), wholeColumn.end(), [](bool bad) { return bad; });
  for (int column = 0; column < columns && !everything; ++column)
    if (wholeColumn[static_cast<std::size_t>(column)])
      faults.push_back("column-wire " + std::to_string(column) + ": " + word(frame.state(rows[0], column)));
  return faults;
}

} // namespace palp
