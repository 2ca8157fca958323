#include "app/study/reports/ReportPage.h"

#include "model/base/Base64.h"
#include "model/base/Error.h"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <regex>

namespace palp {

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1b1f24; --soft: #57606a; --line: #d0d7de; --ground: #ffffff; --band: #f6f8fa; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6edf3; --soft: #9198a1; --line: #3d444d; --ground: #0d1117; --band: #161b22; } }
body { font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; color: var(--ink); background: var(--ground); max-width: 76rem; margin: 2rem auto; padding: 0 1rem; } p, figcaption { max-width: 62rem; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.25rem; margin-top: 2.2rem; border-bottom: 1px solid var(--line); padding-bottom: .2rem; }
table { display: block; overflow-x: auto; border-collapse: collapse; margin: .8rem 0; font-variant-numeric: tabular-nums; font-size: .92rem; }
caption { text-align: left; color: var(--soft); padding-bottom: .3rem; }
th, td { padding: .25rem .7rem; border-bottom: 1px solid var(--line); text-align: right; } th:first-child, td:first-child { text-align: left; } .number { white-space: nowrap; }
th { background: var(--band); } tr.good td:first-child { border-left: .4rem solid #1a7f37; } tr.doubtful td { background: #d4a72c33; }
tr.doubtful td:first-child { border-left: .4rem solid #d4a72c; } tr.bad td { background: #cf222e33; } tr.bad td:first-child { border-left: .4rem solid #cf222e; } figure { margin: 1rem 0; } figure img { max-width: 100%; height: auto; border: 1px solid var(--line); }
figcaption { color: var(--soft); font-size: .92rem; } pre { background: var(--band); padding: .7rem; overflow-x: auto; }
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// Keeps a browser from breaking 4.5e-05 after its hyphen, and three numbers of a triple apart.
std::string unbroken(const std::string& text) {
  static const std::regex triple("[0-9.e+-]+ / [0-9.e+-]+ / [0-9.e+-]+|[0-9.]+e-[0-9]+");
  return std::regex_replace(text, triple, "<span class=\"number\">$&</span>");
}

} // namespace

ReportPage::ReportPage(std::string title) : title_(std::move(title)) {}

void ReportPage::heading(const std::string& text) {
  body_ += "<h2>" + escaped(text) + "</h2>\n";
}

void ReportPage::paragraph(const std::string& text) {
  body_ += "<p>" + escaped(text) + "</p>\n";
}

void ReportPage::code(const std::string& text) {
  body_ += "<pre>" + escaped(text) + "</pre>\n";
}

void ReportPage::table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows,
                       const std::string& caption, const std::vector<std::string>& rowClasses) {
  body_ += "<table>";
  if (!caption.empty()) body_ += "<caption>" + escaped(caption) + "</caption>";
  body_ += "<thead><tr>";
  for (const std::string& head : heads) body_ += "<th>" + escaped(head) + "</th>";
  body_ += "</tr></thead><tbody>\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    body_ += r >= rowClasses.size() || rowClasses[r].empty() ? "<tr>" : "<tr class=\"" + rowClasses[r] + "\">";
    for (const std::string& cell : rows[r]) body_ += "<td>" + unbroken(escaped(cell)) + "</td>";
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table>\n";
}

void ReportPage::picture(const std::filesystem::path& png, const std::string& caption) {
  std::ifstream file(png, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.empty()) throw Error(png.string() + ": the picture cannot be read back for the report");
  body_ += "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," + base64(bytes) +
           "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string ReportPage::html() const {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\"><title>" +
         escaped(title_) + "</title><style>" + kStyle + "</style></head><body>\n<h1>" + escaped(title_) + "</h1>\n" +
         body_ + "</body></html>\n";
}

} // namespace palp
