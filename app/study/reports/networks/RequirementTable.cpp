#include "app/study/reports/networks/RequirementTable.h"

#include "app/study/Median.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

/// Three digits of each are what a reader compares.
std::string readable(const Eigen::Vector3d& values) {
  const auto digits = [](double value) {
    const double unit = value == 0 ? 1 : std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
    return std::round(value / unit) * unit;
  };
  return triple(values.unaryExpr(digits));
}

} // namespace

Eigen::Vector3d largest(const Triples& values) {
  Eigen::Vector3d result = values.front();
  for (const Eigen::Vector3d& value : values) result = result.cwiseMax(value);
  return result;
}

Triples ratios(const Triples& above, const Triples& below) {
  Triples values;
  for (std::size_t s = 0; s < above.size(); ++s) values.emplace_back(above[s].cwiseQuotient(below[s]));
  return values;
}

void RequirementTable::add(const std::string& what, const Eigen::Vector3d& required, const Triples& values,
                           const std::string& note) {
  const auto meets = [&](const Eigen::Vector3d& value) { return (value.array() <= required.array()).all(); };
  const bool alike = required.x() == required.y() && required.y() == required.z();
  const std::string most = "at most " + (alike ? shortNumber(required.x()) : triple(required));
  addRow({what, required.allFinite() ? most : "", readable(median(values)), readable(largest(values)), note},
         meets(largest(values)), meets(median(values)));
  if (!required.allFinite()) table_.marks.back() = ReportTable::Mark::Plain;
  for (std::size_t s = 0; s < values.size(); ++s)
    for (int axis = 0; axis < 3; ++axis)
      csv_.add(
          {what, static_cast<double>(firstSeed_ + s), std::string("F") + "xyz"[axis], values[s](axis), required(axis)});
}

void RequirementTable::add(const std::string& what, double required, const std::vector<double>& values,
                           const std::string& note) {
  const double worst = *std::max_element(values.begin(), values.end()), middle = median(values);
  addRow({what, "at most " + shortNumber(required), middle, worst, note}, worst <= required, middle <= required);
  for (std::size_t s = 0; s < values.size(); ++s)
    csv_.add({what, static_cast<double>(firstSeed_ + s), "", values[s], required});
}

void RequirementTable::addRow(std::initializer_list<ReportValue> cells, bool all, bool half) {
  table_.add(cells, all ? ReportTable::Mark::Good : half ? ReportTable::Mark::Doubtful : ReportTable::Mark::Bad);
}

std::string RequirementTable::summary() const {
  const auto count = [&](ReportTable::Mark mark) { return std::count(table_.marks.begin(), table_.marks.end(), mark); };
  const auto met = count(ReportTable::Mark::Good), half = count(ReportTable::Mark::Doubtful),
             missed = count(ReportTable::Mark::Bad);
  return words_("summary", {{"met", met}, {"all", met + half + missed}, {"half", half}, {"missed", missed}});
}

} // namespace palp
