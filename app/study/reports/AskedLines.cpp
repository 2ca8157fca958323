#include "app/study/reports/AskedLines.h"

#include "app/study/Median.h"
#include "app/study/reports/ReportPage.h"

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

void AskedLines::add(const std::string& what, const Eigen::Vector3d& asked, const Triples& values,
                     const std::string& beside) {
  const auto keeps = [&](const Eigen::Vector3d& value) { return (value.array() <= asked.array()).all(); };
  const bool alike = asked.x() == asked.y() && asked.y() == asked.z();
  const std::string most = "at most " + (alike ? shortNumber(asked.x()) : triple(asked));
  addRow({what, asked.allFinite() ? most : "", readable(median(values)), readable(largest(values)), beside},
         keeps(largest(values)), keeps(median(values)));
  if (!asked.allFinite()) table_.marks.back() = ReportTable::Mark::Plain; // nothing is asked: it stands for comparison
  for (std::size_t s = 0; s < values.size(); ++s)
    for (int axis = 0; axis < 3; ++axis)
      csv_.add(
          {what, static_cast<double>(firstSeed_ + s), std::string("F") + "xyz"[axis], values[s](axis), asked(axis)});
}

void AskedLines::add(const std::string& what, double asked, const std::vector<double>& values,
                     const std::string& beside) {
  const double worst = *std::max_element(values.begin(), values.end()), middle = median(values);
  addRow({what, "at most " + shortNumber(asked), shortNumber(middle), shortNumber(worst), beside}, worst <= asked,
         middle <= asked);
  for (std::size_t s = 0; s < values.size(); ++s)
    csv_.add({what, static_cast<double>(firstSeed_ + s), "", values[s], asked});
}

void AskedLines::addRow(std::vector<std::string> cells, bool all, bool half) {
  table_.rows.push_back(std::move(cells));
  table_.marks.push_back(all ? ReportTable::Mark::Good : half ? ReportTable::Mark::Doubtful : ReportTable::Mark::Bad);
}

std::string AskedLines::summary() const {
  const auto count = [&](ReportTable::Mark mark) { return std::count(table_.marks.begin(), table_.marks.end(), mark); };
  const auto good = count(ReportTable::Mark::Good), half = count(ReportTable::Mark::Doubtful),
             bad = count(ReportTable::Mark::Bad);
  return std::to_string(good) + " of " + std::to_string(good + half + bad) +
         " requirements are met on every set of samples, " + std::to_string(half) + " only in the median, " +
         std::to_string(bad) + " are not met.";
}

} // namespace palp
