#include "app/study/reports/networks/NoiseReport.h"

#include "app/study/reports/BoundWords.h"
#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/ReportText.h"
#include "app/study/reports/networks/FieldNoiseReport.h"
#include "app/study/reports/networks/LawsSideBySide.h"
#include "app/study/reports/networks/NetworkCheck.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "model/base/Text.h"

#include <array>
#include <cmath>

namespace palp {

namespace {

constexpr int kFewestForBounds = 8; // samples on an area, for a linear fit in three forces
constexpr std::array kTrainingNoises{0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};

/// Relative noise that rounding to so many bits makes where R is at full scale.
double noiseOfBits(double bits) {
  return std::exp2(-bits) / std::sqrt(12.0);
}

double bitsOfNoise(double noise) {
  return -std::log2(noise * std::sqrt(12.0));
}

/// Row-wires that are read together.
struct RowChoice {
  std::string name;
  std::string option; ///< as of `palp train --rows`
  std::vector<int> rows;
};

/// A way to decode over the noises.
struct Baseline {
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

class NoiseWriter {
public:
  NoiseWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), progress_(std::move(progress)), stop_(std::move(stop)),
        range_N_(request.design.forceRange.high_N - request.design.forceRange.low_N) {}

  std::optional<ReportContent> run() {
    content_.title = words_("title");
    sets_ = twoSets(
        request_.design, request_, content_.stages,
        [&](double share, const std::string& what) { say(0.25 * share, what); }, stop_);
    if (!sets_) return {};
    if (!bounded()) {
      const std::string why = words_(
          "no bounds", {{"samples", std::to_string(request_.perArea)}, {"needed", std::to_string(kFewestForBounds)}});
      content_.warnings.push_back(why);
      content_.summary = words_("no bounds summary", {{"why", why}});
    }
    chooseRows();
    introduce();
    for (std::size_t i = 0; i < choices_.size(); ++i)
      if (!errorsOf(choices_[i], static_cast<double>(i) / static_cast<double>(choices_.size()))) return {};
    content_.parts.emplace_back(std::move(table_));
    if (!trainingNoise()) return {};
    if (bounded()) bits();
    if (!otherLaws()) return {};
    content_.parts.push_back(ReportHeading{words_("left out heading")});
    content_.parts.push_back(ReportWords{kLeftOut});
    content_.csv = csv_.text();
    return std::move(content_);
  }

private:
  void say(double share, const std::string& what) const {
    if (progress_) progress_(share, what);
  }

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
    content_.parts.push_back(ReportHeading{words_("errors heading")});
    content_.parts.push_back(ReportWords{words_(
        "errors",
        {{"samples", std::to_string(request_.perArea)}, {"range", triple(range_N_)}, {"meaning", kBoundsMean}})});
    table_.caption = words_("errors caption", {{"noise", text(kShownNoise)}});
    table_.heads = {"rows read", "what", "error"};
  }

  void point(const std::string& rows, const std::string& what, double noise, double trained,
             const Eigen::Vector3d& percent) {
    for (int axis = 0; axis < 3; ++axis)
      csv_.add({rows, what, noise, bitsOfNoise(noise), trained, kForceNames[axis], percent(axis),
                percent(axis) / 100 * range_N_(axis)});
    if (noise == kShownNoise && trained == noise) table_.rows.push_back({rows, what, triple(percent)});
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
    ReportChart chart{.file = "noise_" + std::to_string(choice.rows.size()),
                      .caption = words_("errors chart", {{"rows", choice.name}, {"percent", text(kDrawnUpTo_percent)}}),
                      .title = "Force error, " + choice.name,
                      .xLabel = "relative noise of R (12 bits = 7e-5, 16 bits = 4.4e-6)",
                      .yLabel = "error, rms of Fx, Fy, Fz [% of range]",
                      .logX = true,
                      .logY = true,
                      .topLabel = "bits of an ideal converter whose full scale is R"};
    for (int count = 6; count <= 20; count += 2) chart.topTicks.emplace_back(noiseOfBits(count), std::to_string(count));
    std::array<ReportCurve, 2> bounds = boundsOf(choice);
    const std::array baselines{Baseline{"rbf", DecoderKind::Rbf, false, false, 0},
                               Baseline{"rbf, one per area", DecoderKind::Rbf, false, true, 1},
                               Baseline{"rbf, trained clean", DecoderKind::Rbf, true, false, 2},
                               Baseline{"linear", DecoderKind::Linear, false, false, 3},
                               Baseline{"ml", DecoderKind::MaximumLikelihood, false, false, 4}};
    const auto steps = static_cast<double>(baselines.size() * kNoises.size() * choices_.size());
    double share = 0.25 + 0.5 * done;
    for (const Baseline& baseline : baselines) {
      ReportCurve curve{.name = baseline.name, .color = baseline.color};
      for (const double noise : kNoises) {
        if (stop_.stop_requested()) return false;
        say(share, choice.name + ": " + baseline.name);
        share += 0.5 / steps;
        const auto error = errorOf(choice, baseline, noise, baseline.trainedClean ? 0 : noise);
        if (!error) continue;
        addPoint(curve, noise, rootMeanSquare(*error));
        point(choice.name, baseline.name, noise, noise, *error);
      }
      if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
    }
    for (ReportCurve& bound : bounds)
      chart.curves.push_back(std::move(bound)); // on top of the decoders that reach them
    content_.parts.emplace_back(std::move(chart));
    return true;
  }

