#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// Extreme cases of the solver, the networks and Eq. (1): error, iterations, condition, time, and whether each came out
/// right, stopped or was refused honestly, or is wrong.
std::optional<ReportContent> stabilityReport(const ReportRequest& request, const ReportProgress& progress,
                                             std::stop_token stop);

} // namespace palp
