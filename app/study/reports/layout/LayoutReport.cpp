#include "app/study/reports/layout/LayoutReport.h"

#include "app/study/reports/BoundWords.h"
#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/layout/FieldLayoutReport.h"
#include "app/study/reports/layout/LayoutTables.h"
#include "app/study/reports/layout/TouchLayoutReport.h"
#include "app/study/reports/networks/NetworkCheck.h"
#include "io/DesignFile.h"
#include "model/base/Error.h"
#include "model/base/Text.h"

#include <array>

namespace palp {

namespace {

using Cells = std::vector<std::string>;
constexpr double kLayoutNoise = 1e-4; // of a resistance, relative
// Shares of the report's time: what the response takes, and where the confirmation begins.
constexpr double kResponse = 0.43, kConfirm = 0.46;
const char* const kForces[3] = {"Fx", "Fy", "Fz"};

/// Writes the report part by part; one member function a section.
class LayoutWriter {
public:
  LayoutWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), progress_(std::move(progress)), stop_(std::move(stop)),
        row_(centreRowWire(request.design.rowWires())) {
    content_.title = "Layout: what the electrodes' places resolve";
  }

  std::optional<ReportContent> run() {
    say(0, "the block's response");
    const auto response = AreaResponse::solve(
        request_.design, request_.mesh, request_.threads, content_.stages,
        [&](double share, const std::string& what) { say(kResponse * share, what); }, stop_);
    if (!response || !findLayouts(*response)) return {};
    singularValues();
    bounds(*response);
    places();
    sweeps(*response);
    laws(*response);
    if (!confirm()) return {};
    leftOut();
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
    say(kResponse, "search: the same places on every wire");
    const auto same = betterLayout(request_.design, areaGoal(response, row_, kLayoutNoise, request_.threads),
                                   LayoutFreedom::SameOnEveryWire, limits_, request_.seed, stop_);
    if (!same) return false;
    layouts_.push_back({"same on every wire", same->layout});
    say(0.44, "search: wire by wire");
    const auto each = betterLayout(same->layout, areaGoal(response, row_, kLayoutNoise, request_.threads),
                                   LayoutFreedom::WireByWire, limits_, request_.seed, stop_);
    if (!each) return false;
    layouts_.push_back({"wire by wire", each->layout});
    before_ = same->before;
    after_ = {same->after, each->after};
    evaluations_ = same->evaluations + each->evaluations;
    content_.files.push_back({"better-same.json", toJson(same->layout)});
    content_.files.push_back({"better-wires.json", toJson(each->layout)});
    return true;
  }

  void singularValues() {
    content_.parts.push_back(
        ReportHeading{"Can Eq. (1) be inverted? d ln R / d u of row-wire " + std::to_string(row_)});
    ReportChart chart{"singular",
                      "Singular values at rest: a value times a displacement in mm is the relative change of "
                      "resistance; what lies below the noise is lost",
                      "d ln R / d u, row-wire " + std::to_string(row_),
                      "place",
                      "singular value [1/mm]",
                      false,
                      true,
                      {}};
    ReportTable table{
        "Condition of d ln R / d u at rest", {"layout", "largest [1/mm]", "smallest [1/mm]", "condition"}, {}, {}};
    for (const NamedLayout& layout : layouts_) {
      const Eigen::VectorXd values = resistanceSingularValues(layout.design, row_);
      ReportCurve curve{.name = layout.name};
      for (Eigen::Index i = 0; i < values.size(); ++i) {
        curve.x.push_back(static_cast<double>(i + 1));
        curve.y.push_back(values(i));
        csv_.add({"singular value", layout.name, row_, "", "", static_cast<int>(i + 1), values(i)});
      }
      table.rows.push_back({layout.name, shortNumber(values(0)), shortNumber(values(values.size() - 1)),
                            shortNumber(condition(values))});
      chart.curves.push_back(std::move(curve));
    }
    content_.parts.emplace_back(std::move(table));
    content_.parts.emplace_back(std::move(chart));
  }

