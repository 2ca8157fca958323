#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// What a design under the field can resolve by each read-out, at rest: signals compared with those of Eq. (1),
/// Cramer-Rao bounds over the noise, and what that means in bits of a converter and in newtons.
std::optional<ReportContent> fieldNoiseReport(const ReportRequest& request, const ReportProgress& progress,
                                              std::stop_token stop);

} // namespace palp
