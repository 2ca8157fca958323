#include "app/study/reports/networks/NoiseReport.h"

#include "app/study/reports/ReportWriter.h"
#include "app/study/reports/networks/FieldNoiseReport.h"
#include "app/study/reports/networks/LawsSideBySide.h"
#include "app/study/reports/networks/NetworkCheck.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "model/base/Text.h"

#include <array>

namespace palp {

namespace {

constexpr int kFewestForBounds = 8; // samples on an area, for a linear fit in three forces
constexpr std::array kTrainingNoises{0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};

/// Row-wires that are read together.
struct RowChoice {
  std::string name;
  std::string option; ///< as of `palp train --rows`
  std::vector<int> rows;
};

/// A decoder and how it is trained.
struct TestedDecoder {
  std::string name;
  DecoderKind kind;
  bool trainedClean;
  bool areaKnown;
  int color; ///< the same in every chart, also where another one fails and has no curve
};

constexpr int kWithoutPriorColor = 5;
constexpr int kWithPriorColor = 6;

void addPoint(ReportCurve& curve, double noise, double percent) {
  if (percent > kDrawnUpTo_percent) return;
  curve.x.push_back(noise);
  curve.y.push_back(percent);
}

class NoiseWriter : ReportWriter {
public:
  NoiseWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "noise",
                     {"rows", "what", "relative_noise", "bits", "training_noise", "force", "error_percent_of_range",
                      "error_N"}) {}

  std::optional<ReportContent> run() {
    sets_ = twoSets(request_.design, request_, content_.stages, partOf(progress_, 0, 0.25), stop_);
    if (!sets_) return {};
    if (!bounded()) {
      const std::string why = words_("no bounds", {{"samples", request_.perArea}, {"needed", kFewestForBounds}});
      content_.warnings.push_back(why);
      content_.summary = words_("no bounds summary", {{"why", why}});
    }
    chooseRows();
    introduce();
    for (std::size_t i = 0; i < choices_.size(); ++i)
      if (!errorsOf(choices_[i], static_cast<double>(i) / static_cast<double>(choices_.size()))) return {};
    add(std::move(table_));
    if (!trainingNoise()) return {};
    if (bounded()) bits();
    if (!otherLaws()) return {};
    commonSection("left out heading", "left out");
    return finished();
  }

private:
  void chooseRows() {
    const int count = request_.design.rowWires();
    const int centre = centreRowWire(count);
    choices_.push_back({"row-wire " + std::to_string(centre), std::to_string(centre), {centre}});
    if (count >= 5) {
      const std::vector<int> three{count / 10, centre, count - 1 - count / 5};
      choices_.push_back({"three row-wires",
                          std::to_string(three[0]) + "," + std::to_string(three[1]) + "," + std::to_string(three[2]),
                          three});
    }
    if (count == 1) return;
    RowChoice all{"all " + std::to_string(count) + " row-wires", "all", {}};
    for (int row = 0; row < count; ++row) all.rows.push_back(row);
    choices_.push_back(std::move(all));
  }

  void introduce() {
    heading("errors heading");
    paragraph("errors", {{"samples", request_.perArea}, {"range", range_N_}, {"meaning", common_("bounds")}});
    table_ = words_.table("errors table", {{"noise", kShownNoise}});
  }

  void addErrors(const std::string& rows, const std::string& what, double noise, const CsvCell& trained,
                 const Eigen::Vector3d& percent) {
    for (int axis = 0; axis < 3; ++axis)
      csv_.add({rows, what, noise, bitsOfNoise(noise), trained, kForceNames[axis], percent(axis),
                percent(axis) / 100 * range_N_(axis)});
  }

  void point(const std::string& rows, const std::string& what, double noise, double trained,
             const Eigen::Vector3d& percent) {
    addErrors(rows, what, noise, trained, percent);
    if (noise == kShownNoise && trained == noise) table_.add({rows, what, percent});
  }

