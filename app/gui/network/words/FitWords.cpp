#include "app/gui/network/words/FitWords.h"

#include "app/gui/network/NetworkTables.h"
#include "app/gui/network/words/ErrorWords.h"
#include "app/gui/project/changes/NetworkChange.h"
#include "app/gui/project/changes/ProjectChange.h"

#include <QFileInfo>
#include <QObject>
#include <QStringList>

#include <cmath>

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

/// What was not set of a network that was trained here; empty where its decoder has none of it.
QString systemWords(const NetworkFit& fit) {
  if (!fit.file.isEmpty() || fit.settings.decoder != DecoderKind::Rbf) return {};
  const RbfOptions used = rbfOptions(fit.settings.trainOptions(), fit.decoder.report.centers);
  QStringList words;
  if (!fit.settings.scaling) words << tr("scaler %1").arg(trained(name(used.scaling)));
  if (!fit.settings.tail) words << tr("tail %1").arg(trained(kTails.name(used.tail)));
  if (!fit.settings.solver) words << tr("solver %1").arg(trained(name(used.method)));
  return words.isEmpty() ? QString() : tr("; from the mode: %1").arg(words.join(", "));
}

void addChange(QStringList& all, const QString& what, const QString& before, const QString& after) {
  if (before != after) all << tr("%1 %2, now %3").arg(what, before, after);
}

/// What the network was trained with, and what is set now instead.
QStringList differences(const NetworkSettings& then, const NetworkSettings& now) {
  QStringList all;
  const auto add = [&all](const QString& what, const QString& before, const QString& after) {
    addChange(all, what, before, after);
  };
  const auto spread = [](const NetworkSettings& settings) {
    return settings.automaticSpread ? tr("by leave-one-out") : QString::number(settings.chosenSpread, 'g', 4);
  };
  for (const TrainOption& option : trainOptionTable())
    add(QString::fromStdString(option.label), optionWords(option, then), optionWords(option, now));
  add(tr("spread"), spread(then), spread(now));
  add(tr("test noise"), percent(then.testNoise), percent(now.testNoise));
  return all;
}

} // namespace

QString triple(const Eigen::VectorXd& values, const QString& unit) {
  QStringList texts;
  for (const double value : values) texts << (std::isnan(value) ? QString("-") : QString::number(value, 'g', 3));
  return texts.join(" / ") + " " + unit;
}

QString optionsWords(const NetworkSettings& settings) {
  QStringList words;
  for (const TrainOption& option : trainOptionTable()) {
    const bool apart = option.name == "ridge" || option.name == "scaler" || option.name == "seed";
    if (option.inForm && !apart && option.isSet(settings))
      words << QString::fromStdString(option.label) + " " + optionWords(option, settings);
  }
  if (settings.allCenters) words << tr("a centre on every sample");
  return words.join(", ");
}

QString ridgeWords(const NetworkFit& fit) {
  const double ridge = fit.decoder.report.ridge;
  const bool chosen = fit.file.isEmpty() && !fit.settings.ridge && ridge > 0;
  return QString::number(ridge, 'g', 3) + (chosen ? tr(" (by leave-one-out)") : QString());
}

QString scalerWords(const NetworkFit& fit) {
  if (fit.settings.scaling) return trained(name(*fit.settings.scaling));
  if (!fit.file.isEmpty() || fit.settings.decoder != DecoderKind::Rbf) return "-";
  return trained(name(rbfOptions(fit.settings.trainOptions(), fit.decoder.report.centers).scaling));
}

