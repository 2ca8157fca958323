#pragma once

#include "app/study/reports/Report.h"

namespace palp {

/// A report that can be run from the command line and from the Reports scene alike.
///
/// In a background job (no call touches the display; charts are drawn off screen):
///     ReportRequest request;
///     request.design = design;   // a copy: reports change nothing
///     request.folder = folder;   // made where it is missing; files in it are replaced
///     request.command = "palp report layout ...";
///     for (const ReportKind& kind : reportKinds())
///       if (kind.name == wanted) outcome = kind.run(request, progress, stop);
/// `progress` gets a share 0..1 and words, from the job's thread; a stop request ends the run soon, and then
/// `outcome.done` is false and nothing was written. Errors in what was asked throw Error. Afterwards open
/// `outcome.page` in a browser (one file, no network) and show `outcome.summary`.
struct ReportKind {
  std::string name; ///< as on the command line
  std::string what; ///< in a sentence
  std::function<ReportOutcome(const ReportRequest&, const ReportProgress&, std::stop_token)> run;
};

/// The paper's experiments (`reproduce`, always of the paper's design) first, then those of `palp report`.
const std::vector<ReportKind>& reportKinds();

/// Draws a report's chart as a PNG file.
void drawReportChart(const ReportChart& chart, const std::filesystem::path& png);

} // namespace palp