  void bounds(const AreaResponse& response) {
    content_.parts.push_back(ReportHeading{"What the noise allows, at relative noise 1e-4 on every resistance"});
    content_.parts.push_back(ReportWords{
        "Cramer-Rao bounds of the force with the area known, linearised in the middle of the force range, in % of the "
        "range (" +
        triple(request_.design.forceRange.high_N - request_.design.forceRange.low_N) + " N). " + kBoundsMean});
    ReportTable table{"Root mean square over the areas, Fx / Fy / Fz",
                      {"layout", "row-wires read", "without prior [%]", "geometric mean [%]", "with prior [%]"},
                      {},
                      {}};
    ReportTable areas{
        "Without prior by area, row-wire " + std::to_string(row_) + ", Fx / Fy / Fz [%]", {"layout"}, {}, {}};
    for (int area = 0; area < request_.design.areas.count(); ++area)
      areas.heads.push_back("area " + std::to_string(area));
    for (const NamedLayout& layout : layouts_)
      for (const int row : {row_, -1}) {
        const LayoutBound bound = layoutBound(layout.design, response, row, kLayoutNoise);
        table.rows.push_back({layout.name, row < 0 ? "all" : std::to_string(row), triple(bound.withoutPrior()),
                              shortNumber(bound.mean()), triple(bound.withPrior())});
        addBound(layout.name, row, bound);
        if (row < 0) continue;
        Cells cells{layout.name};
        for (Eigen::Index area = 0; area < bound.withoutPrior_percent.cols(); ++area)
          cells.push_back(triple(bound.withoutPrior_percent.col(area)));
        areas.rows.push_back(std::move(cells));
      }
    content_.parts.emplace_back(std::move(table));
    content_.parts.emplace_back(std::move(areas));
  }

  void addBound(const std::string& layout, int row, const LayoutBound& bound) {
    for (Eigen::Index area = 0; area < bound.withPrior_percent.cols(); ++area)
      for (int axis = 0; axis < 3; ++axis) {
        csv_.add({"bound without prior [%]", layout, row, static_cast<int>(area), kForces[axis], "",
                  bound.withoutPrior_percent(axis, area)});
        csv_.add({"bound with prior [%]", layout, row, static_cast<int>(area), kForces[axis], "",
                  bound.withPrior_percent(axis, area)});
      }
  }

  void places() {
    content_.parts.push_back(ReportHeading{"The better layouts"});
    content_.parts.push_back(
        ReportWords{"Found by pattern search on the geometric mean of the three bounds without prior of row-wire " +
                    std::to_string(row_) + " (" + std::to_string(evaluations_) + " layouts judged, seed " +
                    std::to_string(request_.seed) + "), within what a maker can keep: " + inWords(limits_) +
                    ". The designs are better-same.json and better-wires.json."});
    content_.parts.emplace_back(placesTable(layouts_));
  }

  void sweeps(const AreaResponse& response) {
    say(0.456, "depth and pitch");
    content_.parts.push_back(ReportHeading{"Effect of each layer's depth and pitch, one at a time"});
    for (const LayoutSweep& sweep : layoutSweeps(request_.design, response, row_, kLayoutNoise, request_.threads)) {
      for (int axis = 0; axis < 3; ++axis)
        for (const LayoutSweep::Point& point : sweep.points)
          csv_.add(
              {"sweep: " + sweep.title, "before", row_, "", kForces[axis], point.at, point.withoutPrior_percent(axis)});
      content_.parts.emplace_back(sweepChart(sweep));
    }
  }

