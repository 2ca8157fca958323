#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// A kind of report, without its pictures.
struct ReportComputation {
  std::string name; ///< as on the command line
  std::string what; ///< in a sentence
  /// Empty where it was stopped. Throws Error where the design cannot be.
  std::function<std::optional<ReportContent>(const ReportRequest&, const ReportProgress&, std::stop_token)> compute;
  std::vector<RunPart> parts;        ///< in the order in which they run
  bool underField = false;           ///< whether it supports the law of the field; the others refuse such a design
  std::vector<RunPart> fieldParts{}; ///< of a design of that law, where they are others
};

/// All of them, in the order of the command's help.
const std::vector<ReportComputation>& reportComputations();

/// Computes and writes; see writeReport. Where it was stopped the outcome is not done.
ReportOutcome runReport(const ReportComputation& kind, const ReportRequest& request, const ReportProgress& progress,
                        const std::stop_token& stop, const ReportDrawer& draw);

} // namespace palp
