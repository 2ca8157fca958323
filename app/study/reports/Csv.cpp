#include "app/study/reports/Csv.h"

#include "io/CsvText.h"
#include "model/base/Text.h"

#include <cassert>

namespace palp {

CsvCell::CsvCell(const char* words) : text_(csvField(words)) {}
CsvCell::CsvCell(const std::string& words) : text_(csvField(words)) {}
CsvCell::CsvCell(double number) : text_(palp::text(number)) {}
CsvCell::CsvCell(int number) : text_(std::to_string(number)) {}

Csv::Csv(const std::vector<std::string>& heads) : columns_(heads.size()) {
  for (std::size_t i = 0; i < heads.size(); ++i) text_ += (i > 0 ? "," : "") + csvField(heads[i]);
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

void Csv::addForces(const std::vector<CsvForces>& quantities, const std::vector<CsvCell>& cells,
                    const std::vector<CsvCell>& after) {
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const CsvForces& quantity : quantities) {
      std::vector<CsvCell> line{quantity.what};
      line.insert(line.end(), cells.begin(), cells.end());
      line.emplace_back(std::string("F") + "xyz"[axis]);
      line.insert(line.end(), after.begin(), after.end());
      line.emplace_back(quantity.values(axis));
      add(line);
    }
}

} // namespace palp
