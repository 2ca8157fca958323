#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// What each scene costs: stages run, seconds and memory on opening, on a change of load, material or layout, and while
/// hidden; a stage that ran although the scene does not show it is a fault. Returns nullopt if cancelled.
std::optional<ReportContent> scenesReport(const ReportRequest& request, const ReportProgress& progress,
                                          std::stop_token stop);

} // namespace palp
