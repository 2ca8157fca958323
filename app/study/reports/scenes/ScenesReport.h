#pragma once

#include "app/study/reports/Report.h"

#include <optional>

namespace palp {

/// What each scene and each command costs: stages run, seconds, memory, pictures drawn, on opening, on a change of
/// load, material or layout, and when hidden; the proof that nothing is computed that is not shown. The window and the
/// commands are run as programs where the request says where they lie.
std::optional<ReportContent> scenesReport(const ReportRequest& request, const ReportProgress& progress,
                                          std::stop_token stop);

} // namespace palp
