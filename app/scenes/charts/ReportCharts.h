#pragma once

#include "app/study/reports/Report.h"

namespace palp {

/// Draws a report's chart as a PNG file. Throws Error where it cannot be written.
void drawReportChart(const ReportChart& chart, const std::filesystem::path& png);

} // namespace palp
