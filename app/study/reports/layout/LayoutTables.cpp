#include "app/study/reports/layout/LayoutTables.h"

#include "app/study/reports/networks/NoiseAxis.h"
#include "model/base/Text.h"

#include <map>

namespace palp {

namespace {

std::string placesText(const SensorDesign& design, int wire) {
  std::string words;
  for (int e = 0; e < design.electrodesPerColumnWire(); ++e)
    words += (e > 0 ? ", " : "") + text(design.lower.along(wire, e));
  return words;
}

} // namespace

ReportTable placesTable(const std::vector<NamedLayout>& layouts) {
  ReportTable table{"Depths and places [mm]; column-wires that are alike share a line",
                    {"layout", "row-wires z", "column-wires", "z", "y of its electrodes"},
                    {},
                    {}};
  for (const NamedLayout& layout : layouts) {
    std::map<std::pair<double, std::string>, std::string> wires; // of each depth and places
    for (int wire = 0; wire < layout.design.columnWires(); ++wire) {
      std::string& list = wires[{layout.design.lower.z(wire, 0), placesText(layout.design, wire)}];
      list += (list.empty() ? "" : " ") + std::to_string(wire);
    }
    for (const auto& [places, list] : wires)
      table.rows.push_back({layout.name, text(layout.design.upper.z(0, 0)), wires.size() == 1 ? "all" : list,
                            text(places.first), places.second});
  }
  return table;
}

std::string inWords(const MakerLimits& limits) {
  return "straight wires that stay where they are along the block, places on a grid of " + text(limits.grid_mm) +
         " mm, electrodes of a wire at least " + text(limits.pitch_mm) + " mm apart, layers at least " +
         text(limits.clearance_mm) + " mm apart, at least " + text(limits.cover_mm) + " mm of rubber outside";
}

ReportChart sweepChart(const LayoutSweep& sweep) {
  ReportChart chart{sweep.file, sweep.caption, sweep.title, sweep.xLabel, "bound without prior [% of range]",
                    false,      true,          {}};
  for (int axis = 0; axis < 3; ++axis) {
    ReportCurve curve{.name = kForceNames[static_cast<std::size_t>(axis)]};
    for (const LayoutSweep::Point& point : sweep.points) {
      curve.x.push_back(point.at);
      curve.y.push_back(point.withoutPrior_percent(axis));
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

} // namespace palp
