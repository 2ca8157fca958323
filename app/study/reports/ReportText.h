#pragma once

#include <map>
#include <string>
#include <vector>

namespace palp {

/// The words of a report, from resources/reports/NAME.md. Each "## key" begins a text, in which {name} stands for what
/// the report fills in; the lines of a text are joined by spaces.
class ReportText {
public:
  using Values = std::map<std::string, std::string>;

  /// Throws Error where the file is missing, a key appears twice or a text is empty.
  explicit ReportText(const std::string& report);

  /// The text of a key, filled in. Throws std::logic_error where the key is unknown, a name in the text has no value,
  /// or a value has no name in the text.
  [[nodiscard]] std::string operator()(const std::string& key, const Values& values = {}) const;

  [[nodiscard]] std::vector<std::string> keys() const;
  /// The names in the text of a key, each once.
  [[nodiscard]] std::vector<std::string> names(const std::string& key) const;

private:
  [[nodiscard]] const std::string& text(const std::string& key) const;

  std::string file_;
  std::map<std::string, std::string> texts_;
};

} // namespace palp
