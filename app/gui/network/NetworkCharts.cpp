#include "app/gui/network/NetworkCharts.h"

#include "app/gui/views/ChartView.h"
#include "app/study/paper/PublishedNumbers.h"
#include "model/base/NumberText.h"

#include <QObject>

#include <algorithm>

#include <array>
#include <cmath>

namespace palp {

namespace {

using Style = ChartSeries::Style;
constexpr std::array<const char*, 3> kForces{"Fx", "Fy", "Fz"};

ChartSeries series(std::string name, Style style, int color, bool dashed = false) {
  ChartSeries made;
  made.name = std::move(name);
  made.style = style;
  made.color = color;
  made.dashed = dashed;
  return made;
}

ChartSpec againstSpread(const std::string& title, const std::string& yLabel) {
  ChartSpec spec;
  spec.title = title;
  spec.xLabel = "spread (radbas, of scaled inputs)";
  spec.yLabel = yLabel;
  spec.logX = spec.logY = true;
  return spec;
}

ChartSpec errorAgainstTime() {
  ChartSpec spec;
  spec.title = "Error against training time";
  spec.xLabel = "training time [s]";
  spec.yLabel = "mean, Eq. (13) [%]"; // of Fx, Fy and Fz; the chart is low
  spec.logX = spec.logY = true;
  return spec;
}

std::vector<PublishedPoint> printed(InputKind input) {
  return publishedPoints(input == InputKind::Displacement ? "table1" : "fig12");
}

/// A line up and down at the paper's spread, as high as the paper's points.
ChartSeries paperLine(InputKind input) {
  const double spread = paperSpread(input);
  ChartSeries line =
      series("the paper's spread with the smallest error, " + withDigits(spread, 6), Style::Line, 6, true);
  double low = 1e300, high = 0;
  for (const PublishedPoint& point : printed(input)) {
    low = std::min(low, point.error_percent.minCoeff());
    high = std::max(high, point.error_percent.maxCoeff());
  }
  line.x = {spread, spread};
  line.y = {low, high};
  return line;
}

/// Of Fx, Fy and Fz, but for those that are not in the samples: the relative error of no force is 0, or is none.
double meanError(const PredictionError& error) {
  double sum = 0;
  int forces = 0;
  for (const double percent : error.eq13Percent) {
    if (!std::isfinite(percent) || percent == 0) continue;
    sum += percent;
    ++forces;
  }
  return forces > 0 ? sum / forces : 0;
}

/// One curve a force of a quantity of the sweep.
template <class Value>
void addCurves(ChartSpec& spec, const std::vector<SweepPoint>& points, const std::string& words, Value value) {
  for (int d = 0; d < 3; ++d) {
    ChartSeries curve = series(std::string(kForces[static_cast<std::size_t>(d)]) + words, Style::LineAndPoints, d);
    for (const SweepPoint& point : points) {
      const Eigen::VectorXd& values = value(point);
      if (d >= values.size()) continue;
      curve.x.push_back(point.spread);
      curve.y.push_back(values[d]);
    }
    spec.series.push_back(std::move(curve));
  }
}

} // namespace

ChartView* networkChart(const char* name) {
  auto* view = new ChartView;
  view->setObjectName(name);
  view->setToolTip(QObject::tr("Right click to copy or save the chart as a picture or as points; File, Export all "
                               "charts and tables saves every chart."));
  return view;
}

double paperSpread(InputKind input) {
  const std::vector<PublishedPoint> points = printed(input);
  return std::min_element(points.begin(), points.end(),
                          [](const PublishedPoint& a, const PublishedPoint& b) {
                            return a.error_percent.norm() < b.error_percent.norm();
                          })
      ->spread;
}

ChartSpec sweepErrorChart(const std::vector<SweepPoint>& points, const NetworkFit* fit, InputKind input) {
  const bool displacement = input == InputKind::Displacement;
  ChartSpec spec =
      againstSpread(displacement ? "Test error from displacements (Table 1)" : "Test error from resistances (Fig. 12)",
                    "relative error, Eq. (13) [%]");
  addCurves(spec, points, "",
            [](const SweepPoint& point) -> const Eigen::VectorXd& { return point.error.eq13Percent; });
  for (int d = 0; d < 3; ++d) {
    ChartSeries paper =
        series(std::string(kForces[static_cast<std::size_t>(d)]) + ", printed by the paper", Style::Points, d);
    for (const PublishedPoint& point : printed(input)) {
      paper.x.push_back(point.spread);
      paper.y.push_back(point.error_percent[d]);
    }
    if (!points.empty()) paper.legend = d == 0 ? "squares: printed by the paper" : ""; // the curves tell the colours
    spec.series.push_back(std::move(paper));
  }
  if (fit != nullptr && fit->settings.input == input) {
    const Eigen::VectorXd& errors = fit->error.error.eq13Percent;
    bool said = false; // by the first that the logarithmic axis shows
    for (int d = 0; d < std::min<int>(3, static_cast<int>(errors.size())); ++d) {
      if (!(errors[d] > 0 && std::isfinite(errors[d]))) continue;
      ChartSeries now =
          series(std::string(kForces[static_cast<std::size_t>(d)]) + ", trained now", Style::Points, d, true);
      now.x = {fit->decoder.report.spread};
      now.y = {errors[d]};
      now.legend = said ? "" : "diamonds: trained now";
      said = true;
      spec.series.push_back(std::move(now));
    }
  }
  spec.series.push_back(paperLine(input));
  return spec;
}

ChartSpec sweepLeaveOneOutChart(const std::vector<SweepPoint>& points) {
  ChartSpec spec = againstSpread("Leave-one-out error", "root mean square [N]");
  addCurves(spec, points, "",
            [](const SweepPoint& point) -> const Eigen::VectorXd& { return point.report.leaveOneOut; });
  return spec;
}

ChartSpec sweepConditionChart(const std::vector<SweepPoint>& points) {
  ChartSpec spec = againstSpread("Condition of the system", "condition number");
  ChartSeries curve = series("", Style::LineAndPoints, 0);
  for (const SweepPoint& point : points) {
    curve.x.push_back(point.spread);
    curve.y.push_back(point.report.condition);
  }
  spec.series.push_back(std::move(curve));
  return spec;
}

ChartSpec errorTimeChart(const std::vector<SweepPoint>& points) {
  ChartSpec spec = errorAgainstTime();
  ChartSeries cloud = series("", Style::Points, 0);
  for (const SweepPoint& point : points) {
    cloud.x.push_back(point.report.seconds);
    cloud.y.push_back(meanError(point.error));
  }
  spec.series.push_back(std::move(cloud));
  return spec;
}

namespace {

/// Which test samples a chart draws; touches lie in an area.
std::string ofArea(const NetworkSamples& samples, int area) {
  return (samples.test.hasTouches() ? ", touches in area " : ", area ") + std::to_string(area);
}

} // namespace

ChartSpec decoupledChart(const NetworkSamples& samples, const NetworkFit& fit, int direction, int area) {
  const std::string force = kForces[static_cast<std::size_t>(direction)];
  ChartSpec spec;
  spec.title = "Decoded against true " + force + ofArea(samples, area);
  spec.xLabel = "true " + force + " [N]";
  spec.yLabel = "decoded " + force + " [N]";
  ChartSeries exact = series("exact", Style::Line, 6, true);
  ChartSeries cloud = series("test samples", Style::Points, direction);
  for (Eigen::Index k = 0; k < samples.test.size(); ++k) {
    if (samples.test.area[k] != area) continue;
    cloud.x.push_back(samples.test.forces_N(direction, k));
    cloud.y.push_back(fit.prediction.forces_N(direction, k));
  }
  exact.x =
      exact.y = {samples.test.forces_N.row(direction).minCoeff(), samples.test.forces_N.row(direction).maxCoeff()};
  spec.series = {exact, cloud};
  return spec;
}

ChartSpec relativeErrorChart(const NetworkSamples& samples, const NetworkFit& fit, int area) {
  ChartSpec spec;
  spec.title = "Relative error by sample" + ofArea(samples, area);
  spec.xLabel = "test sample";
  spec.yLabel = "|F' - F| / |F| [%]";
  spec.logY = true;
  for (int d = 0; d < 3; ++d) {
    ChartSeries curve = series(kForces[static_cast<std::size_t>(d)], Style::LineAndPoints, d);
    for (Eigen::Index k = 0; k < samples.test.size(); ++k) {
      if (samples.test.area[k] != area) continue;
      const double truth = samples.test.forces_N(d, k);
      curve.x.push_back(static_cast<double>(curve.x.size()));
      curve.y.push_back(100 * std::abs((fit.prediction.forces_N(d, k) - truth) / truth));
    }
    spec.series.push_back(std::move(curve));
  }
  return spec;
}

ChartSpec placeErrorChart(const NetworkSamples& samples, const NetworkFit& fit) {
  ChartSpec spec;
  spec.title = "Error of the position, all test samples";
  spec.xLabel = "along x [mm]";
  spec.yLabel = "along y [mm]";
  ChartSeries cloud = series("test samples", Style::Points, 0);
  const Eigen::Matrix2Xd off_mm = fit.prediction.places_mm - samples.test.touchedPlaces_mm();
  for (const auto& off : off_mm.colwise()) {
    cloud.x.push_back(off.x());
    cloud.y.push_back(off.y());
  }
  spec.series = {cloud};
  return spec;
}

namespace {

/// Decoders keep their colour and dash on both charts.
ChartSeries trialSeries(const DecoderTrial& trial, std::size_t place, Style style) {
  ChartSeries made = series(name(trial.kind), style, static_cast<int>(place % 7));
  made.dashed = place >= 7;
  return made;
}

} // namespace

ChartSpec trialsErrorChart(const std::vector<DecoderTrial>& trials, const std::vector<SweepPoint>& sweep,
                           InputKind input) {
  ChartSpec spec = againstSpread(input == InputKind::Displacement ? "All decoders, from displacements"
                                                                  : "All decoders, from resistances",
                                 "mean of Fx, Fy, Fz, Eq. (13) [%]");
  ChartSeries curve = series("rbf, swept", Style::LineAndPoints, 0); // in the colour of rbf, the first of them
  for (const SweepPoint& point : sweep) {
    curve.x.push_back(point.spread);
    curve.y.push_back(meanError(point.error));
  }
  double from = sweep.empty() ? 0.3 : sweep.front().spread;
  double to = sweep.empty() ? 10 : sweep.back().spread;
  for (const DecoderTrial& trial : trials) { // a point far from the others is not cut off
    if (!trial.refusal.isEmpty() || trial.spread <= 0) continue;
    from = std::min(from, trial.spread);
    to = std::max(to, trial.spread);
  }
  std::size_t place = 0;
  for (const DecoderTrial& trial : trials) {
    if (!trial.refusal.isEmpty()) continue;
    const bool point = trial.spread > 0;
    ChartSeries level = trialSeries(trial, place++, point ? Style::Points : Style::Line);
    level.x = point ? std::vector<double>{trial.spread} : std::vector<double>{from, to};
    level.y.assign(level.x.size(), meanError(trial.error));
    level.level = !point;
    spec.series.push_back(std::move(level));
  }
  if (!curve.x.empty()) spec.series.push_back(std::move(curve));
  return spec;
}

ChartSpec trialsTimeChart(const std::vector<DecoderTrial>& trials) {
  ChartSpec spec = errorAgainstTime();
  std::size_t place = 0;
  for (const DecoderTrial& trial : trials) {
    if (!trial.refusal.isEmpty()) continue;
    ChartSeries point = trialSeries(trial, place++, Style::Points);
    point.x = {trial.seconds};
    point.y = {meanError(trial.error)};
    spec.series.push_back(std::move(point));
  }
  return spec;
}

} // namespace palp
