#include "app/study/reports/networks/FieldNoiseReport.h"

#include "app/study/reports/BoundWords.h"
#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/SignalComparison.h"
#include "app/study/reports/networks/LawsSideBySide.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "model/base/Text.h"

#include <array>
#include <cmath>

namespace palp {

namespace {

class FieldNoiseWriter {
public:
  FieldNoiseWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), law_(*request.design.field()), progress_(std::move(progress)), stop_(std::move(stop)),
        row_(centreRowWire(request.design.rowWires())),
        range_N_(request.design.forceRange.high_N - request.design.forceRange.low_N) {}

  std::optional<ReportContent> run() {
    content_.title = "Noise: what the read-outs of the field resolve";
    content_.warnings = designWarnings(request_.design);
    const auto response = AreaResponse::atRest(
        request_.design, request_.mesh, request_.threads, content_.stages,
        [&](double share, const std::string& what) { say(0.7 * share, what); }, stop_);
    if (!response) return {};
    say(0.7, "the field at rest");
    laws_.emplace(request_.design, law_, *response, request_.threads, content_.stages, stop_);
    introduce();
    signals();
    bounds();
    curves();
    bits();
    assumptions();
    content_.csv = csv_.text();
    return std::move(content_);
  }

private:
  void say(double share, const std::string& what) const {
    if (progress_) progress_(share, what);
  }

  void introduce() {
    content_.parts.push_back(ReportHeading{"Comparison of laws and read-outs"});
    content_.parts.push_back(
        ReportWords{"The field of the complete block between spheres of " + text(law_.electrodeRadius_mm) +
                    " mm radius, resistivity " + text(law_.resistivity_ohm_mm) + " ohm mm, contact " +
                    text(law_.contact_ohm_mm2) + " ohm mm2, each wire and its switch " + text(law_.wire_ohm) +
                    " ohm. Everything is linear, at rest: the field without a mesh, displacements of electrodes and "
                    "faces by finite "
                    "elements. The design reads by " +
                    kReadouts.name(law_.readout) +
                    ". Read-outs: floating: only the two wires are driven; virtual_ground: all but "
                    "the row-wire at 0 V, the column-wire's current is read; rows_grounded: the same "
                    "while the other column-wires float; others_at_half: all other wires at half of "
                    "the drive voltage."});
  }

  void signals() {
    content_.parts.emplace_back(laws_->signals());
    for (const LawReading& reading : laws_->readings()) {
      const auto& [factor, correlation] = comparedWith(laws_->readings().front().slopes, reading.slopes);
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const char* const force = kForceNames[static_cast<std::size_t>(axis)];
        csv_.add({"signal over that of Eq. (1)", reading.name, "", "", force, factor(axis)});
        csv_.add({"correlation with Eq. (1)", reading.name, "", "", force, correlation(axis)});
      }
    }
  }

  void bounds() {
    content_.parts.push_back(ReportHeading{"What the noise allows"});
    content_.parts.push_back(ReportWords{
        "Cramer-Rao bounds of the force with the area known, in % of the range (" + triple(range_N_) +
        " N), for normal noise that is relative and independent on every resistance. " + std::string(kBoundsMean)});
    content_.parts.emplace_back(laws_->bounds(kShownNoise, &content_.figures));
    for (const LawReading& reading : laws_->readings())
      if (reading.name == kReadouts.name(law_.readout)) summarise(reading.bound(-1, kShownNoise));
  }

  void curves() {
    for (const int row : {row_, -1}) {
      const std::string rows = row < 0 ? "all row-wires" : "row-wire " + std::to_string(row);
      ReportChart chart{.file = row < 0 ? "field_all" : "field_row",
                        .caption = "Bound with prior against noise, " + rows,
                        .title = "What the read-outs resolve, " + rows,
                        .xLabel = "relative noise of R",
                        .yLabel = "bound with prior, rms of Fx, Fy, Fz [% of range]",
                        .logX = true,
                        .logY = true};
      for (const LawReading& reader : laws_->readings()) {
        ReportCurve curve{.name = reader.name, .dashed = &reader == &laws_->readings().front()};
        for (const double noise : kNoises) {
          const LayoutBound bound = reader.bound(row, noise);
          addPoints(reader.name, row, noise, bound);
          const double percent = rootMeanSquare(bound.withPrior());
          if (percent > kDrawnUpTo_percent) continue;
          curve.x.push_back(noise);
          curve.y.push_back(percent);
        }
        chart.curves.push_back(std::move(curve));
      }
      content_.parts.emplace_back(std::move(chart));
    }
  }

  void addPoints(const std::string& reader, int row, double noise, const LayoutBound& bound) {
    const Eigen::Vector3d with = bound.withPrior(), without = bound.withoutPrior();
    const std::string rows = row < 0 ? "all" : std::to_string(row);
    for (int axis = 0; axis < 3; ++axis) {
      csv_.add({"bound with prior [%]", reader, rows, noise, kForceNames[axis], with(axis)});
      csv_.add({"bound without prior [%]", reader, rows, noise, kForceNames[axis], without(axis)});
    }
  }

  /// The same in bits and newtons, all row-wires.
  void bits() {
    content_.parts.push_back(ReportHeading{"What a converter resolves"});
    ReportTable table{
        "Bound with prior of all row-wires, root mean square of the three forces [N], against the bits of "
        "an ideal converter whose full scale is the resistance at rest",
        {"bits", "relative noise"},
        {},
        {}};
    for (const LawReading& reader : laws_->readings()) table.heads.push_back(reader.name);
    for (int count = 8; count <= 24; count += 2) {
      const double noise = std::exp2(-count) / std::sqrt(12.0); // of rounding
      std::vector<std::string> cells{std::to_string(count), shortNumber(noise)};
      for (const LawReading& reader : laws_->readings()) {
        const Eigen::Vector3d error_N = reader.bound(-1, noise).withPrior().cwiseProduct(range_N_) / 100;
        cells.push_back(shortNumber(rootMeanSquare(error_N)));
      }
      table.rows.push_back(std::move(cells));
    }
    content_.parts.emplace_back(std::move(table));
  }

  void assumptions() {
    content_.parts.push_back(ReportHeading{"Assumptions"});
    content_.parts.push_back(ReportWords{kFieldAssumed});
  }

  void summarise(const LayoutBound& bound) {
    content_.summary = "Read by " + kReadouts.name(law_.readout) + " with noise " + text(kShownNoise) +
                       " on every resistance, all row-wires resolve " + triple(bound.withPrior()) +
                       " % of the range of Fx / Fy / Fz (bound with prior, linear at rest).";
  }

  const ReportRequest& request_;
  const FieldLaw law_;
  ReportProgress progress_;
  std::stop_token stop_;
  int row_;
  Eigen::Vector3d range_N_;
  ReportContent content_;
  Csv csv_{{"what", "law_and_readout", "rows", "relative_noise", "force", "value"}};
  std::optional<LawsSideBySide> laws_;
};

} // namespace

std::optional<ReportContent> fieldNoiseReport(const ReportRequest& request, const ReportProgress& progress,
                                              std::stop_token stop) {
  requireSmoothAtRest(request.design);
  return FieldNoiseWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
