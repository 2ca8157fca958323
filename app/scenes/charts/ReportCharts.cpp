#include "app/scenes/charts/ReportCharts.h"

#include "app/scenes/charts/Chart.h"
#include "app/scenes/charts/PaperFigures.h"
#include "app/study/reports/ReportComputations.h"
#include "io/AtomicFile.h"

#include <chrono>

namespace palp {

namespace {

ChartSeries::Style style(ReportCurve::Style style) {
  switch (style) {
  case ReportCurve::Style::Line:
    return ChartSeries::Style::Line;
  case ReportCurve::Style::Points:
    return ChartSeries::Style::Points;
  case ReportCurve::Style::LineAndPoints:
    return ChartSeries::Style::LineAndPoints;
  }
  return ChartSeries::Style::Line;
}

/// The paper's experiments into the folder: values, figures, page and CSV.
ReportOutcome reproduce(const ReportRequest& request, const ReportProgress& progress, std::stop_token stop) {
  const auto start = std::chrono::steady_clock::now();
  ProtocolOptions options;
  options.perArea = request.perArea;
  options.firstSeed = request.seed;
  options.mesh = request.mesh;
  options.threads = request.threads;
  const SensorDesign design = paperDesign();
  const auto result = runPaperProtocol(
      design, {"table1", "fig12"}, options,
      [&](double share, const std::string& what) {
        if (progress) progress(0.95 * share, what);
      },
      stop);
  if (!result) return {};
  Touch touch(design, paperFigureLoad(), request.mesh);
  NewtonOptions newton;
  newton.threads = request.threads;
  touch.advance(Stage::Displacements, newton, {{}, stop});
  if (stop.stop_requested()) return {};
  std::filesystem::create_directories(request.folder);
  ReportRun run;
  run.command = request.command;
  run.firstSeed = options.firstSeed;
  const std::vector<ReportPicture> pictures = drawPaperFigures(*result, touch, request.folder);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  ReportOutcome outcome;
  outcome.done = true;
  outcome.page = request.folder / "report.html";
  outcome.csv = request.folder / "errors.csv";
  outcome.summary = "The paper's Table 1 and Figs. 4 to 16, the printed numbers beside ours.";
  outcome.stages = result->stages;
  outcome.stages.add(touch.stages());
  outcome.seconds = run.seconds;
  writeFile(outcome.csv, protocolCsv(*result), true);
  writeFile(outcome.page, paperReportHtml(*result, pictures, run), true);
  return outcome;
}

std::vector<ReportKind> allKinds() {
  std::vector<ReportKind> kinds{
      {"reproduce", "the paper's experiments from nothing, its printed numbers beside ours", reproduce}};
  for (const ReportComputation& computation : reportComputations())
    kinds.push_back(
        {computation.name, computation.what,
         [&computation](const ReportRequest& request, const ReportProgress& progress, std::stop_token stop) {
           return runReport(computation, request, progress, std::move(stop), drawReportChart);
         }});
  return kinds;
}

} // namespace

const std::vector<ReportKind>& reportKinds() {
  static const std::vector<ReportKind> all = allKinds();
  return all;
}

void drawReportChart(const ReportChart& chart, const std::filesystem::path& png) {
  ChartSpec spec;
  spec.title = chart.title;
  spec.xLabel = chart.xLabel;
  spec.yLabel = chart.yLabel;
  spec.logX = chart.logX;
  spec.logY = chart.logY;
  for (const ReportCurve& curve : chart.curves)
    spec.series.push_back({curve.name, curve.x, curve.y, style(curve.style), curve.dashed, -1});
  spec.topLabel = chart.topLabel;
  spec.topTicks = chart.topTicks;
  writePng(drawChart(spec), png);
}

} // namespace palp
