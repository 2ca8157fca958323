#pragma once

#include "app/study/reports/ReportWriter.h"
#include "app/study/reports/layout/LayoutSearch.h"
#include "app/study/reports/layout/LayoutSweeps.h"

#include <string>
#include <vector>

namespace palp {

/// A layout that a report compares.
struct NamedLayout {
  std::string name;
  SensorDesign design;
};

/// What the reports on layouts share: the search for better ones, their table, and sweeps.
class LayoutReportWriter : protected ReportWriter {
protected:
  using ReportWriter::ReportWriter;

  /// Finds a better layout with the same positions on every wire, from it one wire by wire, and adds both to the
  /// report's files. Returns false if cancelled.
  bool search(const LayoutGoal& goal, const ReportProgress& sameOnEveryWire, const ReportProgress& wireByWire);
  /// Heading, the report's text of the layouts, which has `values` too, and the table of depths and positions.
  void addLayouts(ReportText::Values values);
  /// A chart with a curve for each force.
  void addChart(const LayoutSweep& sweep);
  /// Lines of the CSV with the bounds of each area; `cells` come before the area.
  void addBound(std::vector<CsvCell> cells, const LayoutBound& bound);

  MakerLimits limits_;
  std::vector<NamedLayout> layouts_; ///< before, same on every wire, wire by wire
  std::vector<double> scores_;       ///< of the layouts, as the goal has them
  int evaluations_ = 0;
};

} // namespace palp
