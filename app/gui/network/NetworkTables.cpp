#include "app/gui/network/NetworkTables.h"

#include "app/gui/network/words/ErrorWords.h"
#include "app/gui/network/words/FitWords.h"

#include <QFileInfo>
#include <QObject>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

const QStringList kForceNames{"Fx", "Fy", "Fz"};

/// "-": undefined, as for a force that is 0 in all samples.
QString number(double value) {
  return std::isnan(value) ? QString("-") : QString::number(value, 'g', 6);
}

/// Three cells; empty where there are fewer numbers.
void add(QStringList& row, const Eigen::VectorXd& values) {
  for (Eigen::Index k = 0; k < kForceNames.size(); ++k) row << (k < values.size() ? number(values[k]) : QString());
}

void addHeads(QStringList& heads, const QString& what) {
  for (const QString& force : kForceNames) heads << force + " " + what;
}

} // namespace

TableText sweepTable(const std::vector<SweepPoint>& points, const NetworkSamples* samples) {
  TableText table;
  table.heads << QObject::tr("spread");
  addHeads(table.heads, QObject::tr("Eq. (13) [%]"));
  addHeads(table.heads, QObject::tr("RMSE [% of range]"));
  addHeads(table.heads, QObject::tr("leave-one-out [N]"));
  table.heads << QObject::tr("condition") << QObject::tr("ridge") << QObject::tr("training [s]");
  for (const SweepPoint& point : points) {
    QStringList row{number(point.spread)};
    add(row, ofForces(point.error.eq13Percent, samples));
    add(row, ofForces(point.error.rmsePercentOfRange, samples));
    add(row, ofForces(point.report.leaveOneOut, samples));
    row << number(point.report.condition) << number(point.report.ridge) << number(point.report.seconds);
    table.rows.push_back(std::move(row));
  }
  return table;
}

TableText trialsTable(const std::vector<DecoderTrial>& trials, const NoiseBound* bound, const NetworkSamples* samples) {
  TableText table;
  const Eigen::Index testSamples = samples != nullptr ? samples->test.size() : 0;
  table.heads << QObject::tr("decoder");
  addHeads(table.heads, QObject::tr("RMSE [% of range]"));
  addHeads(table.heads, QObject::tr("Eq. (13) [%]"));
  const bool places = std::any_of(trials.begin(), trials.end(), [](const auto& trial) { return trial.place; });
  if (places) table.heads << QObject::tr("position, median [mm]");
  table.heads << QObject::tr("training [s]") << QObject::tr("time per sample [us]")
              << QObject::tr("not trained because") << QObject::tr("description");
  for (const DecoderTrial& trial : trials) {
    QStringList row{QString::fromStdString(name(trial.kind))};
    const bool there = trial.refusal.isEmpty();
    add(row, ofForces(trial.error.rmsePercentOfRange, samples));
    add(row, ofForces(trial.error.eq13Percent, samples));
    if (places) row << (trial.place ? number(trial.place->median_mm) : QString());
    row << (there ? number(trial.seconds) : QString()) << (there ? number(trial.microsecondsPerSample) : QString())
        << trial.refusal << QString(traits(trial.kind).description);
    table.rows.push_back(std::move(row));
  }
  if (bound == nullptr || trials.empty() || testSamples == 0) return table;
  // The root mean square of n errors scatters by 1 / sqrt(2 n) of itself.
  QStringList row{QObject::tr("bound")};
  add(row, bound->withPriorPercent);
  add(row, {});
  row << QString() << QString() << QString()
      << QObject::tr("Cramer-Rao, loaded area known, with prior: the best linear estimate; a method that uses the "
                     "range's limits can be up to 5 % better, and %2 test samples add a scatter of %1 %")
             .arg(100 / std::sqrt(2.0 * static_cast<double>(testSamples)), 0, 'g', 2)
             .arg(testSamples);
  table.rows.push_back(row);
  return table;
}

TableText networksTable(const std::vector<std::shared_ptr<const NetworkFit>>& networks) {
  TableText table;
  table.heads << QObject::tr("name");
  addHeads(table.heads, QObject::tr("[%]"));
  const bool places =
      std::any_of(networks.begin(), networks.end(), [](const auto& fit) { return fit->error.place.has_value(); });
  if (places) table.heads << QObject::tr("position, median [mm]");
  table.heads << QObject::tr("samples") << QObject::tr("when") << QObject::tr("input") << QObject::tr("row-wires")
              << QObject::tr("decoder") << QObject::tr("noise [%]") << QObject::tr("test noise [%]")
              << QObject::tr("spread") << QObject::tr("centres") << QObject::tr("ridge") << QObject::tr("scaler")
              << QObject::tr("seed") << QObject::tr("mode") << QObject::tr("other options") << QObject::tr("file");
  const auto text = [](const std::string& words) { return QString::fromStdString(words); };
  const auto used = [](double value) { return value > 0 ? QString::number(value, 'g', 4) : QString("-"); };
  for (const auto& fit : networks) {
    const NetworkSettings& settings = fit->settings;
    QStringList row{fit->name};
    for (const double error : ofForces(fit->error.error.rmsePercentOfRange, fit->decoder))
      row << (std::isfinite(error) ? QString::number(error, 'g', 4) : QString("-"));
    if (places) row << (fit->error.place ? QString::number(fit->error.place->median_mm, 'g', 4) : QString("-"));
    row << QObject::tr("%1, seed %2").arg(countWords(fit->madeFrom)).arg(fit->madeFrom.seed)
        << fit->made.toString("yyyy-MM-dd HH:mm:ss") << text(name(settings.input)) << text(settings.rows)
        << text(name(settings.decoder)) << QString::number(100 * settings.noise, 'g', 4)
        << QString::number(100 * settings.testNoise, 'g', 4) << used(fit->decoder.report.spread)
        << used(fit->decoder.report.centers) << (traits(settings.decoder).hasRidge ? ridgeWords(*fit) : QString("-"))
        << scalerWords(*fit) << QString::number(settings.seed) << text(name(settings.mode)) << optionsWords(settings)
        << QFileInfo(fit->file).fileName();
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::optional<std::size_t> bestTrial(const std::vector<DecoderTrial>& trials) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < trials.size(); ++k)
    if (trials[k].refusal.isEmpty() &&
        (!best || trials[k].error.rmsePercentOfRange.norm() < trials[*best].error.rmsePercentOfRange.norm()))
      best = k;
  return best;
}

std::optional<std::size_t> bestPlace(const std::vector<DecoderTrial>& trials) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < trials.size(); ++k)
    if (trials[k].place && (!best || trials[k].place->median_mm < trials[*best].place->median_mm)) best = k;
  return best;
}

std::optional<std::size_t> bestPoint(const std::vector<SweepPoint>& points) {
  const auto best = std::min_element(points.begin(), points.end(), [](const SweepPoint& a, const SweepPoint& b) {
    return a.error.rmsePercentOfRange.norm() < b.error.rmsePercentOfRange.norm();
  });
  if (best == points.end()) return std::nullopt;
  return static_cast<std::size_t>(best - points.begin());
}

} // namespace palp
