#include "app/gui/network/NetworkTables.h"

#include <QObject>

#include <algorithm>

namespace palp {

namespace {

const QStringList kForceNames{"Fx", "Fy", "Fz"};

QString number(double value) {
  return QString::number(value, 'g', 6);
}

/// Three cells; empty where there are fewer numbers.
void add(QStringList& row, const Eigen::VectorXd& values) {
  for (Eigen::Index k = 0; k < kForceNames.size(); ++k) row << (k < values.size() ? number(values[k]) : QString());
}

void addHeads(QStringList& heads, const QString& what) {
  for (const QString& force : kForceNames) heads << force + " " + what;
}

} // namespace

TableText sweepTable(const std::vector<SweepPoint>& points) {
  TableText table;
  table.heads << QObject::tr("spread");
  addHeads(table.heads, QObject::tr("Eq. (13) [%]"));
  addHeads(table.heads, QObject::tr("RMSE [% of range]"));
  addHeads(table.heads, QObject::tr("leave-one-out [N]"));
  table.heads << QObject::tr("condition") << QObject::tr("ridge") << QObject::tr("training [s]");
  for (const SweepPoint& point : points) {
    QStringList row{number(point.spread)};
    add(row, point.error.eq13Percent);
    add(row, point.error.rmsePercentOfRange);
    add(row, point.report.leaveOneOut);
    row << number(point.report.condition) << number(point.report.ridge) << number(point.report.seconds);
    table.rows.push_back(std::move(row));
  }
  return table;
}

TableText trialsTable(const std::vector<DecoderTrial>& trials) {
  TableText table;
  table.heads << QObject::tr("decoder");
  addHeads(table.heads, QObject::tr("Eq. (13) [%]"));
  addHeads(table.heads, QObject::tr("RMSE [% of range]"));
  table.heads << QObject::tr("training [s]") << QObject::tr("a sample [us]") << QObject::tr("not trained because");
  for (const DecoderTrial& trial : trials) {
    QStringList row{QString::fromStdString(name(trial.kind))};
    const bool there = trial.refusal.isEmpty();
    add(row, trial.error.eq13Percent);
    add(row, trial.error.rmsePercentOfRange);
    row << (there ? number(trial.seconds) : QString()) << (there ? number(trial.microsecondsPerSample) : QString())
        << trial.refusal;
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::optional<double> bestSpread(const std::vector<SweepPoint>& points) {
  const auto best = std::min_element(points.begin(), points.end(), [](const SweepPoint& a, const SweepPoint& b) {
    return a.error.rmsePercentOfRange.norm() < b.error.rmsePercentOfRange.norm();
  });
  return best == points.end() ? std::nullopt : std::optional(best->spread);
}

} // namespace palp
