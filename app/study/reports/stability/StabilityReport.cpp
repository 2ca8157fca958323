#include "app/study/reports/stability/StabilityReport.h"

#include "app/study/reports/ReportWriter.h"
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

class StabilityWriter : ReportWriter {
public:
  StabilityWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "stability",
                     {"group", "case", "outcome", "error", "against", "iterations", "condition", "seconds", "words"}) {}

  std::optional<ReportContent> run() {
    StabilityCases cases(
        rows_,
        [&](double, const std::string& what) {
          progress(std::min(0.99, static_cast<double>(rows_.size()) / kExpectedCases), what);
        },
        stop_);
    addSolverCases(cases, request_, content_.stages);
    addContactCases(cases, request_, content_.stages);
    addResistanceCases(cases, request_);
    addNetworkCases(cases, request_, content_.stages);
    if (stop_.stop_requested()) return {};
    paragraph("method");
    std::vector<std::string> groups;
    for (const StabilityRow& row : rows_)
      if (std::find(groups.begin(), groups.end(), row.group) == groups.end()) groups.push_back(row.group);
    for (const std::string& group : groups) addGroup(group);
    for (const StabilityRow& row : rows_)
      csv_.add({row.group, row.what, name(row.outcome), row.error, row.errorOf, row.iterations, row.condition,
                row.seconds, row.words});
    summarise();
    return finished();
  }

private:
  void addGroup(const std::string& group) {
    add(ReportHeading{group});
    ReportTable table = words_.table("cases table", {{"group", group}});
    for (const StabilityRow& row : rows_)
      if (row.group == group)
        table.add({row.what, name(row.outcome), row.error, row.errorOf,
                   row.iterations < 0 ? "-" : std::to_string(row.iterations), row.condition, row.seconds, row.words},
                  mark(row.outcome));
    add(std::move(table));
    if (group == "network: spread, bias only") addSpreadChart();
  }

  /// Error of a network against its spread, for both tails.
  void addSpreadChart() {
    ReportChart chart = words_.chart("spread", "spread chart");
    chart.logX = chart.logY = true;
    for (const std::string tail : {"linear tail", "bias only"}) {
      ReportCurve curve{.name = tail};
      for (const StabilityRow& row : rows_)
        if (row.group == "network: spread, " + tail) {
          curve.x.push_back(numberIn(row.what.substr(7)).value());
          curve.y.push_back(row.error);
        }
      chart.curves.push_back(std::move(curve));
    }
    add(std::move(chart));
  }

  void summarise() {
    const auto count = [&](StabilityOutcome outcome) {
      return std::count_if(rows_.begin(), rows_.end(), [&](const auto& r) { return r.outcome == outcome; });
    };
    content_.summary = words_("summary", {{"cases", rows_.size()},
                                          {"right", count(StabilityOutcome::Right)},
                                          {"stopped", count(StabilityOutcome::Stopped)},
                                          {"warned", count(StabilityOutcome::Warned)},
                                          {"refused", count(StabilityOutcome::Refused)},
                                          {"wrong", count(StabilityOutcome::Wrong)}});
  }

  std::vector<StabilityRow> rows_;
};

} // namespace

std::optional<ReportContent> stabilityReport(const ReportRequest& request, const ReportProgress& progress,
                                             std::stop_token stop) {
  requireValid(request.design);
  return StabilityWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
