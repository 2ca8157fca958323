#include "app/study/reports/readout/ReadoutReport.h"

#include "app/study/reports/ReportWriter.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/SignalComparison.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "app/study/reports/readout/CurrentPaths.h"
#include "model/base/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr double kReadoutFineness = 0.5; // of the field's quadrature in sweeps: 1e-4 of a bound
constexpr double kLoss = 1.1;            // of the bound, up to which a resistance in series is called harmless
constexpr double kWanted_percent = 1;    // of the range, that the sentences ask for
const std::array kRadii{0.5, 0.75, 1.0, 1.25, 1.5};   // times the design's
const std::array kContacts{0.0, 0.3, 1.0, 3.0, 10.0}; // times an electrode's own spreading resistance
const std::array kWires_ohm{0.0, 1.0, 5.0, 20.0, 100.0, 500.0};

/// Noise of each reading that is the same on all of what the circuit measures, as a share of its largest: a resistance
/// at constant current where two wires float alone, else a current at constant voltage.
Eigen::MatrixXd fullScaleNoise(Readout readout, const Eigen::MatrixXd& resistances_ohm, double noise) {
  if (readout == Readout::Floating) return noise * resistances_ohm.maxCoeff() * resistances_ohm.cwiseInverse();
  return noise / resistances_ohm.minCoeff() * resistances_ohm;
}

struct OfReadout {
  std::string name;
  Readout readout = Readout::Floating;
  double mean_percent = 0;          ///< bound without prior of all row-wires, geometric mean of the forces
  double mean_percentFullScale = 0; ///< the same with noise of full scale
  Eigen::Vector3d all_percent;      ///< with prior, all row-wires
  double least_ohm = 0, most_ohm = 0;
  CurrentPaths paths;
};

class ReadoutWriter : ReportWriter {
public:
  ReadoutWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "readout",
                     {"what", "readout", "rows", "at", "force", "value"}),
        law_(request.design.field() ? *request.design.field() : FieldLaw{}) {
    design_ = request.design;
    design_.resistance = law_;
    requireValid(design_); // electrodes of the usual radius may not fit a design by Eq. (1)
  }

  std::optional<ReportContent> run() {
    content_.warnings = designWarnings(design_);
    const auto response = AreaResponse::atRest(design_, request_.mesh, request_.threads, content_.stages,
                                               partOf(progress_, 0, 0.3), stop_);
    if (!response) return {};
    introduce();
    progress(0.3, "the read-outs of the design");
    readouts(*response);
    sweeps(*response);
    sentences();
    commonSection("assumptions heading", "field");
    paragraph("radius assumption", {{"radius", text(law_.electrodeRadius_mm)}});
    return finished();
  }

