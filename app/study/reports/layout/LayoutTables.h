#pragma once

#include "app/study/reports/Report.h"
#include "app/study/reports/layout/LayoutSearch.h"
#include "app/study/reports/layout/LayoutSweeps.h"

#include <string>
#include <vector>

namespace palp {

/// A layout that a report speaks of.
struct NamedLayout {
  std::string name;
  SensorDesign design;
};

/// Depths and places of each; column-wires that are alike share a line.
ReportTable placesTable(const std::vector<NamedLayout>& layouts);

/// "straight wires that stay where they are along the block, ..."
std::string inWords(const MakerLimits& limits);

/// A curve for each force.
ReportChart sweepChart(const LayoutSweep& sweep);

} // namespace palp
