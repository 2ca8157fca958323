#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// Error against run time: the solver by mesh and element, networks, samples, and the complete chain from scratch to
/// the force; and what to use for an error wanted.
std::optional<ReportContent> errorTimeReport(const ReportRequest& request, const ReportProgress& progress,
                                             std::stop_token stop);

} // namespace palp
