#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// What the design resolves of a touch at each place of its top face, for three sizes of an indenter: the smallest
/// force, the place, and two touches apart. By the design's own law and read-out.
std::optional<ReportContent> mapReport(const ReportRequest& request, const ReportProgress& progress,
                                       std::stop_token stop);

} // namespace palp
