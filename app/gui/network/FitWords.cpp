#include "app/gui/network/FitWords.h"

#include "app/gui/jobs/TimeLeft.h"

#include <QFileInfo>
#include <QObject>
#include <QStringList>

namespace palp {

namespace {

QString tr(const char* text) {
  return QObject::tr(text);
}

QString trained(const std::string& text) {
  return QString::fromStdString(text);
}

/// As the boxes say it.
QString percent(double share) {
  return QString::number(100 * share, 'g', 3) + " %";
}

/// What was set that otherwise follows from the mode.
QString optionsWords(const NetworkSettings& settings) {
  QString words;
  const auto add = [&words](const QString& what, const QString& value) { words += ", " + what + " " + value; };
  if (settings.solver) add(tr("solver"), trained(name(*settings.solver)));
  if (settings.ridge) add(tr("ridge"), QString::number(*settings.ridge, 'g', 3));
  if (settings.scaling) add(tr("scaler"), trained(name(*settings.scaling)));
  if (settings.tail) add(tr("tail"), trained(kTails.name(*settings.tail)));
  if (settings.convention) add(tr("convention"), trained(name(*settings.convention)));
  if (settings.centerChoice) add(tr("centres by"), trained(kCenterChoices.name(*settings.centerChoice)));
  if (settings.seed != 1) add(tr("seed"), QString::number(settings.seed));
  return words;
}

/// What the network was trained with, and what is set now instead.
QStringList differences(const NetworkSettings& then, const NetworkSettings& now) {
  QStringList all;
  const auto add = [&all](const QString& what, const QString& before, const QString& after) {
    if (before != after) all << tr("%1 %2, now %3").arg(what, before, after);
  };
  const auto spread = [](const NetworkSettings& settings) {
    return settings.automaticSpread ? tr("by leave-one-out") : QString::number(settings.spread, 'g', 4);
  };
  add(tr("input"), trained(name(then.input)), trained(name(now.input)));
  add(tr("row-wires"), trained(then.rows), trained(now.rows));
  add(tr("mode"), trained(name(then.mode)), trained(name(now.mode)));
  add(tr("decoder"), trained(name(then.decoder)), trained(name(now.decoder)));
  add(tr("spread"), spread(then), spread(now));
  add(tr("centres"), QString::number(then.centers), QString::number(now.centers));
  add(tr("noise"), percent(then.noise), percent(now.noise));
  add(tr("noise of the test"), percent(then.testNoise), percent(now.testNoise));
  NetworkSettings rest = now; // what the sentences do not say
  rest.input = then.input;
  rest.rows = then.rows;
  rest.mode = then.mode;
  rest.decoder = then.decoder;
  rest.spread = then.spread;
  rest.automaticSpread = then.automaticSpread;
  rest.centers = then.centers;
  rest.noise = then.noise;
  rest.testNoise = then.testNoise;
  rest.sweepFrom = then.sweepFrom;
  rest.sweepTo = then.sweepTo;
  rest.sweepCount = then.sweepCount;
  if (rest != then) all << tr("other options");
  return all;
}

QString madeWords(const NetworkSamples& samples) {
  QString words;
  if (samples.seconds > 0) words += tr(", made in %1").arg(roughly(samples.seconds));
  if (samples.batchError > 0)
    words += tr("; relative batch error against full Newton %1").arg(samples.batchError, 0, 'g', 2);
  return words;
}

QString openedWords(const NetworkSamples& samples) {
  return tr(" from %1 (%2 an area, seed %3)%4")
      .arg(QFileInfo(samples.file).fileName())
      .arg(samples.settings.perArea)
      .arg(samples.settings.seed)
      .arg(samples.split ? tr("; every fifth one tests, as there is no file of test samples") : QString());
}

} // namespace

QString triple(const Eigen::VectorXd& values, const QString& unit) {
  QStringList texts;
  for (const double value : values) texts << QString::number(value, 'g', 3);
  return texts.join(" / ") + " " + unit;
}

QString originWords(const NetworkFit& fit) {
  QString words = tr("from %1s, row-wires %2, %3, mode %4, spread %5, %6 centres")
                      .arg(trained(name(fit.settings.input)), trained(fit.settings.rows),
                           trained(name(fit.settings.decoder)), trained(name(fit.settings.mode)))
                      .arg(fit.decoder.report.spread, 0, 'g', 4)
                      .arg(fit.decoder.report.centers);
  words += optionsWords(fit.settings);
  if (fit.settings.noise > 0) words += tr(", trained for noise %1").arg(percent(fit.settings.noise));
  if (fit.settings.testNoise > 0)
    words += tr(", tested with noise %1").arg(percent(fit.settings.testNoise));
  else if (fit.settings.noise > 0)
    words += tr(", tested without noise");
  return words;
}

QString staleReason(const NetworkSession& session, const NetworkSettings& now) {
  const NetworkFit* fit = session.fit();
  if (fit == nullptr) return {};
  if (!session.upToDate()) return tr("Of an earlier design: undo the change, or generate samples and train again.");
  if (!session.fitIsCurrent()) return tr("Of other samples than those that are there now: train again.");
  if (!fit->file.isEmpty()) return {};
  const QStringList changes = differences(fit->settings, now);
  return changes.isEmpty() ? QString() : tr("Trained with other settings (%1): train again.").arg(changes.join("; "));
}

QString staleTrialsReason(const NetworkSession& session, const NetworkSettings& now) {
  if (session.trials().empty()) return {};
  if (!session.upToDate()) return tr("The comparison is of an earlier design.");
  NetworkSettings then = session.trialsSettings();
  then.decoder = now.decoder;
  const QStringList changes = differences(then, now);
  return changes.isEmpty() ? QString() : tr("The comparison is of other settings (%1).").arg(changes.join("; "));
}

QString staleSweepReason(const NetworkSession& session, const NetworkSettings& now) {
  if (session.sweepPoints().empty()) return {};
  if (!session.upToDate()) return tr("The sweep is of an earlier design.");
  NetworkSettings then = session.sweepSettings();
  then.spread = now.spread;
  then.automaticSpread = now.automaticSpread;
  const QStringList changes = differences(then, now);
  return changes.isEmpty() ? QString() : tr("The sweep is of other settings (%1).").arg(changes.join("; "));
}

QString trialsWords(const NetworkSession& session, const NetworkSettings& now) {
  const NetworkSettings& then = session.trialsSettings();
  if (session.trials().empty()) return tr("Compare all decoders trains each kind on the same samples.");
  QString words = tr("All from %1s, row-wires %2, noise %3, noise of the test %4.")
                      .arg(trained(name(then.input)), trained(then.rows), percent(then.noise), percent(then.testNoise));
  for (const DecoderTrial& trial : session.trials())
    if (!trial.refusal.isEmpty()) words += tr(" Not trained: %1 (%2).").arg(trained(name(trial.kind)), trial.refusal);
  const QString reason = staleTrialsReason(session, now);
  return reason.isEmpty() ? words : reason + " " + words;
}

QString samplesWords(const NetworkSession& session) {
  const NetworkSamples* samples = session.samples();
  if (samples == nullptr) return tr("None yet for this design.");
  const QString counts = tr("%1 for training, %2 for testing").arg(samples->training.size()).arg(samples->test.size());
  if (!session.upToDate()) return counts + tr(", of an earlier design: undo the change, or generate new ones.");
  return counts + (samples->file.isEmpty() ? madeWords(*samples) : openedWords(*samples)) + ".";
}

bool sweepAndTrialsAgree(const NetworkSession& session) {
  NetworkSettings sweep = session.sweepSettings();
  const NetworkSettings& trials = session.trialsSettings();
  sweep.decoder = trials.decoder;
  sweep.spread = trials.spread;
  sweep.automaticSpread = trials.automaticSpread;
  sweep.sweepFrom = trials.sweepFrom;
  sweep.sweepTo = trials.sweepTo;
  sweep.sweepCount = trials.sweepCount;
  return sweep == trials;
}

QString fitWords(const NetworkSession& session, const NetworkSettings& now) {
  const NetworkFit* fit = session.fit();
  if (fit == nullptr)
    return session.samples() == nullptr ? tr("No network yet: generate samples, then train.")
                                        : tr("No network yet: train one on the samples.");
  const PredictionError& error = fit->error.error;
  const QString name = fit->file.isEmpty() ? tr("Trained here") : tr("Opened: %1").arg(QFileInfo(fit->file).fileName());
  const QString numbers = tr("%1 by Eq. (13), %2 with a floor of 0.05 N, %3 of range (RMSE), %4 on average")
                              .arg(triple(error.eq13Percent, "%"), triple(error.eq13FlooredPercent, "%"),
                                   triple(error.rmsePercentOfRange, "%"), triple(error.meanAbsolute, "N"));
  const QString rest = tr("%1 %2; condition %3, trained in %4 s.")
                           .arg(name.toHtmlEscaped(), originWords(*fit).toHtmlEscaped())
                           .arg(fit->decoder.report.condition, 0, 'g', 2)
                           .arg(fit->decoder.report.seconds, 0, 'g', 2);
  const QString reason = staleReason(session, now);
  if (reason.isEmpty()) return tr("<b>Test error Fx / Fy / Fz, all areas:</b> %1. %2").arg(numbers, rest);
  return QString("<i>%1</i> <font color=\"#808890\">%2</font>")
      .arg(reason.toHtmlEscaped(), tr("Test error Fx / Fy / Fz, all areas: %1. %2").arg(numbers, rest));
}

} // namespace palp
