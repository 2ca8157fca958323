#include "app/study/reports/layout/FieldLayoutReport.h"

#include "app/study/reports/BoundWords.h"
#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/LayoutTables.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "io/DesignFile.h"
#include "model/base/Text.h"

#include <array>

namespace palp {

namespace {

constexpr double kFiner = 0.75;    // size of the mesh that confirms, over that of the report's
constexpr double kFinerPanels = 2; // of its quadrature over the faces

class FieldLayoutWriter {
public:
  FieldLayoutWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), law_(*request.design.field()), progress_(std::move(progress)), stop_(std::move(stop)),
        row_(centreRowWire(request.design.rowWires())) {}

  std::optional<ReportContent> run() {
    content_.title = "Layout: what the electrodes' places resolve under the field";
    content_.warnings = designWarnings(request_.design);
    const auto response = AreaResponse::atRest(request_.design, request_.mesh, request_.threads, content_.stages,
                                               partOf(progress_, 0, 0.05), stop_);
    if (!response || !findLayouts(*response)) return {};
    bounds(*response);
    heldOrFollowing(*response);
    content_.parts.push_back(ReportHeading{"The better layouts"});
    content_.parts.push_back(ReportWords{
        "Found by pattern search on the geometric mean of the three bounds without prior of all row-wires, read by " +
        kReadouts.name(law_.readout) + " (" + std::to_string(evaluations_) + " layouts judged, seed " +
        std::to_string(request_.seed) + "), within what a maker can keep: " + inWords(limits_) +
        "; electrodes nowhere overlap, and keep as far apart as small spheres with dipoles are a good model for. The "
        "designs are better-same.json and better-wires.json."});
    content_.parts.emplace_back(placesTable(layouts_));
    sweeps(*response);
    if (!confirm(*response)) return {};
    content_.parts.push_back(ReportHeading{"Assumptions"});
    content_.parts.push_back(ReportWords{kFieldAssumed});
    summarise();
    content_.csv = csv_.text();
    return std::move(content_);
  }

private:
  void say(double share, const std::string& what) const {
    if (progress_) progress_(share, what);
  }

  bool findLayouts(const AreaResponse& response) {
    layouts_.push_back({"before", request_.design});
    const auto same =
        betterLayout(request_.design, areaGoal(response, -1, kShownNoise, request_.threads),
                     LayoutFreedom::SameOnEveryWire, limits_, request_.seed, stop_, partOf(progress_, 0.05, 0.4));
    if (!same) return false;
    layouts_.push_back({"same on every wire", same->layout});
    const auto each =
        betterLayout(same->layout, areaGoal(response, -1, kShownNoise, request_.threads), LayoutFreedom::WireByWire,
                     limits_, request_.seed, stop_, partOf(progress_, 0.45, 0.25));
    if (!each) return false;
    layouts_.push_back({"wire by wire", each->layout});
    evaluations_ = same->evaluations + each->evaluations;
    content_.files.push_back({"better-same.json", toJson(same->layout)});
    content_.files.push_back({"better-wires.json", toJson(each->layout)});
    return true;
  }

  void bounds(const AreaResponse& response) {
    content_.parts.push_back(ReportHeading{"What the noise allows, at relative noise " + text(kShownNoise)});
    content_.parts.push_back(
        ReportWords{"Cramer-Rao bounds of the force with the area known, linear at rest, in % of the range (" +
                    triple(request_.design.forceRange.high_N - request_.design.forceRange.low_N) + " N). " +
                    kBoundsMean + " The layouts were searched for the read-out of the design, " +
                    kReadouts.name(law_.readout) + "; the others are read of the same layouts."});
    ReportTable table{
        "Root mean square over the areas, Fx / Fy / Fz",
        {"layout", "read-out", "row-wires read", "without prior [%]", "geometric mean [%]", "with prior [%]"},
        {},
        {}};
    for (const NamedLayout& layout : layouts_) {
      const FieldResponse field(layout.design, law_, response, request_.threads, 1, stop_);
      for (const auto& [readout, name] : kReadouts.all())
        for (const int row : {row_, -1}) {
          const LayoutBound bound = field.bound(readout, row, kShownNoise);
          const std::string rows = row < 0 ? "all" : std::to_string(row);
          table.rows.push_back({layout.name, name, rows, triple(bound.withoutPrior()), shortNumber(bound.mean()),
                                triple(bound.withPrior())});
          table.marks.push_back(readout == law_.readout ? ReportTable::Mark::Good : ReportTable::Mark::Plain);
          addBound(layout.name, name, rows, bound);
          if (readout == law_.readout && row < 0) means_.push_back(bound.mean());
        }
    }
    content_.parts.emplace_back(std::move(table));
  }

  /// A layout that is found with lower electrodes held may owe its gain to that.
  void heldOrFollowing(const AreaResponse& response) {
    content_.parts.push_back(ReportHeading{"Lower electrodes fixed or following the rubber"});
    content_.parts.push_back(ReportWords{
        std::string("The layouts were searched with lower electrodes that ") +
        (request_.design.lowerFollowsRubber ? "follow the rubber" : "are fixed") +
        ", as in the design. Real electrodes follow the rubber, unless they are fixed to something stiff."});
    ReportTable table{"All row-wires, read by " + kReadouts.name(law_.readout) +
                          ": bound without prior, Fx / Fy / Fz and their geometric mean [% of range]",
                      {"layout", "lower electrodes", "Fx / Fy / Fz", "geometric mean"},
                      {},
                      {}};
    for (const NamedLayout& layout : layouts_)
      for (const bool follows : {false, true}) {
        SensorDesign design = layout.design;
        design.lowerFollowsRubber = follows;
        const LayoutBound bound = layoutBound(design, response, -1, kShownNoise, request_.threads, 1, stop_);
        table.rows.push_back({layout.name, follows ? "follow the rubber" : "held", triple(bound.withoutPrior()),
                              shortNumber(bound.mean())});
        addBound(layout.name + (follows ? ", following" : ", held"), kReadouts.name(law_.readout), "all", bound);
      }
    content_.parts.emplace_back(std::move(table));
  }

