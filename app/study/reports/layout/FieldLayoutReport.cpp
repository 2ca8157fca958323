#include "app/study/reports/layout/FieldLayoutReport.h"

#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/LayoutTables.h"
#include "app/study/reports/networks/NoiseAxis.h"

namespace palp {

namespace {

constexpr double kFiner = 0.75;    // size of the mesh that confirms, over that of the report's
constexpr double kFinerPanels = 2; // of its quadrature over the faces

class FieldLayoutWriter : LayoutReportWriter {
public:
  FieldLayoutWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : LayoutReportWriter(request, std::move(progress), std::move(stop), "layout-field",
                           {"what", "layout", "readout", "rows", "area", "force", "at", "value"}),
        law_(*request.design.field()) {}

  std::optional<ReportContent> run() {
    content_.warnings = designWarnings(request_.design);
    const auto response = AreaResponse::atRest(request_.design, request_.mesh, request_.threads, content_.stages,
                                               partOf(progress_, 0, 0.05), stop_);
    if (!response || !search(areaGoal(*response, -1, kShownNoise, request_.threads), partOf(progress_, 0.05, 0.4),
                             partOf(progress_, 0.45, 0.25)))
      return {};
    bounds(*response);
    heldOrFollowing(*response);
    addLayouts({{"readout", readout_}});
    sweeps(*response);
    if (!confirm(*response)) return {};
    commonSection("assumptions heading", "field");
    summarise();
    return finished();
  }

private:
  void bounds(const AreaResponse& response) {
    heading("bounds heading", {{"noise", kShownNoise}});
    paragraph("bounds", {{"range", range_N_}, {"meaning", common_("bounds")}, {"readout", readout_}});
    ReportTable table = words_.table("bounds table");
    for (const NamedLayout& layout : layouts_) {
      const FieldResponse field(layout.design, law_, response, request_.threads, 1, stop_);
      for (const auto& [readout, name] : kReadouts.all())
        for (const int row : {row_, -1}) {
          const LayoutBound bound = field.bound(readout, row, kShownNoise);
          table.add({layout.name, name, rowsText(row), bound.withoutPrior(), bound.mean(), bound.withPrior()},
                    readout == law_.readout ? ReportTable::Mark::Good : ReportTable::Mark::Plain);
          addBound({layout.name, name, rowsText(row)}, bound);
          if (readout == law_.readout && row < 0) means_.push_back(bound.mean());
        }
    }
    add(std::move(table));
  }

  /// A layout that is found with lower electrodes held may owe its gain to that.
  void heldOrFollowing(const AreaResponse& response) {
    heading("lower heading");
    paragraph("lower", {{"lower", request_.design.lowerFollowsRubber ? "follow the rubber" : "are fixed"}});
    ReportTable table = words_.table("lower table", {{"readout", readout_}});
    for (const NamedLayout& layout : layouts_)
      for (const bool follows : {false, true}) {
        SensorDesign design = layout.design;
        design.lowerFollowsRubber = follows;
        const LayoutBound bound = layoutBound(design, response, -1, kShownNoise, request_.threads, 1, stop_);
        table.add({layout.name, follows ? "follow the rubber" : "held", bound.withoutPrior(), bound.mean()});
        addBound({layout.name + (follows ? ", following" : ", held"), readout_, "all"}, bound);
      }
    add(std::move(table));
  }

  void sweeps(const AreaResponse& response) {
    heading("sweeps heading");
    for (const LayoutSweep& sweep : layoutSweeps(request_.design, response, -1, kShownNoise, request_.threads,
                                                 partOf(progress_, 0.7, 0.2), stop_)) {
      for (const LayoutSweep::Point& point : sweep.points)
        csv_.addForces({{"sweep: " + sweep.title, point.withoutPrior_percent}}, {"before", readout_, "all", ""},
                       {point.at});
      addChart(sweep);
    }
  }

  bool confirm(const AreaResponse& coarse) {
    MeshOptions mesh;
    const double size_mm = kFiner * request_.mesh.meshSize_mm.value_or(standardMeshSize_mm(request_.design));
    mesh.meshSize_mm = size_mm;
    mesh.electrodesAsNodes = false; // another mesh, not the same one refined at the electrodes
    const auto finer = AreaResponse::atRest(request_.design, mesh, request_.threads, content_.stages,
                                            partOf(progress_, 0.9, 0.07), stop_);
    if (!finer) return false;
    heading("finer heading");
    paragraph(
        "finer",
        {{"size", size_mm}, {"elements", finer->mesh().elementCount()}, {"before", coarse.mesh().elementCount()}});
    ReportTable table = words_.table("finer table", {{"readout", readout_}});
    for (std::size_t l = 0; l < layouts_.size(); ++l) {
      progress(0.97 + 0.01 * static_cast<double>(l), "finer mesh, " + layouts_[l].name);
      const LayoutBound bound =
          layoutBound(layouts_[l].design, *finer, -1, kShownNoise, request_.threads, kFinerPanels, stop_);
      confirmed_.push_back(bound.mean());
      table.add({layouts_[l].name, bound.withoutPrior(), bound.mean(), confirmed_.front() / bound.mean(),
                 shortNumber(100 * (bound.mean() / means_[l] - 1)) + " %"});
      csv_.addForces({{"bound without prior on a finer mesh [%]", bound.withoutPrior()}},
                     {layouts_[l].name, readout_, "all", ""}, {""});
    }
    add(std::move(table));
    return true;
  }

  void summarise() {
    content_.summary = words_("summary", {{"readout", readout_},
                                          {"noise", kShownNoise},
                                          {"before", means_[0]},
                                          {"same", means_[1]},
                                          {"same_gain", means_[0] / means_[1]},
                                          {"same_finer", confirmed_[0] / confirmed_[1]},
                                          {"each", means_[2]},
                                          {"each_gain", means_[0] / means_[2]},
                                          {"each_finer", confirmed_[0] / confirmed_[2]}});
  }

  const FieldLaw law_;
  const std::string readout_ = kReadouts.name(law_.readout);
  std::vector<double> means_, confirmed_; ///< of all row-wires, for each layout
};

} // namespace

std::optional<ReportContent> fieldLayoutReport(const ReportRequest& request, const ReportProgress& progress,
                                               std::stop_token stop) {
  requireSmoothAtRest(request.design);
  return FieldLayoutWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