QString originWords(const NetworkFit& fit) {
  QString words = tr("from %1s, row-wires %2, %3, mode %4")
                      .arg(trained(name(fit.settings.input)), trained(fit.settings.rows),
                           trained(name(fit.settings.decoder)), trained(name(fit.settings.mode)));
  if (fit.decoder.report.spread > 0) words += tr(", spread %1").arg(fit.decoder.report.spread, 0, 'g', 4);
  if (fit.decoder.report.centers > 0) words += tr(", %1 centres").arg(fit.decoder.report.centers);
  if (traits(fit.settings.decoder).hasRidge) words += tr(", ridge %1").arg(ridgeWords(fit));
  if (fit.settings.scaling) words += tr(", scaler %1").arg(trained(name(*fit.settings.scaling)));
  const QString options = optionsWords(fit.settings);
  if (!options.isEmpty()) words += ", " + options;
  if (fit.settings.seed != 1) words += tr(", seed %1").arg(fit.settings.seed);
  const auto noise = [](double share) {
    return share > 0 ? tr("for noise %1").arg(percent(share)) : tr("without noise");
  };
  words += tr(", trained %1").arg(noise(fit.settings.noise));
  if (fit.settings.target == DecoderTarget::ForceAndPlace) words += tr(", for force and position");
  words += fit.settings.testNoise > 0 ? tr(", tested with noise %1").arg(percent(fit.settings.testNoise))
                                      : tr(", tested without noise");
  return words;
}

/// "an earlier design", and what has changed of it since.
QString earlierDesign(const NetworkSession& session) {
  Project then, now;
  then.design = session.results().design;
  now.design = session.design();
  const QString since = sinceWords(then, now);
  return since.isEmpty() ? tr("an earlier design") : tr("an earlier design (%1)").arg(since);
}

QString staleReason(const NetworkSession& session, const NetworkSettings& now) {
  const NetworkFit* fit = session.fit();
  if (fit == nullptr) return {};
  if (!session.upToDate())
    return tr("For %1: undo the change, or generate samples and train again.").arg(earlierDesign(session));
  if (!session.fitIsCurrent()) return tr("For other samples than the present ones: train again.");
  if (!fit->file.isEmpty()) return {};
  const QStringList changes = differences(fit->settings, now);
  return changes.isEmpty()
             ? QString()
             : tr("Trained with other settings (%1): train again, or restore a network under Trained networks.")
                   .arg(changes.join("; "));
}

QString staleTrialsReason(const NetworkSession& session, const NetworkSettings& now) {
  if (session.trials().empty()) return {};
  if (!session.upToDate()) return tr("The comparison belongs to %1.").arg(earlierDesign(session));
  NetworkSettings then = session.trialsSettings();
  then.decoder = now.decoder;
  const QStringList changes = differences(then, now);
  return changes.isEmpty() ? QString() : tr("The comparison belongs to other settings (%1).").arg(changes.join("; "));
}

QString staleSweepReason(const NetworkSession& session, const NetworkSettings& now) {
  if (session.sweepPoints().empty()) return {};
  if (!session.upToDate()) return tr("The sweep belongs to %1.").arg(earlierDesign(session));
  NetworkSettings then = session.sweepSettings();
  then.chosenSpread = now.chosenSpread;
  then.automaticSpread = now.automaticSpread;
  const QStringList changes = differences(then, now);
  return changes.isEmpty() ? QString() : tr("The sweep belongs to other settings (%1).").arg(changes.join("; "));
}

QString staleListReason(const NetworkSession& session) {
  if (session.kept().empty() || session.upToDate()) return {};
  return tr("The networks belong to %1.").arg(earlierDesign(session));
}

