#include "app/study/reports/stability/StabilityReport.h"

#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/stability/StabilityRow.h"
#include "model/base/NumberText.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int kExpectedCases = 131; // for the progress alone

ReportTable::Mark mark(StabilityOutcome outcome) {
  switch (outcome) {
  case StabilityOutcome::Right:
  case StabilityOutcome::Refused:
    return ReportTable::Mark::Good;
  case StabilityOutcome::Stopped:
  case StabilityOutcome::Warned:
    return ReportTable::Mark::Doubtful;
  case StabilityOutcome::Wrong:
    break;
  }
  return ReportTable::Mark::Bad;
}

ReportTable table(const std::vector<StabilityRow>& rows, const std::string& group) {
  ReportTable result{
      "", {"case", "outcome", "error", "against", "iterations", "condition", "seconds", "words"}, {}, {}};
  for (const StabilityRow& row : rows) {
    if (row.group != group) continue;
    result.rows.push_back({row.what, name(row.outcome), shortNumber(row.error), row.errorOf,
                           row.iterations < 0 ? "-" : std::to_string(row.iterations), shortNumber(row.condition),
                           shortNumber(row.seconds), row.words});
    result.marks.push_back(mark(row.outcome));
  }
  return result;
}

std::string csvOf(const std::vector<StabilityRow>& rows) {
  Csv csv({"group", "case", "outcome", "error", "against", "iterations", "condition", "seconds", "words"});
  for (const StabilityRow& row : rows)
    csv.add({row.group, row.what, name(row.outcome), row.error, row.errorOf, row.iterations, row.condition, row.seconds,
             row.words});
  return csv.text();
}

/// Error of a network against its spread, for both tails.
ReportChart spreadChart(const std::vector<StabilityRow>& rows) {
  ReportChart chart{
      "spread",
      "Error of networks over nine decades of spread, clean displacements; 28.9 % is always predicting the mean",
      "Networks and their spread",
      "spread (radbas)",
      "error [% of range]",
      true,
      true,
      {}};
  for (const char* group : {"network: spread, linear tail", "network: spread, bias only"}) {
    ReportCurve curve{.name = std::string(group).substr(17)};
    for (const StabilityRow& row : rows)
      if (row.group == group) {
        curve.x.push_back(numberIn(row.what.substr(7)).value());
        curve.y.push_back(row.error);
      }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

std::string summary(const std::vector<StabilityRow>& rows) {
  const auto count = [&](StabilityOutcome outcome) {
    return std::to_string(std::count_if(rows.begin(), rows.end(), [&](const auto& r) { return r.outcome == outcome; }));
  };
  return std::to_string(rows.size()) + " extreme cases: " + count(StabilityOutcome::Right) + " right, " +
         count(StabilityOutcome::Stopped) + " stopped with a reason, " + count(StabilityOutcome::Warned) +
         " poor with a warning, " + count(StabilityOutcome::Refused) + " refused as input that cannot be, " +
         count(StabilityOutcome::Wrong) + " wrong.";
}

} // namespace

std::optional<ReportContent> stabilityReport(const ReportRequest& request, const ReportProgress& progress,
                                             std::stop_token stop) {
  requireValid(request.design);
  ReportContent content;
  content.title = "Stability: stiff and extreme cases";
  std::vector<StabilityRow> rows;
  StabilityCases cases(
      rows,
      [&](double, const std::string& what) {
        if (progress) progress(std::min(0.99, static_cast<double>(rows.size()) / kExpectedCases), what);
      },
      stop);
  addSolverCases(cases, request, content.stages);
  addContactCases(cases, request, content.stages);
  addResistanceCases(cases, request);
  addNetworkCases(cases, request, content.stages);
  if (stop.stop_requested()) return {};

  content.summary = summary(rows);
  content.parts.push_back(ReportWords{
      "Green: the result is right, or the input was refused with a message. Yellow: an incomplete or poor result that "
      "was reported (load fraction reached, rank, warning). Red: a wrong result, silently. Solver cases run on a "
      "coarse mapped mesh, because the mesh is not under test; their results are checked by an equilibrium computed "
      "independently from the stress formula, not by the solver's own residual. Those of the default mesh of "
      "tetrahedra are "
      "compared with hexahedra, an unrelated element: they agree to their discretisation "
      "errors."});
  std::vector<std::string> groups;
  for (const StabilityRow& row : rows)
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end()) groups.push_back(row.group);
  for (const std::string& group : groups) {
    content.parts.push_back(ReportHeading{group});
    content.parts.emplace_back(table(rows, group));
    if (group == "network: spread, bias only") content.parts.emplace_back(spreadChart(rows));
  }
  content.csv = csvOf(rows);
  return content;
}

} // namespace palp