  /// Error of a decoder trained at one noise and tested at another; a failure is listed and leaves a gap in the curve.
  std::optional<Eigen::Vector3d> errorOf(const RowChoice& choice, const Baseline& baseline, double noise,
                                         double trained) {
    TrainOptions options;
    options.input = InputKind::Resistance;
    options.rows = choice.option;
    options.decoder = baseline.kind;
    options.noise = trained;
    options.seed = request_.seed;
    options.threads = request_.threads;
    const NoisyError error = (baseline.areaKnown ? noisyErrorAreaKnown : noisyError)(
        request_.design, *sets_, options, noise, request_.seed, content_.stages, stop_);
    if (error.failed.empty()) return error.rmse_percentOfRange;
    content_.warnings.push_back(words_(
        "failed", {{"rows", choice.name}, {"decoder", baseline.name}, {"noise", text(noise)}, {"why", error.failed}}));
    return {};
  }

  bool trainingNoise() {
    content_.parts.push_back(ReportHeading{words_("training heading")});
    ReportChart chart{.file = "training_noise",
                      .caption = words_("training chart"),
                      .title = "Networks at noise 1e-4",
                      .xLabel = "relative noise of the training (0 is drawn at 1e-8)",
                      .yLabel = "error, rms of Fx, Fy, Fz [% of range]",
                      .logX = true,
                      .logY = true};
    std::size_t step = 0;
    for (const RowChoice* choice : {&choices_.front(), &choices_.back()}) {
      ReportCurve curve{.name = choice->name};
      for (const double trained : kTrainingNoises) {
        if (stop_.stop_requested()) return false;
        say(0.75 + 0.24 * static_cast<double>(step++) / static_cast<double>(2 * kTrainingNoises.size()),
            "training noise " + text(trained));
        const auto error = errorOf(*choice, {"rbf", DecoderKind::Rbf, false, true, 0}, kShownNoise, trained);
        if (!error) continue;
        curve.x.push_back(trained > 0 ? trained : 1e-8);
        curve.y.push_back(rootMeanSquare(*error));
        for (int axis = 0; axis < 3; ++axis)
          csv_.add({choice->name, "training noise: rbf, one per area", kShownNoise, bitsOfNoise(kShownNoise), trained,
                    kForceNames[axis], (*error)(axis), (*error)(axis) / 100 * range_N_(axis)});
      }
      chart.curves.push_back(std::move(curve));
    }
    content_.parts.emplace_back(std::move(chart));
    return true;
  }

  [[nodiscard]] bool bounded() const { return request_.perArea >= kFewestForBounds; }

  /// The same in bits and newtons, by the bound with prior of all row-wires.
  void bits() {
    content_.parts.push_back(ReportHeading{words_("bits heading")});
    ReportChart chart{.file = "bits",
                      .caption = words_("bits chart"),
                      .title = "Resolution of this design",
                      .xLabel = "bits",
                      .yLabel = "root mean square error [N]",
                      .logY = true};
    ReportTable table{.caption = words_("bits caption"), .heads = {"bits", "relative noise"}};
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
    content_.parts.emplace_back(std::move(table));
    content_.parts.emplace_back(std::move(chart));
  }

  void summarise(const RowChoice& choice, int count, double error_N) {
    if (&choice != &choices_.front() && &choice != &choices_.back()) return;
    content_.summary +=
        (content_.summary.empty() ? "" : " ") + words_("bits summary", {{"bits", std::to_string(count)},
                                                                        {"noise", shortNumber(noiseOfBits(count))},
                                                                        {"rows", choice.name},
                                                                        {"error", shortNumber(error_N)}});
  }

  /// The same design under the usual law of the field: the read-out decides more than the law. False: stopped.
  bool otherLaws() {
    content_.parts.push_back(ReportHeading{words_("laws heading")});
    const FieldLaw law;
    SensorDesign field = request_.design;
    field.resistance = law;
    if (const auto faults = check(field); !faults.empty() || field.pressureLaw) {
      const std::string why = faults.empty() ? words_("pressure law") : faults.front().sentence;
      content_.parts.push_back(ReportWords{words_("laws not available", {{"why", why}})});
      return true;
    }
    say(0.99, "other laws and read-outs");
    const auto response =
        AreaResponse::atRest(request_.design, request_.mesh, request_.threads, content_.stages, {}, stop_);
    if (!response) return false;
    const LawsSideBySide laws(request_.design, law, *response, request_.threads, content_.stages, stop_);
    content_.parts.push_back(ReportWords{
        words_("laws", {{"radius", text(law.electrodeRadius_mm)}, {"resistivity", text(law.resistivity_ohm_mm)}})});
    content_.parts.emplace_back(laws.signals());
    content_.parts.emplace_back(laws.bounds(kShownNoise, &content_.figures));
    for (const LawReading& reading : laws.readings())
      for (const int row : {centreRowWire(request_.design.rowWires()), -1}) {
        const LayoutBound bound = reading.bound(row, kShownNoise);
        const std::string rows = row < 0 ? choices_.back().name : "row-wire " + std::to_string(row);
        addBound(rows, "bound with prior at rest, " + reading.name, bound.withPrior());
        addBound(rows, "bound without prior at rest, " + reading.name, bound.withoutPrior());
      }
    return true;
  }

  void addBound(const std::string& rows, const std::string& what, const Eigen::Vector3d& percent) {
    for (int axis = 0; axis < 3; ++axis)
      csv_.add({rows, what, kShownNoise, bitsOfNoise(kShownNoise), "", kForceNames[axis], percent(axis),
                percent(axis) / 100 * range_N_(axis)});
  }

  const ReportText words_{"noise"};
  const ReportRequest& request_;
  ReportProgress progress_;
  std::stop_token stop_;
  Eigen::Vector3d range_N_;
  ReportContent content_;
  Csv csv_{{"rows", "what", "relative_noise", "bits", "training_noise", "force", "error_percent_of_range", "error_N"}};
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
