#include "io/measured/TableLayout.h"

#include "io/measured/Units.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <algorithm>
#include <array>
#include <map>

namespace palp {

namespace {

constexpr std::size_t kRowsTogether = 3; ///< rows of the usual width that begin the table
constexpr std::array kSeparators{',', ';', '\t', ' '};

bool isNumeric(std::string_view field, const TableLayout& layout) {
  return fieldNumber(field, layout.decimal) || fieldClock_s(field, DateOrder::DayFirst);
}

/// Fields up to the last that is not empty.
std::size_t usedFields(const std::vector<std::string_view>& fields) {
  std::size_t used = fields.size();
  while (used > 0 && fields[used - 1].empty()) --used;
  return used;
}

/// Numbers among the fields of a line.
struct LineCount {
  std::size_t used = 0, filled = 0, numeric = 0;
  /// At least half of what is filled are numbers.
  [[nodiscard]] bool isRow() const { return numeric > 0 && 2 * numeric >= filled; }
};

LineCount countFields(std::string_view line, const TableLayout& layout) {
  std::vector<std::string_view> fields;
  splitFields(line, layout.separator, fields);
  LineCount count{usedFields(fields)};
  for (const std::string_view field : fields) {
    count.filled += field.empty() ? 0 : 1;
    count.numeric += isNumeric(field, layout) ? 1 : 0;
  }
  return count;
}

/// How well separator and decimal sign of a layout fit the lines.
struct Fit {
  double score = -1e300;   ///< fields from the first row on that are numbers, minus those that are not
  std::size_t columns = 0; ///< usual width of the rows
  std::size_t first = 0;   ///< index of the first such row
};

Fit fitOf(const std::vector<NumberedLine>& lines, const TableLayout& layout) {
  std::vector<LineCount> counts;
  std::map<std::size_t, std::size_t> widths;
  for (const NumberedLine& line : lines) {
    counts.push_back(isComment(line.text) ? LineCount{} : countFields(line.text, layout));
    if (counts.back().isRow()) ++widths[counts.back().used];
  }
  Fit fit;
  std::size_t most = 0;
  for (const auto& [width, count] : widths)
    if (count >= most) {
      most = count;
      fit.columns = width;
    }
  const auto isUsual = [&fit](const LineCount& count) { return count.isRow() && count.used == fit.columns; };
  // A line of a preamble may look like a row; rows follow each other.
  std::size_t first = counts.size(), longest = 0;
  for (std::size_t i = 0, length = 0; i < counts.size() && longest < kRowsTogether; ++i) {
    if (counts[i].filled == 0) continue; // blank, or a comment
    length = isUsual(counts[i]) ? length + 1 : 0;
    if (length == 1) first = i;
    if (length <= longest) continue;
    longest = length;
    fit.first = first;
  }
  fit.score = 0;
  for (std::size_t i = fit.first; i < counts.size(); ++i)
    fit.score += 2 * static_cast<double>(counts[i].numeric) - static_cast<double>(counts[i].filled);
  return fit;
}

std::vector<std::string> texts(std::string_view line, char separator, std::size_t columns) {
  std::vector<std::string_view> fields;
  splitFields(line, separator, fields);
  std::vector<std::string> all(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(usedFields(fields)));
  all.resize(std::max(all.size(), columns));
  return all;
}

/// Names in a comment line, which may be separated otherwise than the rows: "# t, Fx, Fy" above "1.0 2.0 3.0".
std::vector<std::string> commentNames(std::string_view line, std::size_t columns) {
  line.remove_prefix(std::min(line.find_first_not_of("#%/ \t"), line.size()));
  for (const char separator : kSeparators)
    if (auto names = texts(line, separator, 0); names.size() == columns && columns > 1) return names;
  return {};
}

/// Whether the line has words for the columns.
bool areNames(const std::vector<std::string>& cells, const TableLayout& layout) {
  const auto filled = static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](const std::string& cell) { return !cell.empty(); }));
  const auto words = static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [&](const std::string& cell) { return !cell.empty() && !isNumeric(cell, layout); }));
  return filled > 0 && 2 * words > filled && 2 * filled >= layout.columns;
}

bool areUnits(const std::vector<std::string>& cells) {
  bool any = false;
  for (const std::string& cell : cells) {
    const bool bracketed = cell.size() > 1 && (cell.front() == '[' || cell.front() == '(');
    const bool unit = knownUnit(cell).has_value() || bracketed;
    if (!unit && !cell.empty() && cell != "-" && cell != "1" && cell != "V" && cell != "mV") return false;
    any = any || unit;
  }
  return any;
}

/// Looks above the first row for the names of the columns and, between, their units.
void findNames(const std::vector<NumberedLine>& lines, std::size_t first, TableLayout& layout) {
  for (std::size_t i = first; i-- > 0;) {
    const std::string& text = lines[i].text;
    if (isEmptyLine(text, layout.separator)) continue;
    auto cells = isComment(text) ? commentNames(text, layout.columns) : texts(text, layout.separator, layout.columns);
    if (!isComment(text) && countFields(text, layout).isRow())
      continue; // a row of another width, which is refused later
    if (cells.size() < layout.columns || !areNames(cells, layout)) return;
    if (layout.unitsLine == 0 && areUnits(cells)) {
      layout.units = cells;
      layout.unitsLine = lines[i].number;
      continue;
    }
    layout.names = cells;
    layout.namesLine = lines[i].number;
    return;
  }
}

