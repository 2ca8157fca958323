#include "app/study/reports/layout/LayoutReport.h"

#include "app/study/reports/layout/FieldLayoutReport.h"
#include "app/study/reports/layout/LayoutTables.h"
#include "app/study/reports/layout/TouchLayoutReport.h"
#include "app/study/reports/networks/NetworkCheck.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "model/base/Error.h"

namespace palp {

namespace {

constexpr double kLayoutNoise = 1e-4; // of a resistance, relative
// Shares of the report's time: what the response takes, and where the confirmation begins.
constexpr double kResponse = 0.43, kConfirm = 0.46;

/// Writes the report part by part; one member function a section.
class LayoutWriter : LayoutReportWriter {
public:
  LayoutWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : LayoutReportWriter(request, std::move(progress), std::move(stop), "layout",
                           {"what", "layout", "row_wire", "area", "force", "at", "value"}) {}

  std::optional<ReportContent> run() {
    progress(0, "the block's response");
    const auto response = AreaResponse::solve(request_.design, request_.mesh, request_.threads, content_.stages,
                                              partOf(progress_, 0, kResponse), stop_);
    if (!response || !search(areaGoal(*response, row_, kLayoutNoise, request_.threads),
                             partOf(progress_, kResponse, 0.01), partOf(progress_, 0.44, 0.016)))
      return {};
    singularValues();
    bounds(*response);
    addLayouts({{"row", row_}});
    sweeps(*response);
    laws(*response);
    if (!confirm()) return {};
    commonSection("left out heading", "left out");
    summarise();
    return finished();
  }

private:
  void singularValues() {
    heading("singular heading", {{"row", row_}});
    ReportChart chart = words_.chart("singular", "singular chart", {{"row", row_}});
    chart.logY = true;
    ReportTable table = words_.table("singular table");
    for (const NamedLayout& layout : layouts_) {
      const Eigen::VectorXd values = resistanceSingularValues(layout.design, row_);
      ReportCurve curve{.name = layout.name};
      for (Eigen::Index i = 0; i < values.size(); ++i) {
        curve.x.push_back(static_cast<double>(i + 1));
        curve.y.push_back(values(i));
        csv_.add({"singular value", layout.name, row_, "", "", static_cast<int>(i + 1), values(i)});
      }
      table.add({layout.name, values(0), values(values.size() - 1), condition(values)});
      chart.curves.push_back(std::move(curve));
    }
    add(std::move(table));
    add(std::move(chart));
  }

  void bounds(const AreaResponse& response) {
    heading("bounds heading");
    paragraph("bounds", {{"range", range_N_}, {"meaning", common_("bounds")}});
    ReportTable table = words_.table("bounds table"), areas = words_.table("areas table", {{"row", row_}});
    for (int area = 0; area < request_.design.areas.count(); ++area)
      areas.heads.push_back("area " + std::to_string(area));
    for (const NamedLayout& layout : layouts_)
      for (const int row : {row_, -1}) {
        const LayoutBound bound = layoutBound(layout.design, response, row, kLayoutNoise);
        table.add({layout.name, rowsText(row), bound.withoutPrior(), bound.mean(), bound.withPrior()});
        addBound({layout.name, row}, bound);
        if (row < 0) continue;
        std::vector<std::string>& cells = areas.rows.emplace_back(1, layout.name);
        for (Eigen::Index area = 0; area < bound.withoutPrior_percent.cols(); ++area)
          cells.push_back(triple(bound.withoutPrior_percent.col(area)));
      }
    add(std::move(table));
    add(std::move(areas));
  }

  void sweeps(const AreaResponse& response) {
    progress(0.456, "depth and pitch");
    heading("sweeps heading");
    for (const LayoutSweep& sweep : layoutSweeps(request_.design, response, row_, kLayoutNoise, request_.threads)) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const LayoutSweep::Point& point : sweep.points)
          csv_.add({"sweep: " + sweep.title, "before", row_, "", kForceNames[axis], point.at,
                    point.withoutPrior_percent(static_cast<Eigen::Index>(axis))});
      addChart(sweep);
    }
  }

  void laws(const AreaResponse& response) {
    progress(0.458, "held and following electrodes, both laws of resistivity");
    heading("laws heading");
    const PressureLaw law = request_.design.pressureLaw.value_or(PressureLaw{});
    paragraph("laws", {{"p0", law.p0_MPa}, {"exponent", law.exponent}});
    ReportTable table = words_.table("laws table", {{"row", row_}});
    for (const NamedLayout& layout : layouts_)
      for (const bool follows : {false, true})
        for (const bool byPressure : {false, true}) {
          SensorDesign design = layout.design;
          design.lowerFollowsRubber = follows;
          design.pressureLaw = byPressure ? std::optional(law) : std::nullopt;
          const LayoutBound one = layoutBound(design, response, row_, kLayoutNoise);
          const LayoutBound all = layoutBound(design, response, -1, kLayoutNoise);
          table.add({layout.name, follows ? "follow the rubber" : "held", byPressure ? "by pressure" : "constant",
                     one.withoutPrior(), all.withoutPrior()});
          const std::string name =
              layout.name + (follows ? ", following" : ", held") + (byPressure ? ", by pressure" : ", constant");
          addBound({name, row_}, one);
          addBound({name, -1}, all);
        }
    add(std::move(table));
  }

