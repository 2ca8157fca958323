#include "app/gui/network/NetworkCharts.h"

#include "app/study/paper/PublishedNumbers.h"

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
  spec.yLabel = "mean of Fx, Fy, Fz, Eq. (13) [%]";
  spec.logX = spec.logY = true;
  return spec;
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
    for (const PublishedPoint& point : publishedPoints(displacement ? "table1" : "fig12")) {
      paper.x.push_back(point.spread);
      paper.y.push_back(point.error_percent[d]);
    }
    spec.series.push_back(std::move(paper));
  }
  if (fit != nullptr && fit->settings.input == input) {
    ChartSeries now = series("trained now", Style::Points, 6);
    for (Eigen::Index d = 0; d < fit->error.error.eq13Percent.size(); ++d) {
      now.x.push_back(fit->decoder.report.spread);
      now.y.push_back(fit->error.error.eq13Percent[d]);
    }
    spec.series.push_back(std::move(now));
  }
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
    cloud.y.push_back(point.error.eq13Percent.mean());
  }
  spec.series.push_back(std::move(cloud));
  return spec;
}

ChartSpec decoupledChart(const NetworkSamples& samples, const NetworkFit& fit, int direction, int area) {
  const std::string force = kForces[static_cast<std::size_t>(direction)];
  ChartSpec spec;
  spec.title = "Decoupled against true " + force + ", area " + std::to_string(area);
  spec.xLabel = "true " + force + " [N]";
  spec.yLabel = "decoupled " + force + " [N]";
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
  spec.title = "Relative error by sample, area " + std::to_string(area);
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
    curve.y.push_back(point.error.eq13Percent.mean());
  }
  const double from = sweep.empty() ? 0.3 : sweep.front().spread;
  const double to = sweep.empty() ? 10 : sweep.back().spread;
  std::size_t place = 0;
  for (const DecoderTrial& trial : trials) {
    if (!trial.refusal.isEmpty()) continue;
    ChartSeries level = trialSeries(trial, place++, Style::Line);
    level.x = {from, to};
    level.y.assign(2, trial.error.eq13Percent.mean());
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
    point.y = {trial.error.eq13Percent.mean()};
    spec.series.push_back(std::move(point));
  }
  return spec;
}

} // namespace palp
