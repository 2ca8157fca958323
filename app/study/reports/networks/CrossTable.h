#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// Decoders that were trained on the readings of one law and are used on those of another: Eq. (1), the read-outs of
/// the field, and electrodes of another radius, each as it is read and with every reading scaled to its resistance at
/// rest. For a design with the law of the field; throws DesignError where it has a pressure law.
std::optional<ReportContent> crossTableReport(const ReportRequest& request, const ReportProgress& progress,
                                              std::stop_token stop);

} // namespace palp
