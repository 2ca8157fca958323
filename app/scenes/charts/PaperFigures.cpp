#include "app/scenes/charts/PaperFigures.h"

#include "app/scenes/block/DeformationPicture.h"
#include "app/scenes/charts/Chart.h"
#include "model/base/Cancelled.h"
#include "model/base/Text.h"

#include <cmath>

namespace palp {

namespace {

constexpr int kTracedArea = 0;
const char* const kForces[3] = {"Fx", "Fy", "Fz"};
using Style = ChartSeries::Style;

/// Writes pictures one by one and remembers them with their captions.
class Album {
public:
  Album(FilesTogether& files, const std::stop_token& stop) : files_(files), stop_(stop) {}

  void add(const Picture& picture, const std::string& file, const std::string& caption, const std::string& section) {
    throwIfStopped(stop_);
    pictures_.push_back({files_.add(file, [&](const auto& png) { writePng(picture, png); }), caption, section});
  }
  [[nodiscard]] const std::vector<ReportPicture>& pictures() const { return pictures_; }

private:
  FilesTogether& files_;
  const std::stop_token& stop_;
  std::vector<ReportPicture> pictures_;
};

void drawDeformations(Album& album, const Touch& touch) {
  const SensorDesign& design = touch.design();
  const NodalFields fields = touch.problem()->fields(touch.solution()->state());
  DeformationState state;
  state.design = &design;
  state.mesh = touch.mesh();
  state.fields = &fields;
  state.electrodes = touch.displacements();
  state.load = &touch.load();
  album.add(
      drawDeformation(state), "fig04_deformation.png",
      "Fig. 4: deformation under (1, 0, -6) N on area 0; displacements drawn enlarged by the factor in the picture",
      "deformation");
  const int centre = centreRowWire(design.rowWires());
  album.add(drawRowWire(design, centre, nullptr), "fig06_row_wire_at_rest.png",
            "Fig. 6: row-wire " + std::to_string(centre) + " with no force", "deformation");
  album.add(drawRowWire(design, centre, touch.displacements()), "fig07_row_wire_loaded.png",
            "Fig. 7: the same row-wire under the force of Fig. 4", "deformation");
}

/// Eq. (13) against spread for one force: every way, the paper's points, the linear baseline.
ChartSpec errorChart(const ProtocolResult& result, const std::string& figure, int force) {
  ChartSpec chart;
  chart.title = std::string(kForces[force]) + (figure == "table1" ? " from deformation" : " from resistance");
  chart.xLabel = "spread (radbas)";
  chart.yLabel = "Eq. (13), mean of the areas [%]";
  chart.logX = chart.logY = true;
  ChartSeries published{"paper, as printed", {}, {}, Style::Points, false, -1};
  std::vector<double> spreads;
  for (const ProtocolCurve& curve : result.curves) {
    if (curve.figure != figure || curve.mode == "linear") continue;
    ChartSeries series{"mode " + curve.mode, {}, {}, Style::LineAndPoints, false, -1};
    for (const ProtocolRow& row : curve.rows) {
      series.x.push_back(*row.spread);
      series.y.push_back(row.eq13Mean_percent()(force));
      if (curve.mode != "default") continue;
      spreads.push_back(*row.spread);
      if (!row.published_percent) continue;
      published.x.push_back(*row.spread);
      published.y.push_back((*row.published_percent)(force));
    }
    chart.series.push_back(std::move(series));
  }
  for (const ProtocolCurve& curve : result.curves)
    if (curve.figure == figure && curve.mode == "linear" && !spreads.empty()) {
      const double error = curve.rows[0].eq13Mean_percent()(force);
      chart.series.push_back(
          {"linear least squares", {spreads.front(), spreads.back()}, {error, error}, Style::Line, true, -1});
    }
  chart.series.push_back(std::move(published));
  return chart;
}

std::vector<double> sampleNumbers(Eigen::Index count) {
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < count; ++i) numbers.push_back(static_cast<double>(i));
  return numbers;
}

std::vector<double> rowOf(const Eigen::Matrix3Xd& matrix, int row) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < matrix.cols(); ++i) values.push_back(matrix(row, i));
  return values;
}

