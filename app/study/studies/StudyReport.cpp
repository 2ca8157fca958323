#include "app/study/studies/StudyReport.h"

#include "app/study/reports/ReportPage.h"
#include "app/study/studies/StudyRow.h"
#include "io/AtomicFile.h"
#include "io/CsvText.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace palp {

namespace {

constexpr std::size_t kBest = 10;
constexpr std::size_t kMostCharts = 24;

std::optional<double> numberIn(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return {};
  return value;
}

/// The columns whose smallest values the page lists: one a quantity.
bool isChief(const std::string& column) {
  return column == "bound_mean_percent" || column.ends_with("_rms_percent") || column == "largest_displacement_mm" ||
         column == "mesh_error_percent";
}

} // namespace

ReportContent studyReport(const StudyFolder& study) {
  const StudyPlan& plan = study.plan();
  std::vector<std::vector<std::string>> rows;
  std::istringstream table(readFile(study.table()));
  std::string line;
  std::getline(table, line);
  const std::vector<std::string> columns = csvFields(line);
  while (std::getline(table, line)) rows.push_back(csvFields(line));
  const std::size_t problem = 1 + plan.axes.size();
  const auto failed = std::count_if(rows.begin(), rows.end(), [&](const auto& row) { return !row[problem].empty(); });

  ReportContent content;
  content.title = "Study of " + std::to_string(rows.size()) + " designs";
  content.csv = readFile(study.table());
  content.summary = std::to_string(rows.size()) + " designs, " + std::to_string(failed) + " of them without a result.";
  if (const std::string mixed = study.mixedPrograms(); !mixed.empty()) content.parts.emplace_back(ReportWords{mixed});
  std::size_t charts = 0;
  for (std::size_t c = problem + 1; c < columns.size(); ++c) {
    if (!isChief(columns[c])) continue;
    std::vector<std::pair<double, std::size_t>> order; // the smallest first, equal ones by number
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (const auto value = numberIn(rows[i][c])) order.emplace_back(*value, i);
    if (order.empty()) continue;
    std::sort(order.begin(), order.end());
    content.parts.push_back(ReportHeading{columns[c]});
    ReportTable best{"Smallest " + columns[c], {"design"}, {}, {}};
    for (const StudyAxis& axis : plan.axes) best.heads.push_back(axis.key);
    best.heads.push_back(columns[c]);
    for (std::size_t k = 0; k < std::min(kBest, order.size()); ++k) {
      const std::vector<std::string>& row = rows[order[k].second];
      std::vector<std::string> cells(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(problem));
      cells.push_back(shortNumber(order[k].first));
      best.rows.push_back(std::move(cells));
    }
    content.parts.emplace_back(std::move(best));
    content.summary += " Smallest " + columns[c] + ": " + shortNumber(order.front().first) + " of design " +
                       std::to_string(order.front().second) + ".";
    content.figures.emplace_back("smallest " + columns[c], order.front().first);
    for (std::size_t a = 0; a < plan.axes.size() && charts < kMostCharts; ++a) {
      ReportCurve points{.name = columns[c], .style = ReportCurve::Style::Points};
      for (const auto& [value, i] : order)
        if (const auto x = numberIn(rows[i][1 + a])) {
          points.x.push_back(*x);
          points.y.push_back(value);
        }
      if (points.x.size() < 2) continue; // words, not numbers
      ++charts;
      content.parts.emplace_back(
          ReportChart{.file = columns[c] + "-over-" + std::to_string(a + 1),
                      .caption = columns[c] + " over " + plan.axes[a].key + ", one point per design.",
                      .title = columns[c],
                      .xLabel = plan.axes[a].key,
                      .yLabel = columns[c],
                      .logX = plan.axes[a].logarithmic,
                      .curves = {std::move(points)}});
    }
  }
  if (failed > 0) {
    ReportTable problems{"Designs without a result", {"design", "why"}, {}, {}};
    for (const auto& row : rows)
      if (!row[problem].empty() && problems.rows.size() < kBest) problems.rows.push_back({row[0], row[problem]});
    content.parts.push_back(ReportHeading{"Designs without a result"});
    content.parts.emplace_back(std::move(problems));
  }
  return content;
}

} // namespace palp