  void addBound(const std::string& layout, const std::string& readout, const std::string& rows,
                const LayoutBound& bound) {
    for (Eigen::Index area = 0; area < bound.withPrior_percent.cols(); ++area)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto force = static_cast<Eigen::Index>(axis);
        csv_.add({"bound without prior [%]", layout, readout, rows, static_cast<int>(area), kForceNames[axis], "",
                  bound.withoutPrior_percent(force, area)});
        csv_.add({"bound with prior [%]", layout, readout, rows, static_cast<int>(area), kForceNames[axis], "",
                  bound.withPrior_percent(force, area)});
      }
  }

  void sweeps(const AreaResponse& response) {
    content_.parts.push_back(ReportHeading{"Effect of each layer's depth and pitch, one at a time"});
    for (const LayoutSweep& sweep : layoutSweeps(request_.design, response, -1, kShownNoise, request_.threads,
                                                 partOf(progress_, 0.7, 0.2), stop_)) {
      for (const LayoutSweep::Point& point : sweep.points)
        for (std::size_t axis = 0; axis < 3; ++axis)
          csv_.add({"sweep: " + sweep.title, "before", kReadouts.name(law_.readout), "all", "", kForceNames[axis],
                    point.at, point.withoutPrior_percent(static_cast<Eigen::Index>(axis))});
      content_.parts.emplace_back(sweepChart(sweep));
    }
  }

  bool confirm(const AreaResponse& coarse) {
    MeshOptions mesh;
    const double size_mm =
        kFiner * (request_.mesh.meshSize_mm ? *request_.mesh.meshSize_mm : standardMeshSize_mm(request_.design));
    mesh.meshSize_mm = size_mm;
    mesh.electrodesAsNodes = false; // another mesh, not the same one refined at the electrodes
    const auto finer = AreaResponse::atRest(request_.design, mesh, request_.threads, content_.stages,
                                            partOf(progress_, 0.9, 0.07), stop_);
    if (!finer) return false;
    content_.parts.push_back(ReportHeading{"Again on a finer mesh"});
    content_.parts.push_back(
        ReportWords{"Displacements solved again on tetrahedra of " + shortNumber(size_mm) + " mm in the bulk (" +
                    std::to_string(finer->mesh().elementCount()) + " elements instead of " +
                    std::to_string(coarse.mesh().elementCount()) +
                    "), and panels of half the width on the faces. The field at rest needs no mesh."});
    ReportTable table{"All row-wires, read by " + kReadouts.name(law_.readout) + ": bound without prior [% of range]",
                      {"layout", "Fx / Fy / Fz", "geometric mean", "before over this", "changed by the mesh"},
                      {},
                      {}};
    for (std::size_t l = 0; l < layouts_.size(); ++l) {
      say(0.97 + 0.01 * static_cast<double>(l), "finer mesh, " + layouts_[l].name);
      const LayoutBound bound =
          layoutBound(layouts_[l].design, *finer, -1, kShownNoise, request_.threads, kFinerPanels, stop_);
      confirmed_.push_back(bound.mean());
      table.rows.push_back({layouts_[l].name, triple(bound.withoutPrior()), shortNumber(bound.mean()),
                            shortNumber(confirmed_.front() / bound.mean()),
                            shortNumber(100 * (bound.mean() / means_[l] - 1)) + " %"});
      for (std::size_t axis = 0; axis < 3; ++axis)
        csv_.add({"bound without prior on a finer mesh [%]", layouts_[l].name, kReadouts.name(law_.readout), "all", "",
                  kForceNames[axis], "", bound.withoutPrior()(static_cast<Eigen::Index>(axis))});
    }
    content_.parts.emplace_back(std::move(table));
    return true;
  }

  void summarise() {
    content_.summary = "Read by " + kReadouts.name(law_.readout) + " with noise " + text(kShownNoise) +
                       ", all row-wires, bound without prior, geometric mean of the forces: " + shortNumber(means_[0]) +
                       " % of range before, " + shortNumber(means_[1]) + " % with the same places on every wire (" +
                       shortNumber(means_[0] / means_[1]) + " times better, on a finer mesh " +
                       shortNumber(confirmed_[0] / confirmed_[1]) + "), " + shortNumber(means_[2]) +
                       " % wire by wire (" + shortNumber(means_[0] / means_[2]) + " times, on a finer mesh " +
                       shortNumber(confirmed_[0] / confirmed_[2]) + ").";
  }

  const ReportRequest& request_;
  const FieldLaw law_;
  ReportProgress progress_;
  std::stop_token stop_;
  int row_;
  MakerLimits limits_;
  ReportContent content_;
  Csv csv_{{"what", "layout", "readout", "rows", "area", "force", "at", "value"}};
  std::vector<NamedLayout> layouts_;
  std::vector<double> means_, confirmed_; ///< of all row-wires, a layout each
  int evaluations_ = 0;
};

} // namespace

std::optional<ReportContent> fieldLayoutReport(const ReportRequest& request, const ReportProgress& progress,
                                               std::stop_token stop) {
  requireSmoothAtRest(request.design);
  return FieldLayoutWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