  void laws(const AreaResponse& response) {
    say(0.458, "held and following electrodes, both laws of resistivity");
    content_.parts.push_back(
        ReportHeading{"Lower electrodes held or following, resistivity constant or by Fig. 1's law"});
    const PressureLaw law = request_.design.pressureLaw.value_or(PressureLaw{});
    content_.parts.push_back(ReportWords{"The paper holds the lower electrodes still and its resistivity constant. "
                                         "Real ones follow the rubber; Fig. 1's "
                                         "law g(p) = g0 (1 + max(p,0)/p0)^(-n) is taken with p0 = " +
                                         text(law.p0_MPa) + " MPa and n = " + text(law.exponent) +
                                         ", which are assumed: the figure's numbers are not in the text."});
    ReportTable table{
        "Bound without prior, root mean square over the areas, Fx / Fy / Fz [%]",
        {"layout", "lower electrodes", "resistivity", "row-wire " + std::to_string(row_), "all row-wires"},
        {},
        {}};
    for (const NamedLayout& layout : layouts_)
      for (const bool follows : {false, true})
        for (const bool byPressure : {false, true}) {
          SensorDesign design = layout.design;
          design.lowerFollowsRubber = follows;
          design.pressureLaw = byPressure ? std::optional(law) : std::nullopt;
          const LayoutBound one = layoutBound(design, response, row_, kLayoutNoise);
          const LayoutBound all = layoutBound(design, response, -1, kLayoutNoise);
          table.rows.push_back({layout.name, follows ? "follow the rubber" : "held",
                                byPressure ? "by pressure" : "constant", triple(one.withoutPrior()),
                                triple(all.withoutPrior())});
          const std::string name =
              layout.name + (follows ? ", following" : ", held") + (byPressure ? ", by pressure" : ", constant");
          addBound(name, row_, one);
          addBound(name, -1, all);
        }
    content_.parts.emplace_back(std::move(table));
  }

  bool confirm() {
    content_.parts.push_back(ReportHeading{"Confirmed by full nonlinear samples"});
    ReportTable table{
        "Error of decoders in % of range at relative noise 1e-4, Fx / Fy / Fz; 'over the bound' is the largest ratio "
        "to the bound with prior of the same samples",
        {"layout", "decoder", "error [%]", "bound with prior [%]", "bound without prior [%]", "over the bound"},
        {},
        {}};
    for (std::size_t l = 0; l < layouts_.size(); ++l) {
      if (!confirm(layouts_[l], l, table)) return false;
    }
    content_.parts.push_back(
        ReportWords{std::to_string(request_.perArea) +
                    " training forces and as many others for testing on each area, solved again on "
                    "the layout's own mesh; the decoders are not given the area, while the "
                    "bounds know it. A row is green up to 1.5 "
                    "times the bound with prior."});
    content_.parts.emplace_back(std::move(table));
    return true;
  }

  /// A layout whose samples have no solution is a row that says so: the search is not lost with it.
  bool confirm(const NamedLayout& layout, std::size_t number, ReportTable& table) {
    try {
      return confirmBySamples(layout, number, table);
    } catch (const Error& refused) {
      table.rows.push_back({layout.name, "all", std::string("failed: ") + refused.what(), "-", "-", "-"});
      table.marks.push_back(ReportTable::Mark::Bad);
      return true;
    }
  }

  bool confirmBySamples(const NamedLayout& layout, std::size_t number, ReportTable& table) {
    // Two thirds of a layout's time are its samples'.
    const double each = (1 - kConfirm) / static_cast<double>(layouts_.size());
    double share = kConfirm + each * static_cast<double>(number);
    const auto sets = twoSets(
        layout.design, request_, content_.stages,
        [&](double part, const std::string& what) { say(share + 0.67 * each * part, what + ", " + layout.name); },
        stop_);
    if (!sets) return false;
    const NoiseBound bound = noiseBound(sets->test, InputKind::Resistance, {row_}, kLayoutNoise);
    for (const Baseline& baseline :
         {Baseline{"rbf", DecoderKind::Rbf, false}, Baseline{"rbf, one per area", DecoderKind::Rbf, true},
          Baseline{"ml", DecoderKind::MaximumLikelihood, false}}) {
      if (stop_.stop_requested()) return false;
      share += (baseline.kind == DecoderKind::Rbf && !baseline.areaKnown ? 0.67 : 0.11) * each;
      say(share, baseline.name + ", " + layout.name);
      addBaseline(layout, *sets, baseline, bound, table);
    }
    return true;
  }

