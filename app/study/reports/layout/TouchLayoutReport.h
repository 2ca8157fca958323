#pragma once

#include "app/study/reports/Report.h"

namespace palp {

/// Better layouts for touches: the place that the map of the present layout resolves worst is to be resolved better.
/// By the law of the design. Empty where it was stopped. Throws DesignError where no map can be made.
std::optional<ReportContent> touchLayoutReport(const ReportRequest& request, const ReportProgress& progress,
                                               std::stop_token stop);

} // namespace palp
