#include "app/gui/touch/ResistanceWords.h"

#include "app/study/reports/readout/CurrentPaths.h"

#include <QObject>

namespace palp {

namespace {

constexpr int kMarkColor = 3;

QString signedText(double value) {
  return (value > 0 ? "+" : "") + QString::number(value, 'g', 4);
}

/// d ln R of all readings.
Eigen::VectorXd logChanges(const TouchResistances& resistances) {
  return (resistances.now_ohm.array() / resistances.rest_ohm.array()).log().matrix().reshaped();
}

} // namespace

ChartSpec curveChart(const HeatmapSpec& heatmap, const std::string& title, const std::string& xLabel,
                     const Eigen::VectorXd& values, int color, int cell) {
  ChartSpec spec;
  spec.title = title;
  spec.xLabel = xLabel;
  spec.yLabel = heatmap.colors.title();
  ChartSeries curve;
  curve.style = ChartSeries::Style::LineAndPoints;
  curve.color = color;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    curve.x.push_back(static_cast<double>(k));
    curve.y.push_back(values[k]);
  }
  ChartSeries mark;
  mark.style = ChartSeries::Style::Points;
  mark.color = kMarkColor;
  mark.x = {static_cast<double>(cell)};
  mark.y = {values[cell]};
  spec.series = {curve, mark};
  return spec;
}

QString lawsWords(const TouchResistances& field, const TouchResistances& pairs) {
  const Eigen::VectorXd a = logChanges(field), b = logChanges(pairs);
  if (!(a.norm() > 0 && b.norm() > 0)) return QObject::tr("No resistance changes.");
  return QObject::tr("Compared with Eq. (1), over all readings: changes of ln R are %1 times as large, correlation %2. "
                     "The rubber's conductivity is isotropic, also where it is deformed.")
      .arg(QString::number(a.norm() / b.norm(), 'g', 3), QString::number(a.dot(b) / (a.norm() * b.norm()), 'f', 2));
}

QString cellWords(const TouchResistances& resistances, const std::array<int, 2>& cell) {
  const auto [row, column] = cell;
  const double rest = resistances.rest_ohm(row, column), now = resistances.now_ohm(row, column);
  return QObject::tr("Row-wire %1, column-wire %2: R = %3 ohm at rest, %4 ohm under the load (%5 ohm, %6 %)")
      .arg(row)
      .arg(column)
      .arg(QString::number(rest, 'g', 6), QString::number(now, 'g', 6), signedText(now - rest),
           signedText(100 * (now - rest) / rest));
}

QString cellNumbers(const TouchResistances& resistances, const std::array<int, 2>& cell) {
  const auto [row, column] = cell;
  if (row >= resistances.rest_ohm.rows() || column >= resistances.rest_ohm.cols()) return {}; // of the design before
  return QObject::tr("R = %1 ohm at rest, %2 ohm under the load")
      .arg(QString::number(resistances.rest_ohm(row, column), 'g', 6),
           QString::number(resistances.now_ohm(row, column), 'g', 6));
}

QString pathWords(const TerminalNetwork& network, Readout readout, const std::array<int, 2>& cell) {
  const CurrentPaths paths = currentPaths(network, NetworkReading(network, readout), cell[0], cell[1]);
  return QObject::tr("%2 % of the current from row-wire %1 flows directly through the rubber to column-wire %3; per "
                     "ampere, %4 A pass through the metal of other wires.")
      .arg(cell[0])
      .arg(QString::number(100 * paths.straight, 'f', 1))
      .arg(cell[1])
      .arg(QString::number(paths.metal, 'f', 2));
}

} // namespace palp