private:
  void introduce() {
    heading("design heading");
    paragraph("design", {{"law", words_(request_.design.field() ? "law field" : "law pairs")},
                         {"radius", text(law_.electrodeRadius_mm)},
                         {"resistivity", text(law_.resistivity_ohm_mm)},
                         {"contact", text(law_.contact_ohm_mm2)},
                         {"wire", text(law_.wire_ohm)},
                         {"lower", words_(design_.lowerFollowsRubber ? "lower follow" : "lower fixed")}});
    paragraph("readouts");
  }

  void readouts(const AreaResponse& response) {
    const FieldResponse field(design_, law_, response, request_.threads, 1, stop_);
    SensorDesign pairs = design_;
    pairs.resistance = PairsLaw{};
    const LogSensitivity byPairs = logSensitivity(pairs, response);
    ReportTable bounds = words_.table("bounds table", {{"noise", kShownNoise}, {"meaning", common_("bounds")}});
    ReportTable signals = words_.table("signals table");
    for (const auto& [readout, name] : kReadouts.all()) {
      const Eigen::MatrixXd rest = field.resistances_ohm(readout);
      const LogSensitivity slopes = field.logSensitivity(readout);
      OfReadout& of = found_.emplace_back();
      of.name = name;
      of.readout = readout;
      of.least_ohm = rest.minCoeff();
      of.most_ohm = rest.maxCoeff();
      of.paths = currentPaths(field.network(), readout);
      for (const int row : {row_, -1}) {
        const LayoutBound each = field.bound(readout, row, kShownNoise);
        const LayoutBound full = field.bound(readout, row, fullScaleNoise(readout, rest, kShownNoise));
        bounds.add({name, rowsText(row), each.withPrior(), each.withoutPrior(), full.withPrior(), full.withoutPrior()});
        addBounds(name, row, "noise of each reading", kShownNoise, each);
        addBounds(name, row, "noise of full scale", kShownNoise, full);
        if (row >= 0) continue;
        of.mean_percent = each.mean();
        of.mean_percentFullScale = full.mean();
        of.all_percent = each.withPrior();
      }
      const SignalComparison signal = comparedWith(byPairs, slopes);
      signals.add({name, of.least_ohm, of.most_ohm, signal.factor, signal.correlation,
                   shortNumber(100 * of.paths.straight) + " %", shortNumber(100 * of.paths.metal) + " %"});
      csv_.addForces({{"signal over that of Eq. (1)", signal.factor}, {"correlation with Eq. (1)", signal.correlation}},
                     {name, "all", ""});
      csv_.add({"current straight from row to column, share", name, "all", "", "", of.paths.straight});
      csv_.add({"current through other wires' metal, share", name, "all", "", "", of.paths.metal});
    }
    heading("comparison heading");
    paragraph("comparison");
    add(std::move(bounds));
    add(std::move(signals));
  }

  void addBounds(const std::string& readout, int row, const std::string& what, double at, const LayoutBound& bound) {
    csv_.addForces({{what + ": bound with prior [%]", bound.withPrior()},
                    {what + ": bound without prior [%]", bound.withoutPrior()}},
                   {readout, rowsText(row), at});
  }

  /// A number of the law and the values it is given.
  struct LawSweep {
    std::string file, heading, label, what;
    std::vector<double> values, shown; ///< as the law has them, and as the chart does
    double FieldLaw::*member = nullptr;
  };

  std::vector<LawSweep> lawSweeps() const {
    LawSweep radius{"radius", "Electrode radius",           "radius of the electrodes [mm]", "radius [mm]", {},
                    {},       &FieldLaw::electrodeRadius_mm};
    for (const double times : kRadii) {
      SensorDesign design = design_;
      FieldLaw law = law_;
      law.electrodeRadius_mm *= times;
      design.resistance = law;
      if (check(design).empty()) radius.values.push_back(law.electrodeRadius_mm);
    }
    radius.shown = radius.values;
    LawSweep contact{"contact",
                     "Contact resistance",
                     "contact, times an electrode's own spreading resistance",
                     "contact over spreading resistance",
                     {},
                     {},
                     &FieldLaw::contact_ohm_mm2};
    for (const double times : kContacts) { // contact / (4 pi a^2) = times rho / (4 pi a)
      contact.values.push_back(times * law_.resistivity_ohm_mm * law_.electrodeRadius_mm);
      contact.shown.push_back(times);
    }
    LawSweep wire{"wire",
                  "Resistance of wires and switches",
                  "resistance of each wire with its switch [ohm]",
                  "wire and switch [ohm]",
                  {kWires_ohm.begin(), kWires_ohm.end()},
                  {kWires_ohm.begin(), kWires_ohm.end()},
                  &FieldLaw::wire_ohm};
    return {radius, contact, wire};
  }

  void sweeps(const AreaResponse& response) {
    const std::vector<LawSweep> all = lawSweeps();
    for (std::size_t s = 0; s < all.size(); ++s) {
      const LawSweep& sweep = all[s];
      add(ReportHeading{sweep.heading});
      ReportTable table = words_.table("sweep table", {{"noise", kShownNoise}, {"what", sweep.what}});
      ReportChart chart = words_.chart(sweep.file, "sweep chart", {{"heading", sweep.heading}, {"label", sweep.label}});
      chart.logY = true;
      for (const OfReadout& of : found_) {
        table.heads.push_back(of.name);
        chart.curves.push_back({.name = of.name});
      }
      std::vector<std::vector<double>> means(found_.size());
      for (std::size_t i = 0; i < sweep.values.size(); ++i) {
        progress(
            0.4 + 0.6 * (static_cast<double>(s) + static_cast<double>(i) / static_cast<double>(sweep.values.size())) /
                      static_cast<double>(all.size()),
            sweep.what + " " + shortNumber(sweep.shown[i]));
        FieldLaw law = law_;
        law.*sweep.member = sweep.values[i];
        SensorDesign design = design_;
        design.resistance = law;
        const FieldResponse field(design, law, response, request_.threads, kReadoutFineness, stop_);
        std::vector<std::string> cells{shortNumber(sweep.shown[i])};
        for (std::size_t r = 0; r < found_.size(); ++r) {
          const LayoutBound bound = field.bound(found_[r].readout, -1, kShownNoise);
          addBounds(found_[r].name, -1, sweep.what, sweep.shown[i], bound);
          means[r].push_back(bound.mean());
          cells.push_back(shortNumber(bound.mean()));
          chart.curves[r].x.push_back(sweep.shown[i]);
          chart.curves[r].y.push_back(bound.mean());
        }
        table.rows.push_back(std::move(cells));
      }
      means_.push_back(std::move(means));
      add(std::move(table));
      add(std::move(chart));
    }
    swept_ = all;
  }

  /// The value of a sweep up to which a read-out's bound stays within kLoss of that at the first value; between two
  /// values linearly.
  [[nodiscard]] double harmless(std::size_t sweep, std::size_t readout) const {
    const std::vector<double>&means = means_[sweep][readout], &at = swept_[sweep].shown;
    const double most = kLoss * means.front();
    for (std::size_t i = 1; i < means.size(); ++i)
      if (means[i] > most) return at[i - 1] + (at[i] - at[i - 1]) * (most - means[i - 1]) / (means[i] - means[i - 1]);
    return at.back();
  }

  /// "8.8 times better than floating, 1.2 times better than rows_grounded".
  [[nodiscard]] std::string comparedWithOthers(const OfReadout& best) const {
    std::string words;
    for (const OfReadout& of : found_)
      if (of.name != best.name)
        words += (words.empty() ? "" : ", ") + shortNumber(of.mean_percent / best.mean_percent) +
                 " times better than " + of.name;
    return words;
  }

  /// Relative noise that leaves kWanted_percent without prior, which grows with the noise in proportion.
  [[nodiscard]] static double noiseFor(double mean_percent) { return kShownNoise * kWanted_percent / mean_percent; }

  void sentences() {
    const auto best = std::min_element(found_.begin(), found_.end(), [](const OfReadout& a, const OfReadout& b) {
      return a.mean_percent < b.mean_percent;
    });
    const auto worst = std::max_element(found_.begin(), found_.end(), [](const OfReadout& a, const OfReadout& b) {
      return a.mean_percent < b.mean_percent;
    });
    const auto index = static_cast<std::size_t>(best - found_.begin());
    const std::vector<double>& byRadius = means_[0][index];
    const auto bestRadius =
        static_cast<std::size_t>(std::min_element(byRadius.begin(), byRadius.end()) - byRadius.begin());
    const double bits = std::ceil(bitsOfNoise(noiseFor(best->mean_percentFullScale)));
    heading("conclusions heading");
    paragraph("best", {{"best", best->name}, {"others", comparedWithOthers(*best)}});
    paragraph("currents", {{"least", best->least_ohm},
                           {"most", best->most_ohm},
                           {"ratio", best->most_ohm / best->least_ohm},
                           {"current", 1000 * best->paths.mostPerVolt_A},
                           {"straight", 100 * best->paths.straight}});
    paragraph("noise", {{"wanted", text(kWanted_percent)},
                        {"reading", noiseFor(best->mean_percent)},
                        {"full_scale", noiseFor(best->mean_percentFullScale)},
                        {"bits", bits},
                        {"worst", worst->name},
                        {"worst_reading", noiseFor(worst->mean_percent)},
                        {"worst_full_scale", noiseFor(worst->mean_percentFullScale)}});
    paragraph("wires", {{"wire", harmless(2, index)},
                        {"loss", 100 * (kLoss - 1)},
                        {"contact", harmless(1, index)},
                        {"spreading", spreading_ohm()}});
    paragraph("radius", {{"radius", swept_[0].shown[bestRadius]},
                         {"best", best->name},
                         {"bound", byRadius[bestRadius]},
                         {"first_bound", byRadius.front()},
                         {"first", swept_[0].shown.front()},
                         {"last_bound", byRadius.back()},
                         {"last", swept_[0].shown.back()}});
    for (const OfReadout& of : found_) {
      content_.figures.emplace_back(of.name + "_bound_without_prior_percent", of.mean_percent);
      content_.figures.emplace_back(of.name + "_bound_without_prior_full_scale_percent", of.mean_percentFullScale);
      content_.figures.emplace_back(of.name + "_current_straight_share", of.paths.straight);
      content_.figures.emplace_back(of.name + "_current_in_other_metal_share", of.paths.metal);
    }
    content_.figures.emplace_back("noise_of_reading_for_one_percent", noiseFor(best->mean_percent));
    content_.figures.emplace_back("noise_of_full_scale_for_one_percent", noiseFor(best->mean_percentFullScale));
    content_.figures.emplace_back("harmless_wire_ohm", harmless(2, index));
    content_.figures.emplace_back("best_radius_mm", swept_[0].shown[bestRadius]);
    content_.summary = words_("summary", {{"best", best->name},
                                          {"noise", kShownNoise},
                                          {"error", best->all_percent},
                                          {"others", comparedWithOthers(*best)},
                                          {"wire", harmless(2, index)},
                                          {"loss", 100 * (kLoss - 1)}});
  }

  [[nodiscard]] double spreading_ohm() const {
    return law_.resistivity_ohm_mm / (4 * std::numbers::pi * law_.electrodeRadius_mm);
  }

  const FieldLaw law_;
  SensorDesign design_;
  std::vector<OfReadout> found_;
  std::vector<LawSweep> swept_;
  std::vector<std::vector<std::vector<double>>> means_; ///< of each sweep, by read-out and value [%]
};

} // namespace

std::optional<ReportContent> readoutReport(const ReportRequest& request, const ReportProgress& progress,
                                           std::stop_token stop) {
  requireValid(request.design);
  requireSmoothAtRest(request.design);
  return ReadoutWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
