#pragma once

#include "app/study/reports/Report.h"

#include <map>
#include <string>
#include <vector>

namespace palp {

/// The texts of a report, from resources/reports/NAME.md. Each "## key" begins a text, in which {name} is replaced by
/// a value of the report; the lines of a text are joined by spaces. Texts of tables and charts have parts, split at " |
/// ".
class ReportText {
public:
  using Values = std::map<std::string, ReportValue>;

  /// Throws Error where the file is missing, a key appears twice or a text is empty.
  explicit ReportText(const std::string& report);

  /// The text of a key, filled in. Throws std::logic_error where the key is unknown, a name in the text has no value,
  /// or a value has no name in the text.
  [[nodiscard]] std::string operator()(const std::string& key, const Values& values = {}) const;

  /// A table from "caption | head | head ...", without rows.
  [[nodiscard]] ReportTable table(const std::string& key, const Values& values = {}) const;
  /// A chart from "caption | title | x label | y label", without curves. Throws std::logic_error where it has other
  /// parts.
  [[nodiscard]] ReportChart chart(const std::string& file, const std::string& key, const Values& values = {}) const;

  [[nodiscard]] std::vector<std::string> keys() const;
  /// The names in the text of a key, each once.
  [[nodiscard]] std::vector<std::string> names(const std::string& key) const;

private:
  [[nodiscard]] const std::string& text(const std::string& key) const;

  std::string file_;
  std::map<std::string, std::string> texts_;
};

} // namespace palp
