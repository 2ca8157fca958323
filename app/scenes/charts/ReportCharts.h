#pragma once

#include "app/study/reports/Report.h"

namespace palp {

/// Draws a report's chart as a PNG file. Throws Error where it cannot be written.
void drawReport(const ReportChart& chart, const std::filesystem::path& png);
/// The same of a map.
void drawReport(const ReportMap& map, const std::filesystem::path& png);

} // namespace palp