QString trialsWords(const NetworkSession& session, const NetworkSettings& now) {
  const NetworkSettings& then = session.trialsSettings();
  if (session.trials().empty()) return tr("Compare all decoders trains each kind on the same samples.");
  QString words = tr("All from %1s, row-wires %2, noise %3, test noise %4.")
                      .arg(trained(name(then.input)), trained(then.rows), percent(then.noise), percent(then.testNoise));
  if (const auto best = bestTrial(session.trials())) {
    const DecoderTrial& trial = session.trials()[*best];
    const auto place = bestPlace(session.trials());
    words +=
        (place ? tr(" Smallest error of the force: %1, %2 of range (RMSE)")
               : tr(" Smallest error: %1, %2 of range (RMSE)"))
            .arg(trained(name(trial.kind)), triple(ofForces(trial.error.rmsePercentOfRange, session.samples()), "%"));
    std::vector<DecoderTrial> others = session.trials();
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(*best));
    if (const auto next = bestTrial(others))
      words += tr("; next %1, %2")
                   .arg(trained(name(others[*next].kind)),
                        triple(ofForces(others[*next].error.rmsePercentOfRange, session.samples()), "%"));
    words += ".";
    if (place)
      words += tr(" Smallest error of the position: %1, %2 mm in the median.")
                   .arg(trained(name(session.trials()[*place].kind)))
                   .arg(session.trials()[*place].place->median_mm, 0, 'g', 3);
  }
  for (const DecoderTrial& trial : session.trials())
    if (!trial.refusal.isEmpty()) words += tr(" Not trained: %1 (%2).").arg(trained(name(trial.kind)), trial.refusal);
  const QString reason = staleTrialsReason(session, now);
  return reason.isEmpty() ? words : reason + " " + words;
}

bool sweepAndTrialsAgree(const NetworkSession& session) {
  NetworkSettings sweep = session.sweepSettings();
  const NetworkSettings& trials = session.trialsSettings();
  sweep.decoder = trials.decoder;
  sweep.chosenSpread = trials.chosenSpread;
  sweep.automaticSpread = trials.automaticSpread;
  sweep.sweepFrom = trials.sweepFrom;
  sweep.sweepTo = trials.sweepTo;
  sweep.sweepCount = trials.sweepCount;
  return sweep == trials;
}

QString fitWords(const NetworkSession& session, const NetworkSettings& now, const NoiseBound* bound,
                 const SampleBounds* touches) {
  const NetworkFit* fit = session.fit();
  if (fit == nullptr && session.openingResults()) return tr("The networks of the project are being opened.");
  if (fit == nullptr)
    return session.samples() == nullptr ? tr("No network yet: generate or open samples, then train.")
           : session.kept().empty()
               ? tr("No network for these samples yet: train one.")
               : tr("No network for these samples yet: train one, or restore one under Trained networks.");
  QString name = fit->file.isEmpty() ? tr("Trained here") : tr("Opened: %1").arg(QFileInfo(fit->file).fileName());
  if (fit->file.isEmpty() && session.samples() != nullptr && fit->madeFrom != session.samples()->settings)
    name += tr(" on other samples (%1, seed %2)").arg(countWords(fit->madeFrom)).arg(fit->madeFrom.seed);
  if (!fit->name.isEmpty()) name = "\"" + fit->name + "\": " + name;
  const double condition = fit->decoder.report.condition; // 0: it solved no such system
  const QString rest = tr("%1 %2%3; %4trained in %5 s.%6%7%8")
                           .arg(name.toHtmlEscaped(), originWords(*fit).toHtmlEscaped(), systemWords(*fit))
                           .arg(condition > 0 ? tr("condition %1, ").arg(condition, 0, 'g', 2) : QString())
                           .arg(fit->decoder.report.seconds, 0, 'g', 2)
                           .arg(placeWords(*fit) + boundWords(session, *fit, touches), scatterWords(session, *fit),
                                adviceWords(session, *fit));
  const QString reason = staleReason(session, now);
  const bool current = reason.isEmpty();
  const bool ofTouches = session.samples() != nullptr && session.samples()->test.hasTouches();
  const QString title = ofTouches ? tr("Test error, all touches") : tr("Test error, all areas");
  const QString errors = errorTable(session, *fit, bound, current ? "<b>" + title + "</b>" : title);
  const QString words = "<div>" + (current ? rest : "<i>" + reason.toHtmlEscaped() + "</i> " + rest) + "</div>";
  const QString warnings = guessWords(session, *fit) + warningWords(*fit);
  if (current) return errors + warnings + words; // what is wrong is seen first
  return "<div style=\"color: #808890\">" + errors + words + "</div>" + warnings;
}

} // namespace palp