  /// A way to decode; `areaKnown`: a decoder for each area.
  struct Baseline {
    std::string name;
    DecoderKind kind;
    bool areaKnown;
  };

  void addBaseline(const NamedLayout& layout, const TwoSets& sets, const Baseline& baseline, const NoiseBound& bound,
                   ReportTable& table) {
    TrainOptions options;
    options.input = InputKind::Resistance;
    options.rows = std::to_string(row_);
    options.decoder = baseline.kind;
    options.noise = kLayoutNoise;
    options.seed = request_.seed;
    options.threads = request_.threads;
    const NoisyError error = (baseline.areaKnown ? noisyErrorAreaKnown : noisyError)(
        layout.design, sets, options, kLayoutNoise, request_.seed, content_.stages, stop_);
    Cells cells{layout.name, baseline.name};
    if (!error.failed.empty()) {
      cells.insert(cells.end(),
                   {"failed: " + error.failed, triple(bound.withPriorPercent), triple(bound.withoutPriorPercent), "-"});
      table.rows.push_back(std::move(cells));
      table.marks.push_back(ReportTable::Mark::Bad);
      return;
    }
    const double ratio = (error.rmse_percentOfRange.array() / bound.withPriorPercent.array()).maxCoeff();
    cells.insert(cells.end(), {triple(error.rmse_percentOfRange), triple(bound.withPriorPercent),
                               triple(bound.withoutPriorPercent), shortNumber(ratio)});
    table.rows.push_back(std::move(cells));
    table.marks.push_back(ratio <= 1.5 ? ReportTable::Mark::Good : ReportTable::Mark::Doubtful);
    for (int axis = 0; axis < 3; ++axis) {
      csv_.add({"confirmed error [%], " + baseline.name, layout.name, row_, "", kForces[axis], "",
                error.rmse_percentOfRange(axis)});
      csv_.add(
          {"confirmed bound with prior [%]", layout.name, row_, "", kForces[axis], "", bound.withPriorPercent(axis)});
      csv_.add({"confirmed bound without prior [%]", layout.name, row_, "", kForces[axis], "",
                bound.withoutPriorPercent(axis)});
    }
    ratios_.push_back({layout.name, baseline.name, ratio});
  }

  void leftOut() {
    content_.parts.push_back(ReportHeading{"What the model leaves out"});
    content_.parts.push_back(ReportWords{kLeftOut});
  }

  void summarise() {
    content_.summary = "Bound without prior of row-wire " + std::to_string(row_) +
                       " at noise 1e-4, geometric mean of the forces: " + shortNumber(before_) +
                       " % of range before, " + shortNumber(after_[0]) + " % with the same places on every wire (" +
                       shortNumber(before_ / after_[0]) + " times better), " + shortNumber(after_[1]) +
                       " % wire by wire (" + shortNumber(before_ / after_[1]) + " times better).";
    for (const Ratio& ratio : ratios_)
      if (ratio.layout != "before")
        content_.summary += " Decoder " + ratio.decoder + ", " + ratio.layout + ": " + shortNumber(ratio.value) +
                            " times the bound with prior.";
  }

  struct Ratio {
    std::string layout, decoder;
    double value;
  };

  const ReportRequest& request_;
  ReportProgress progress_;
  std::stop_token stop_;
  int row_;
  MakerLimits limits_;
  ReportContent content_;
  Csv csv_{{"what", "layout", "row_wire", "area", "force", "at", "value"}};
  std::vector<NamedLayout> layouts_;
  std::vector<Ratio> ratios_;
  double before_ = 0;
  std::array<double, 2> after_{};
  int evaluations_ = 0;
};

} // namespace

std::optional<ReportContent> layoutReport(const ReportRequest& request, const ReportProgress& progress,
                                          std::stop_token stop) {
  requireValid(request.design);
  if (request.touches) return touchLayoutReport(request, progress, std::move(stop));
  if (request.design.field()) return fieldLayoutReport(request, progress, std::move(stop));
  return LayoutWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
