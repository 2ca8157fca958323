#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// What each scene computes on opening, on a change of load, material or layout, and when hidden: stages run, seconds,
/// memory; the proof that nothing is computed that is not shown.
std::optional<ReportContent> scenesReport(const ReportRequest& request, const ReportProgress& progress,
                                          std::stop_token stop);

} // namespace palp