  /// Without prior and with it.
  std::array<ReportCurve, 2> boundsOf(const RowChoice& choice) {
    ReportCurve without{
        .name = "bound without prior", .style = ReportCurve::Style::Line, .dashed = true, .color = kWithoutPriorColor};
    ReportCurve with{
        .name = "bound with prior", .style = ReportCurve::Style::Line, .dashed = true, .color = kWithPriorColor};
    for (const double noise : kNoises) {
      const NoiseBound bound = noiseBound(sets_->test, InputKind::Resistance, choice.rows, noise);
      const Eigen::Vector3d loose = bound.withoutPriorPercent, tight = bound.withPriorPercent;
      addPoint(without, noise, rootMeanSquare(loose));
      addPoint(with, noise, rootMeanSquare(tight));
      point(choice.name, without.name, noise, noise, loose);
      point(choice.name, with.name, noise, noise, tight);
    }
    return {std::move(without), std::move(with)};
  }

  /// `done`: share of the choices before this one.
  bool errorsOf(const RowChoice& choice, double done) {
    ReportChart chart = words_.chart("noise_" + std::to_string(choice.rows.size()), "errors chart",
                                     {{"rows", choice.name}, {"percent", kDrawnUpTo_percent}});
    chart.logX = chart.logY = true;
    chart.topLabel = words_("bits axis");
    for (int count = 6; count <= 20; count += 2) chart.topTicks.emplace_back(noiseOfBits(count), std::to_string(count));
    std::array<ReportCurve, 2> bounds = boundsOf(choice);
    const std::array decoders{TestedDecoder{"rbf", DecoderKind::Rbf, false, false, 0},
                              TestedDecoder{"rbf, one per area", DecoderKind::Rbf, false, true, 1},
                              TestedDecoder{"rbf, trained clean", DecoderKind::Rbf, true, false, 2},
                              TestedDecoder{"linear", DecoderKind::Linear, false, false, 3},
                              TestedDecoder{"ml", DecoderKind::MaximumLikelihood, false, false, 4}};
    const auto steps = static_cast<double>(decoders.size() * kNoises.size() * choices_.size());
    double share = 0.25 + 0.5 * done;
    for (const TestedDecoder& decoder : decoders) {
      ReportCurve curve{.name = decoder.name, .color = decoder.color};
      for (const double noise : kNoises) {
        if (stop_.stop_requested()) return false;
        progress(share, choice.name + ": " + decoder.name);
        share += 0.5 / steps;
        const auto error = errorOf(choice, decoder, noise, decoder.trainedClean ? 0 : noise);
        if (!error) continue;
        addPoint(curve, noise, rootMeanSquare(*error));
        point(choice.name, decoder.name, noise, noise, *error);
      }
      if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
    }
    for (ReportCurve& bound : bounds)
      chart.curves.push_back(std::move(bound)); // on top of the decoders that reach them
    add(std::move(chart));
    return true;
  }

  /// Error of a decoder trained at one noise and tested at another; a failure is listed and leaves a gap in the curve.
  std::optional<Eigen::Vector3d> errorOf(const RowChoice& choice, const TestedDecoder& decoder, double noise,
                                         double trained) {
    TrainOptions options;
    options.input = InputKind::Resistance;
    options.rows = choice.option;
    options.decoder = decoder.kind;
    options.noise = trained;
    options.seed = request_.seed;
    options.threads = request_.threads;
    const NoisyError error = (decoder.areaKnown ? noisyErrorAreaKnown : noisyError)(
        request_.design, *sets_, options, noise, request_.seed, content_.stages, stop_);
    if (error.failed.empty()) return error.rmse_percentOfRange;
    content_.warnings.push_back(
        words_("failed", {{"rows", choice.name}, {"decoder", decoder.name}, {"noise", noise}, {"why", error.failed}}));
    return {};
  }

  bool trainingNoise() {
    heading("training heading");
    ReportChart chart = words_.chart("training_noise", "training chart");
    chart.logX = chart.logY = true;
    std::size_t step = 0;
    for (const RowChoice* choice : {&choices_.front(), &choices_.back()}) {
      ReportCurve curve{.name = choice->name};
      for (const double trained : kTrainingNoises) {
        if (stop_.stop_requested()) return false;
        progress(0.75 + 0.24 * static_cast<double>(step++) / static_cast<double>(2 * kTrainingNoises.size()),
                 "training noise " + text(trained));
        const auto error = errorOf(*choice, {"rbf", DecoderKind::Rbf, false, true, 0}, kShownNoise, trained);
        if (!error) continue;
        curve.x.push_back(trained > 0 ? trained : 1e-8);
        curve.y.push_back(rootMeanSquare(*error));
        addErrors(choice->name, "training noise: rbf, one per area", kShownNoise, trained, *error);
      }
      chart.curves.push_back(std::move(curve));
    }
    add(std::move(chart));
    return true;
  }