  bool confirm() {
    heading("confirmed heading");
    ReportTable table = words_.table("confirmed table");
    for (std::size_t l = 0; l < layouts_.size(); ++l)
      if (!confirm(layouts_[l], l, table)) return false;
    paragraph("confirmed", {{"samples", request_.perArea}});
    add(std::move(table));
    return true;
  }

  /// A layout whose samples have no solution gets a row with the reason: the search is not lost with it.
  bool confirm(const NamedLayout& layout, std::size_t number, ReportTable& table) {
    try {
      return confirmBySamples(layout, number, table);
    } catch (const Error& refused) {
      table.add({layout.name, "all", std::string("failed: ") + refused.what(), "-", "-", "-"}, ReportTable::Mark::Bad);
      return true;
    }
  }

  /// A decoder by its name; `areaKnown`: one for each area.
  struct ConfirmingDecoder {
    std::string name;
    DecoderKind kind;
    bool areaKnown;
  };

  bool confirmBySamples(const NamedLayout& layout, std::size_t number, ReportTable& table) {
    // Two thirds of a layout's time are its samples'.
    const double each = (1 - kConfirm) / static_cast<double>(layouts_.size());
    double share = kConfirm + each * static_cast<double>(number);
    const auto sets = twoSets(
        layout.design, request_, content_.stages,
        [&](double part, const std::string& what) { progress(share + 0.67 * each * part, what + ", " + layout.name); },
        stop_);
    if (!sets) return false;
    const NoiseBound bound = noiseBound(sets->test, InputKind::Resistance, {row_}, kLayoutNoise);
    for (const ConfirmingDecoder& decoder : {ConfirmingDecoder{"rbf", DecoderKind::Rbf, false},
                                             {"rbf, one per area", DecoderKind::Rbf, true},
                                             {"ml", DecoderKind::MaximumLikelihood, false}}) {
      if (stop_.stop_requested()) return false;
      share += (decoder.kind == DecoderKind::Rbf && !decoder.areaKnown ? 0.67 : 0.11) * each;
      progress(share, decoder.name + ", " + layout.name);
      addDecoder(layout, *sets, decoder, bound, table);
    }
    return true;
  }

  void addDecoder(const NamedLayout& layout, const TwoSets& sets, const ConfirmingDecoder& decoder,
                  const NoiseBound& bound, ReportTable& table) {
    TrainOptions options;
    options.input = InputKind::Resistance;
    options.rows = std::to_string(row_);
    options.decoder = decoder.kind;
    options.noise = kLayoutNoise;
    options.seed = request_.seed;
    options.threads = request_.threads;
    const NoisyError error = (decoder.areaKnown ? noisyErrorAreaKnown : noisyError)(
        layout.design, sets, options, kLayoutNoise, request_.seed, content_.stages, stop_);
    if (!error.failed.empty()) {
      table.add({layout.name, decoder.name, "failed: " + error.failed, bound.withPriorPercent,
                 bound.withoutPriorPercent, "-"},
                ReportTable::Mark::Bad);
      return;
    }
    const double ratio = (error.rmse_percentOfRange.array() / bound.withPriorPercent.array()).maxCoeff();
    table.add({layout.name, decoder.name, error.rmse_percentOfRange, bound.withPriorPercent, bound.withoutPriorPercent,
               ratio},
              ratio <= 1.5 ? ReportTable::Mark::Good : ReportTable::Mark::Doubtful);
    csv_.addForces({{"confirmed error [%], " + decoder.name, error.rmse_percentOfRange},
                    {"confirmed bound with prior [%]", bound.withPriorPercent},
                    {"confirmed bound without prior [%]", bound.withoutPriorPercent}},
                   {layout.name, row_, ""}, {""});
    if (layout.name != "before")
      decoderSummary_ +=
          " " + words_("decoder summary", {{"decoder", decoder.name}, {"layout", layout.name}, {"ratio", ratio}});
  }

  void summarise() {
    content_.summary = words_("summary", {{"row", row_},
                                          {"before", scores_[0]},
                                          {"same", scores_[1]},
                                          {"same_gain", scores_[0] / scores_[1]},
                                          {"each", scores_[2]},
                                          {"each_gain", scores_[0] / scores_[2]}}) +
                       decoderSummary_;
  }

  std::string decoderSummary_;
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