/// Separator and decimal sign by which most fields are numbers; of equal ones the first.
Fit findDialect(const std::vector<NumberedLine>& lines, const TableForm& form, TableLayout& layout) {
  Fit best;
  TableLayout tried = layout;
  const bool quoted = std::any_of(lines.begin(), lines.end(),
                                  [](const NumberedLine& line) { return line.text.find('"') != std::string::npos; });
  for (const char decimal : {'.', ','})
    for (const char separator : kSeparators) {
      if (form.separator.value_or(separator) != separator || form.decimal.value_or(decimal) != decimal) continue;
      if (separator == ',' && decimal == ',' && !quoted) continue; // "0,5","1,5"
      tried.separator = separator;
      tried.decimal = decimal;
      const Fit fit = fitOf(lines, tried);
      if (fit.columns == 0 || fit.score <= best.score) continue;
      best = fit;
      layout = tried;
    }
  return best;
}

void namesFromLine(const std::vector<NumberedLine>& lines, int number, const std::string& file, TableLayout& layout) {
  const auto line = std::find_if(lines.begin(), lines.end(), [number](const NumberedLine& candidate) {
    return candidate.number == static_cast<std::size_t>(number);
  });
  if (line == lines.end())
    throw Error(file + ": line with the names of the columns: " +
                gotExpected(std::to_string(number), "1 to " + std::to_string(lines.back().number)));
  layout.names = isComment(line->text) ? commentNames(line->text, layout.columns)
                                       : texts(line->text, layout.separator, layout.columns);
  layout.namesLine = line->number;
  if (layout.firstLine > layout.namesLine + 1 && std::next(line) != lines.end()) {
    auto cells = texts(std::next(line)->text, layout.separator, layout.columns);
    if (!areUnits(cells)) return;
    layout.units = std::move(cells);
    layout.unitsLine = std::next(line)->number;
  }
}

} // namespace

void splitFields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  const bool blanks = separator == ' ';
  if (blanks) {
    const std::size_t end = line.find_last_not_of(" \t");
    line = line.substr(0, end == std::string_view::npos ? 0 : end + 1);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.empty()) return;
  }
  const char* const separators = blanks ? " \t" : nullptr;
  while (true) {
    std::size_t from = std::min(line.find_first_not_of(" \t"), line.size());
    if (separator == '\t') from = std::min(line.find_first_not_of(' '), line.size());
    std::size_t at = 0;
    if (from < line.size() && line[from] == '"') { // up to its closing quote, which is not doubled
      at = from + 1;
      while ((at = line.find('"', at)) != std::string_view::npos && at + 1 < line.size() && line[at + 1] == '"')
        at += 2;
      at = at == std::string_view::npos ? 0 : at;
    }
    at = blanks ? line.find_first_of(separators, at) : line.find(separator, at);
    fields.push_back(trimmedField(line.substr(0, at)));
    if (at == std::string_view::npos) return;
    line.remove_prefix(at + 1);
    if (blanks) line.remove_prefix(std::min(line.find_first_not_of(separators), line.size()));
  }
}

bool isEmptyLine(std::string_view line, char separator) {
  return line.find_first_not_of(std::string(" \t") + separator) == std::string_view::npos;
}

bool isComment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos) return false;
  line.remove_prefix(first);
  return line.front() == '#' || line.front() == '%' || line.starts_with("//");
}

TableLayout findLayout(const std::vector<NumberedLine>& lines, const TableForm& form, const std::string& file) {
  TableLayout layout;
  layout.dates = form.dates;
  std::vector<NumberedLine> rows = lines;
  const int begin = std::max(form.firstLine.value_or(0), form.namesLine.value_or(0) + 1);
  std::erase_if(rows, [begin](const NumberedLine& line) { return line.number < static_cast<std::size_t>(begin); });
  const Fit fit = findDialect(rows, form, layout);
  if (fit.columns == 0) throw Error(file + ": has no rows of numbers");
  layout.columns = layout.usualFields = fit.columns;
  layout.firstLine = rows[fit.first].number;
  const auto first = static_cast<std::size_t>(
      std::find_if(lines.begin(), lines.end(),
                   [&layout](const NumberedLine& line) { return line.number == layout.firstLine; }) -
      lines.begin());
  if (form.namesLine.value_or(0) > 0)
    namesFromLine(lines, *form.namesLine, file, layout);
  else if (!form.namesLine)
    findNames(lines, first, layout);
  if (!form.firstLine && layout.namesLine > 0) layout.firstLine = std::max(layout.namesLine, layout.unitsLine) + 1;
  layout.columns = std::max({layout.columns, layout.names.size(), layout.units.size()});
  layout.names.resize(layout.columns);
  layout.units.resize(layout.columns);
  std::vector<std::string_view> fields;
  for (const NumberedLine& line : lines)
    if (line.number == layout.namesLine && !isComment(line.text)) {
      splitFields(line.text, layout.separator, fields);
      layout.fieldsOfNames = fields.size();
    }
  splitFields(lines[first].text, layout.separator, fields);
  for (std::size_t i = 0; i < layout.columns; ++i)
    layout.date.push_back(i < fields.size() && !fieldNumber(fields[i], layout.decimal) &&
                          fieldClock_s(fields[i], DateOrder::DayFirst));
  return layout;
}

} // namespace palp
