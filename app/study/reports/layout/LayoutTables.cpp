#include "app/study/reports/layout/LayoutTables.h"

#include "app/study/reports/networks/NoiseAxis.h"
#include "io/DesignFile.h"
#include "model/base/Text.h"

#include <map>

namespace palp {

namespace {

std::string positionsText(const SensorDesign& design, int wire) {
  std::string positions;
  for (int e = 0; e < design.electrodesPerColumnWire(); ++e)
    positions += (e > 0 ? ", " : "") + text(design.lower.along(wire, e));
  return positions;
}

} // namespace

bool LayoutReportWriter::search(const LayoutGoal& goal, const ReportProgress& sameOnEveryWire,
                                const ReportProgress& wireByWire) {
  layouts_.push_back({"before", request_.design});
  for (const LayoutFreedom freedom : {LayoutFreedom::SameOnEveryWire, LayoutFreedom::WireByWire}) {
    const bool same = freedom == LayoutFreedom::SameOnEveryWire;
    const auto found = betterLayout(layouts_.back().design, goal, freedom, limits_, request_.seed, stop_,
                                    same ? sameOnEveryWire : wireByWire);
    if (!found) return false;
    evaluations_ += found->evaluations;
    if (same) scores_.push_back(found->before);
    scores_.push_back(found->after);
    layouts_.push_back({same ? "same on every wire" : "wire by wire", found->layout});
    content_.files.push_back({same ? "better-same.json" : "better-wires.json", toJson(found->layout)});
  }
  return true;
}

void LayoutReportWriter::addLayouts(ReportText::Values values) {
  values["limits"] = common_("maker's limits", {{"grid", limits_.grid_mm},
                                                {"pitch", limits_.pitch_mm},
                                                {"clearance", limits_.clearance_mm},
                                                {"cover", limits_.cover_mm}});
  values["evaluations"] = evaluations_;
  values["seed"] = request_.seed;
  add(ReportHeading{common_("layouts heading")});
  paragraph("layouts", values);
  ReportTable table = common_.table("layouts table");
  for (const NamedLayout& layout : layouts_) {
    std::map<std::pair<double, std::string>, std::string> wires; // of each depth and positions
    for (int wire = 0; wire < layout.design.columnWires(); ++wire) {
      std::string& list = wires[{layout.design.lower.z(wire, 0), positionsText(layout.design, wire)}];
      list += (list.empty() ? "" : " ") + std::to_string(wire);
    }
    for (const auto& [positions, list] : wires)
      table.add({layout.name, text(layout.design.upper.z(0, 0)), wires.size() == 1 ? "all" : list,
                 text(positions.first), positions.second});
  }
  add(std::move(table));
}

void LayoutReportWriter::addChart(const LayoutSweep& sweep) {
  ReportChart chart{.file = sweep.file,
                    .caption = sweep.caption,
                    .title = sweep.title,
                    .xLabel = sweep.xLabel,
                    .yLabel = "bound without prior [% of range]",
                    .logY = true};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    ReportCurve curve{.name = kForceNames[static_cast<std::size_t>(axis)]};
    for (const LayoutSweep::Point& point : sweep.points) {
      curve.x.push_back(point.at);
      curve.y.push_back(point.withoutPrior_percent(axis));
    }
    chart.curves.push_back(std::move(curve));
  }
  add(std::move(chart));
}

void LayoutReportWriter::addBound(std::vector<CsvCell> cells, const LayoutBound& bound) {
  cells.emplace_back(0);
  for (Eigen::Index area = 0; area < bound.withPrior_percent.cols(); ++area) {
    cells.back() = static_cast<int>(area);
    csv_.addForces({{"bound without prior [%]", bound.withoutPrior_percent.col(area)},
                    {"bound with prior [%]", bound.withPrior_percent.col(area)}},
                   cells, {""});
  }
}

} // namespace palp
