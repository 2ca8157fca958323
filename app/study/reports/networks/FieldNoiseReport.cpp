#include "app/study/reports/networks/FieldNoiseReport.h"

#include "app/study/reports/ReportWriter.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/SignalComparison.h"
#include "app/study/reports/networks/LawsSideBySide.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "model/base/Text.h"

#include <cmath>

namespace palp {

namespace {

class FieldNoiseWriter : ReportWriter {
public:
  FieldNoiseWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "field-noise",
                     {"what", "law_and_readout", "rows", "relative_noise", "force", "value"}),
        law_(*request.design.field()) {}

  std::optional<ReportContent> run() {
    content_.warnings = designWarnings(request_.design);
    const auto response = AreaResponse::atRest(request_.design, request_.mesh, request_.threads, content_.stages,
                                               partOf(progress_, 0, 0.7), stop_);
    if (!response) return {};
    progress(0.7, "the field at rest");
    laws_.emplace(request_.design, law_, *response, request_.threads, content_.stages, stop_);
    signals();
    bounds();
    curves();
    bits();
    commonSection("assumptions heading", "field");
    return finished();
  }

private:
  void signals() {
    heading("comparison heading");
    paragraph("comparison", {{"radius", text(law_.electrodeRadius_mm)},
                             {"resistivity", text(law_.resistivity_ohm_mm)},
                             {"contact", text(law_.contact_ohm_mm2)},
                             {"wire", text(law_.wire_ohm)},
                             {"readout", readout_}});
    add(laws_->signals());
    for (const LawReading& reading : laws_->readings()) {
      const auto& [factor, correlation] = comparedWith(laws_->readings().front().slopes, reading.slopes);
      csv_.addForces({{"signal over that of Eq. (1)", factor}, {"correlation with Eq. (1)", correlation}},
                     {reading.name, "", ""});
    }
  }

  void bounds() {
    heading("bounds heading");
    paragraph("bounds", {{"range", range_N_}, {"meaning", common_("bounds")}});
    add(laws_->bounds(kShownNoise, &content_.figures));
    for (const LawReading& reading : laws_->readings())
      if (reading.name == readout_)
        content_.summary = words_(
            "summary",
            {{"readout", readout_}, {"noise", kShownNoise}, {"error", reading.bound(-1, kShownNoise).withPrior()}});
  }

  void curves() {
    for (const int row : {row_, -1}) {
      const std::string rows = row < 0 ? "all row-wires" : "row-wire " + std::to_string(row);
      ReportChart chart = words_.chart(row < 0 ? "field_all" : "field_row", "bounds chart", {{"rows", rows}});
      chart.logX = chart.logY = true;
      for (const LawReading& reading : laws_->readings()) {
        ReportCurve curve{.name = reading.name, .dashed = &reading == &laws_->readings().front()};
        for (const double noise : kNoises) {
          const LayoutBound bound = reading.bound(row, noise);
          csv_.addForces(
              {{"bound with prior [%]", bound.withPrior()}, {"bound without prior [%]", bound.withoutPrior()}},
              {reading.name, rowsText(row), noise});
          const double percent = rootMeanSquare(bound.withPrior());
          if (percent > kDrawnUpTo_percent) continue;
          curve.x.push_back(noise);
          curve.y.push_back(percent);
        }
        chart.curves.push_back(std::move(curve));
      }
      add(std::move(chart));
    }
  }

  /// The same in bits and newtons, all row-wires.
  void bits() {
    heading("bits heading");
    ReportTable table = words_.table("bits table");
    for (const LawReading& reading : laws_->readings()) table.heads.push_back(reading.name);
    for (int count = 8; count <= 24; count += 2) {
      const double noise = noiseOfBits(count);
      std::vector<std::string> cells{std::to_string(count), shortNumber(noise)};
      for (const LawReading& reading : laws_->readings()) {
        const Eigen::Vector3d error_N = reading.bound(-1, noise).withPrior().cwiseProduct(range_N_) / 100;
        cells.push_back(shortNumber(rootMeanSquare(error_N)));
      }
      table.rows.push_back(std::move(cells));
    }
    add(std::move(table));
  }

  const FieldLaw law_;
  const std::string readout_ = kReadouts.name(law_.readout);
  std::optional<LawsSideBySide> laws_;
};

} // namespace

std::optional<ReportContent> fieldNoiseReport(const ReportRequest& request, const ReportProgress& progress,
                                              std::stop_token stop) {
  requireSmoothAtRest(request.design);
  return FieldNoiseWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
