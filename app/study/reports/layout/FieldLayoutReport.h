#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// The layout report of a design with the law of the field: bounds at rest by read-out, a better layout that a maker
/// can keep, and both again on a finer mesh.
std::optional<ReportContent> fieldLayoutReport(const ReportRequest& request, const ReportProgress& progress,
                                               std::stop_token stop);

} // namespace palp
