#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// Requirements on the networks, each line measured on fresh forces and all areas: errors at the paper's spreads, the
/// spread chosen by leave-one-out, noise against its bounds, all areas together, and standard deviations. Under the law
/// of the field: the cross table of the laws.
std::optional<ReportContent> networksReport(const ReportRequest& request, const ReportProgress& progress,
                                            std::stop_token stop);

} // namespace palp