  [[nodiscard]] bool bounded() const { return request_.perArea >= kFewestForBounds; }

  /// The same in bits and newtons, by the bound with prior of all row-wires.
  void bits() {
    heading("bits heading");
    ReportChart chart = words_.chart("bits", "bits chart");
    chart.logY = true;
    ReportTable table = words_.table("bits table");
    for (const RowChoice& choice : choices_) {
      table.heads.push_back(choice.name + " [N]");
      table.heads.push_back("resolves [N]");
      chart.curves.push_back({.name = choice.name});
    }
    for (int count = 8; count <= 24; count += 2) {
      std::vector<std::string> cells{std::to_string(count), shortNumber(noiseOfBits(count))};
      for (std::size_t c = 0; c < choices_.size(); ++c) {
        const NoiseBound bound = noiseBound(sets_->test, InputKind::Resistance, choices_[c].rows, noiseOfBits(count));
        const Eigen::Vector3d error_N = bound.withPriorPercent.cwiseProduct(range_N_) / 100;
        cells.push_back(triple(error_N));
        cells.push_back(shortNumber(rootMeanSquare(error_N)));
        chart.curves[c].x.push_back(count);
        chart.curves[c].y.push_back(rootMeanSquare(error_N));
        if (count == 12 || count == 16) summarise(choices_[c], count, rootMeanSquare(error_N));
      }
      table.rows.push_back(std::move(cells));
    }
    add(std::move(table));
    add(std::move(chart));
  }

  void summarise(const RowChoice& choice, int count, double error_N) {
    if (&choice != &choices_.front() && &choice != &choices_.back()) return;
    content_.summary +=
        (content_.summary.empty() ? "" : " ") +
        words_("bits summary",
               {{"bits", count}, {"noise", noiseOfBits(count)}, {"rows", choice.name}, {"error", error_N}});
  }

  /// The same design under the usual law of the field: the read-out decides more than the law. False: stopped.
  bool otherLaws() {
    heading("laws heading");
    const FieldLaw law;
    SensorDesign field = request_.design;
    field.resistance = law;
    if (const auto faults = check(field); !faults.empty() || field.pressureLaw) {
      const std::string why = faults.empty() ? words_("pressure law") : faults.front().sentence;
      paragraph("laws not available", {{"why", why}});
      return true;
    }
    progress(0.99, "other laws and read-outs");
    const auto response =
        AreaResponse::atRest(request_.design, request_.mesh, request_.threads, content_.stages, {}, stop_);
    if (!response) return false;
    const LawsSideBySide laws(request_.design, law, *response, request_.threads, content_.stages, stop_);
    paragraph("laws", {{"radius", text(law.electrodeRadius_mm)}, {"resistivity", text(law.resistivity_ohm_mm)}});
    add(laws.signals());
    add(laws.bounds(kShownNoise, &content_.figures));
    for (const LawReading& reading : laws.readings())
      for (const int row : {centreRowWire(request_.design.rowWires()), -1}) {
        const LayoutBound bound = reading.bound(row, kShownNoise);
        const std::string rows = row < 0 ? choices_.back().name : "row-wire " + std::to_string(row);
        addErrors(rows, "bound with prior at rest, " + reading.name, kShownNoise, "", bound.withPrior());
        addErrors(rows, "bound without prior at rest, " + reading.name, kShownNoise, "", bound.withoutPrior());
      }
    return true;
  }

  std::optional<TwoSets> sets_;
  std::vector<RowChoice> choices_;
  ReportTable table_;
};

} // namespace

std::optional<ReportContent> noiseReport(const ReportRequest& request, const ReportProgress& progress,
                                         std::stop_token stop) {
  requireValid(request.design);
  if (request.design.field()) return fieldNoiseReport(request, progress, std::move(stop));
  return NoiseWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
