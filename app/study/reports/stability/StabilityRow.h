#pragma once

#include "app/study/reports/Report.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace palp {

/// How an extreme case came out.
enum class StabilityOutcome {
  Right,   ///< a result, and the check of it passed
  Stopped, ///< no full result, and the reason was reported
  Warned,  ///< a poor result with a warning
  Refused, ///< input that cannot be, refused with a sentence
  Wrong,   ///< a result whose check failed, silently
};

/// An extreme case; what does not apply is NaN.
struct StabilityRow {
  std::string group;
  std::string what;
  double error = std::numeric_limits<double>::quiet_NaN();
  std::string errorOf; ///< what the error is measured against
  int iterations = -1; ///< -1: none
  double condition = std::numeric_limits<double>::quiet_NaN();
  double seconds = 0;
  StabilityOutcome outcome = StabilityOutcome::Right;
  std::string words; ///< why it is not plainly right
};

/// Right, stopped, ... as in the CSV.
std::string name(StabilityOutcome outcome);

/// Right where the error is at most `allowed`, else wrong with a sentence on the error.
void judge(StabilityRow& row, double allowed);

/// Runs a case with a clock; a refusal becomes the outcome.
StabilityRow runCase(const std::string& group, const std::string& what, const std::function<void(StabilityRow&)>& work);

/// Rows with a way to stop between the cases.
class StabilityCases {
public:
  StabilityCases(std::vector<StabilityRow>& rows, ReportProgress progress, std::stop_token stop)
      : rows_(rows), progress_(std::move(progress)), stop_(std::move(stop)) {}

  void add(const std::string& group, const std::string& what, const std::function<void(StabilityRow&)>& work) {
    if (stop_.stop_requested()) return;
    if (progress_) progress_(0, group + ": " + what);
    rows_.push_back(runCase(group, what, work));
  }
  /// A case that has run.
  void add(StabilityRow row) { rows_.push_back(std::move(row)); }
  [[nodiscard]] const std::stop_token& stop() const { return stop_; }

private:
  std::vector<StabilityRow>& rows_;
  ReportProgress progress_;
  std::stop_token stop_;
};

void addSolverCases(StabilityCases& cases, const ReportRequest& request, StageLog& stages);
void addContactCases(StabilityCases& cases, const ReportRequest& request, StageLog& stages);
void addNetworkCases(StabilityCases& cases, const ReportRequest& request, StageLog& stages);
void addResistanceCases(StabilityCases& cases, const ReportRequest& request);

} // namespace palp
