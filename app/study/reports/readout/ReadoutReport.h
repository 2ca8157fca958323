#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// What the circuit decides: the design under each read-out of the field, with other radii, contacts and switches and
/// with noise of reading and of full scale; in sentences for the circuit designer. A design by Eq. (1) is taken under
/// the usual field law.
std::optional<ReportContent> readoutReport(const ReportRequest& request, const ReportProgress& progress,
                                           std::stop_token stop);

} // namespace palp
