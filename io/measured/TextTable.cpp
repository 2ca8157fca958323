#include "io/measured/MeasuredTable.h"
#include "io/measured/TableLayout.h"
#include "io/measured/TextLines.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <algorithm>
#include <deque>
#include <unordered_map>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLinesLookedAt = 300;
constexpr std::size_t kBytesLookedAt = 1 << 20;
constexpr std::size_t kLinesShown = 5; ///< of those before the table

std::string shownField(std::string_view text) {
  return "\"" + std::string(text.substr(0, 40)) + (text.size() > 40 ? "..." : "") + "\"";
}

/// A table of text. The first lines are kept to find its form; the rest is read line by line.
class TextTable : public MeasuredTable {
public:
  TextTable(const fs::path& path, const TableForm& form) : lines_(path) {
    std::vector<NumberedLine> first;
    std::size_t bytes = 0;
    for (std::string line; first.size() < kLinesLookedAt && bytes < kBytesLookedAt && lines_.next(line);) {
      bytes += line.size();
      first.push_back({lines_.number(), line});
      lastOfFirstIsCut_ = lines_.withoutEnd();
    }
    if (first.empty()) throw Error(path.string() + ": the file is empty");
    layout_ = findLayout(first, form, path.string());
    for (NumberedLine& line : first) {
      if (line.number >= layout_.firstLine)
        waiting_.push_back(std::move(line));
      else if (before_.size() < kLinesShown && line.number != layout_.namesLine && line.number != layout_.unitsLine &&
               !isEmptyLine(line.text, layout_.separator))
        before_.push_back(std::move(line.text));
    }
  }

  [[nodiscard]] const std::vector<std::string>& columns() const override { return layout_.names; }
  [[nodiscard]] std::vector<std::string> units() const override { return layout_.units; }
  [[nodiscard]] bool isDate(std::size_t column) const override { return layout_.date[column]; }

  [[nodiscard]] std::string form() const override {
    const auto named = [](char letter) {
      return letter == '\t'  ? "tab"
             : letter == ' ' ? "blank"
             : letter == '.' ? "point"
             : letter == ',' ? "comma"
                             : "semicolon";
    };
    std::string words = "separator " + std::string(named(layout_.separator)) + ", decimal " + named(layout_.decimal);
    words += layout_.namesLine > 0 ? ", names in line " + std::to_string(layout_.namesLine) : ", no names";
    if (layout_.unitsLine > 0) words += ", units in line " + std::to_string(layout_.unitsLine);
    return words + ", first row in line " + std::to_string(layout_.firstLine);
  }

  [[nodiscard]] std::vector<std::string> before() const override { return before_; }

  [[nodiscard]] std::vector<std::vector<std::string>> firstRows(std::size_t count) override {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string_view> fields;
    for (const NumberedLine& line : waiting_) {
      if (rows.size() == count) break;
      if (isEmptyLine(line.text, layout_.separator) || isComment(line.text)) continue;
      splitFields(line.text, layout_.separator, fields);
      rows.emplace_back(fields.begin(), fields.end()).resize(layout_.columns);
    }
    return rows;
  }

  void choose(std::vector<ChosenColumn> chosen) override {
    chosen_ = std::move(chosen);
    labels_.resize(chosen_.size());
  }

  bool next(std::span<double> values, std::vector<std::string>& problems) override {
    if (!nextRow()) return false;
    splitFields(line_.text, layout_.separator, fields_);
    const std::size_t before = problems.size();
    requireWidth(problems);
    for (std::size_t i = 0; i < chosen_.size() && problems.size() == before; ++i) read(i, values[i], problems);
    return true;
  }

  [[nodiscard]] std::string where() const override { return "line " + std::to_string(line_.number); }
  [[nodiscard]] double share() const override { return waiting_.empty() ? lines_.share() : 0; }

private:
  /// The next line that is neither blank nor a comment.
  bool nextRow() {
    do {
      if (!waiting_.empty()) {
        line_ = std::move(waiting_.front());
        waiting_.pop_front();
        isCut_ = waiting_.empty() && lastOfFirstIsCut_;
        continue;
      }
      if (!lines_.next(line_.text)) return false;
      line_.number = lines_.number();
      isCut_ = lines_.withoutEnd();
    } while (isEmptyLine(line_.text, layout_.separator) || isComment(line_.text));
    return true;
  }

  /// As many fields as columns. More are accepted where they are empty, or words after the rows of a table without
  /// names.
  void requireWidth(std::vector<std::string>& problems) {
    std::size_t count = fields_.size();
    if (count == layout_.fieldsOfNames && count > largest()) return;
    while (count > layout_.columns && (fields_[count - 1].empty() ||
                                       (layout_.namesLine == 0 && !fieldNumber(fields_[count - 1], layout_.decimal))))
      --count;
    if (count == layout_.columns) return;
    if (count < layout_.columns && count > largest() && (layout_.namesLine == 0 || count == layout_.usualFields))
      return;
    if (isCut_ && count < layout_.columns)
      problems.push_back("the file ends in the middle of this line");
    else
      problems.push_back(std::to_string(count) + " fields; expected, by the " +
                         (layout_.namesLine > 0 ? "names of the columns" : "other rows") + ", " +
                         std::to_string(layout_.columns));
  }

  [[nodiscard]] std::size_t largest() const {
    std::size_t most = 0;
    for (const ChosenColumn& chosen : chosen_) most = std::max(most, chosen.column);
    return most;
  }

  void read(std::size_t i, double& value, std::vector<std::string>& problems) {
    const std::string_view field = fields_[chosen_[i].column];
    if (chosen_[i].as == ChosenColumn::As::Label) {
      value = static_cast<double>(labels_[i].try_emplace(std::string(field), labels_[i].size()).first->second);
      return;
    }
    auto number = fieldNumber(field, layout_.decimal);
    const bool clock = chosen_[i].as == ChosenColumn::As::Clock;
    if (!number && clock) number = fieldClock_s(field, layout_.dates);
    if (number) {
      value = *number;
      return;
    }
    const bool twoWays = clock && fieldClock_s(field, DateOrder::DayFirst);
    const std::string& name = layout_.names[chosen_[i].column];
    problems.push_back("column " + (name.empty() ? std::to_string(chosen_[i].column + 1) : name) + ": " +
                       gotExpected(shownField(field), twoWays ? "\"dates\": \"day first\" or \"month first\" in the map"
                                                      : clock ? "a number, a date or a time of day"
                                                              : "a finite number"));
  }

  TextLines lines_;
  TableLayout layout_;
  std::deque<NumberedLine> waiting_;
  std::vector<std::string> before_;
  bool lastOfFirstIsCut_ = false, isCut_ = false;
  NumberedLine line_;
  std::vector<std::string_view> fields_;
  std::vector<ChosenColumn> chosen_;
  std::vector<std::unordered_map<std::string, std::size_t>> labels_;
};

} // namespace

std::unique_ptr<MeasuredTable> openTextTable(const fs::path& path, const TableForm& form) {
  return std::make_unique<TextTable>(path, form);
}

} // namespace palp
