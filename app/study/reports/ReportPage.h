#pragma once

#include "app/study/reports/ReportValue.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp {

/// One self-contained HTML page: words, tables, pictures inside the file; opens from disk with no network.
class ReportPage {
public:
  explicit ReportPage(std::string title);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  /// A command line or its output, as it is.
  void code(const std::string& text);
  /// First column left, numbers right; every row has as many cells as there are heads. `rowClasses` colours rows: good,
  /// doubtful, bad, or nothing; rows beyond the last of them have no colour.
  void table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows,
             const std::string& caption = {}, const std::vector<std::string>& rowClasses = {});
  /// Embeds a PNG file. Throws Error where it cannot be read.
  void picture(const std::filesystem::path& png, const std::string& caption);

  [[nodiscard]] std::string html() const;

private:
  std::string title_;
  std::string body_;
};

} // namespace palp
