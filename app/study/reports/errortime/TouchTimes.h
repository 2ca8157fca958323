#pragma once

#include "app/study/reports/Csv.h"
#include "app/study/reports/Report.h"

#include <stop_token>

namespace palp {

/// Adds a section on touches to the report: a sphere with and without friction, pressed by its way, on meshes of
/// several sizes. Error of its force and of the electrodes against wall time, with CalculiX where it is installed.
/// `quick`: coarse meshes, once, the touch without friction alone. False where it was stopped.
bool addTouchTimes(const ReportRequest& request, bool quick, const ReportProgress& progress,
                   const std::stop_token& stop, ReportContent& content, Csv& csv);

} // namespace palp
