#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// Force error against resistance noise for row counts, decoders and training noise, between the two Cramer-Rao bounds;
/// what that means in bits of a converter and in newtons. Under the field: FieldNoiseReport.
std::optional<ReportContent> noiseReport(const ReportRequest& request, const ReportProgress& progress,
                                         std::stop_token stop);

} // namespace palp
