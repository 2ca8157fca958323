#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// What the layout resolves (singular values, condition, bounds by force and area), what depth and pitch do to that,
/// and a better layout that a maker can keep, confirmed by nonlinear samples and networks.
std::optional<ReportContent> layoutReport(const ReportRequest& request, const ReportProgress& progress,
                                          std::stop_token stop);

} // namespace palp