std::vector<const ProtocolTrace*> tracesOf(const ProtocolResult& result, const std::string& figure) {
  std::vector<const ProtocolTrace*> traces;
  for (const ProtocolTrace& trace : result.traces)
    if (trace.figure == figure && trace.area == kTracedArea) traces.push_back(&trace);
  return traces;
}

/// Figs. 8-10 and 13-15: decoupled against true force by sample.
ChartSpec forceChart(const std::vector<const ProtocolTrace*>& traces, int force) {
  ChartSpec chart;
  chart.title = std::string("Decoupled ") + kForces[force];
  chart.xLabel = "test sample of area " + std::to_string(kTracedArea);
  chart.yLabel = std::string(kForces[force]) + " [N]";
  for (const ProtocolTrace* trace : traces) {
    const std::vector<double> numbers = sampleNumbers(trace->true_N.cols());
    if (chart.series.empty())
      chart.series.push_back({"true force", numbers, rowOf(trace->true_N, force), Style::Points, false, -1});
    if (trace->mode == "paper-minmax") continue;
    chart.series.push_back(
        {"mode " + trace->mode, numbers, rowOf(trace->decoupled_N, force), Style::Line, trace->mode == "paper", -1});
  }
  return chart;
}

/// Figs. 11 and 16: relative error by sample, of one mode.
ChartSpec relativeErrorChart(const ProtocolTrace& trace) {
  ChartSpec chart;
  chart.title = "Relative error, mode " + trace.mode;
  chart.xLabel = "test sample of area " + std::to_string(trace.area);
  chart.yLabel = "|F' - F| / |F| [%]";
  chart.logY = true;
  for (int force = 0; force < 3; ++force) {
    const Eigen::VectorXd error =
        100 * ((trace.decoupled_N - trace.true_N).cwiseQuotient(trace.true_N)).row(force).cwiseAbs();
    chart.series.push_back(
        {kForces[force], sampleNumbers(error.size()), {error.begin(), error.end()}, Style::Points, false, -1});
  }
  return chart;
}

void drawFigure(Album& album, const ProtocolResult& result, const std::string& figure) {
  const bool table = figure == "table1";
  for (int force = 0; force < 3; ++force) {
    const std::string name = kForces[force];
    album.add(drawChart(errorChart(result, figure, force)), (table ? "table1_" : "fig12_") + name + ".png",
              (table ? "Table 1 as a chart: error of " : "Fig. 12: error of ") + name + " against spread", figure);
  }
  const std::vector<const ProtocolTrace*> traces = tracesOf(result, figure);
  if (traces.empty()) return;
  const std::string at = " at spread " + text(traces[0]->spread);
  for (int force = 0; force < 3; ++force) {
    const int number = (table ? 8 : 13) + force;
    album.add(drawChart(forceChart(traces, force)),
              "fig" + std::string(number < 10 ? "0" : "") + std::to_string(number) + "_" + kForces[force] + ".png",
              "Fig. " + std::to_string(number) + ": decoupled and true " + kForces[force] + at, figure);
  }
  for (const ProtocolTrace* trace : traces)
    if (trace->mode != "paper-minmax")
      album.add(drawChart(relativeErrorChart(*trace)), std::string(table ? "fig11_" : "fig16_") + trace->mode + ".png",
                std::string(table ? "Fig. 11" : "Fig. 16") + ": relative error by sample, mode " + trace->mode + at,
                figure);
}

} // namespace

LoadCase paperFigureLoad() {
  LoadCase load;
  load.areas.push_back({0, {1, 0, -6}});
  return load;
}

std::vector<ReportPicture> drawPaperFigures(const ProtocolResult& result, const Touch& touch, FilesTogether& files,
                                            const std::stop_token& stop) {
  Album album(files, stop);
  drawDeformations(album, touch);
  for (const char* figure : {"table1", "fig12"})
    for (const ProtocolCurve& curve : result.curves)
      if (curve.figure == figure) {
        drawFigure(album, result, figure);
        break;
      }
  return album.pictures();
}

} // namespace palp
