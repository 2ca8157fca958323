#include "app/study/reports/Csv.h"

#include "model/base/Text.h"

#include <cassert>

namespace palp {

namespace {

std::string quoted(const std::string& words) {
  if (words.find_first_of(",\"\n") == std::string::npos) return words;
  std::string result = "\"";
  for (const char c : words) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

} // namespace

CsvCell::CsvCell(const char* words) : text_(quoted(words)) {}
CsvCell::CsvCell(const std::string& words) : text_(quoted(words)) {}
CsvCell::CsvCell(double number) : text_(palp::text(number)) {}
CsvCell::CsvCell(int number) : text_(std::to_string(number)) {}

Csv::Csv(const std::vector<std::string>& heads) : columns_(heads.size()) {
  for (std::size_t i = 0; i < heads.size(); ++i) text_ += (i > 0 ? "," : "") + quoted(heads[i]);
  text_ += '\n';
}

void Csv::add(std::initializer_list<CsvCell> cells) {
  add(std::vector<CsvCell>(cells));
}

void Csv::add(const std::vector<CsvCell>& cells) {
  assert(cells.size() == columns_ && "as many cells as heads");
  bool first = true;
  for (const CsvCell& cell : cells) {
    if (!first) text_ += ',';
    text_ += cell.text();
    first = false;
  }
  text_ += '\n';
}

} // namespace palp
