#include "app/gui/network/NetworkSource.h"

#include "app/gui/network/words/FitWords.h"
#include "app/gui/project/Command.h"
#include "app/gui/project/ExportLines.h"

#include <QFileInfo>
#include <QObject>
#include <QStringList>

namespace palp {

namespace {

constexpr const char* kDesignFile = "sensor.json";

/// Commands and reasons of one file.
class NetworkSource {
public:
  NetworkSource(const Project& now, const NetworkSession& session) : now_(now), session_(session) {}

  void addSweep() {
    if (session_.sweepPoints().empty()) return;
    commands_ << sweepCommand(session_.sweepSettings());
    reasons_ << staleSweepReason(session_, now_.network);
  }
  void addShown() {
    if (session_.fit() == nullptr) return;
    addNetwork(*session_.fit(), "network.json");
    reasons_ << staleReason(session_, now_.network);
  }
  void addTrials() {
    for (const DecoderTrial& trial : session_.trials()) {
      NetworkSettings settings = session_.trialsSettings();
      settings.decoder = trial.kind;
      const QString decoder = QString::fromStdString(name(trial.kind));
      if (trial.refusal.isEmpty())
        commands_ << trainCommands(settings, kDesignFile, QString("network-%1.json").arg(decoder));
      else
        commands_ << QObject::tr("not trained: %1").arg(decoder);
    }
    reasons_ << staleTrialsReason(session_, now_.network);
  }
  /// One a row, in the order of the table.
  void addList() {
    int row = 0;
    for (const auto& fit : session_.kept()) addNetwork(*fit, QString("network-%1.json").arg(++row));
    reasons_ << staleListReason(session_);
  }

  /// To be run: a line that is not a command is a remark.
  [[nodiscard]] QString commands() const {
    QStringList reasons = reasons_;
    reasons.removeAll(QString());
    QStringList all;
    for (const QString& command : samples() + commands_ + reasons) all << command.split('\n');
    for (QString& line : all)
      if (!line.startsWith("palp ")) line.prepend("# ");
    return all.join('\n');
  }

  [[nodiscard]] QString lines() const {
    QStringList reasons = reasons_;
    reasons.removeAll(QString());
    return exportLines((samples() + commands_).join('\n'), ofSamples().design, reasons.join(' '));
  }

private:
  void addNetwork(const NetworkFit& fit, const QString& file) {
    const NetworkSamples* samples = session_.samples();
    if (samples != nullptr && fit.madeFrom != samples->settings)
      commands_ << QObject::tr("%1: on other samples, %2, seed %3%4")
                       .arg(file)
                       .arg(countWords(fit.madeFrom))
                       .arg(fit.madeFrom.seed)
                       .arg(fit.madeFrom.surrogate ? QObject::tr(", with a surrogate model") : QString());
    commands_ << (fit.file.isEmpty() ? trainCommands(fit.settings, kDesignFile, file)
                                     : predictCommand(fit.settings, QFileInfo(fit.file).fileName()));
  }

  /// The project as it was when the samples were made.
  [[nodiscard]] Project ofSamples() const {
    Project made = now_;
    const NetworkSamples* samples = session_.samples();
    if (samples == nullptr) return made;
    made.design = session_.results().design;
    made.samples = samples->settings;
    if (samples->mesh) made.mesh = *samples->mesh;
    return made;
  }

  [[nodiscard]] QStringList samples() const {
    const NetworkSamples* samples = session_.samples();
    if (samples == nullptr) return {};
    if (samples->file.isEmpty()) return {sampleCommands(ofSamples(), kDesignFile)};
    QString words = QObject::tr("train.csv, test.csv: the samples of %1").arg(QFileInfo(samples->file).fileName());
    if (samples->split) words += QObject::tr(", %1 for testing").arg(heldOutWords(samples->training));
    if (!samples->training.origin.mesh.empty()) words += "; " + QString::fromStdString(samples->training.origin.mesh);
    return {words};
  }

  const Project& now_;
  const NetworkSession& session_;
  QStringList commands_, reasons_;
};

} // namespace

QString commandsOfShown(const Project& now, const NetworkSession& session, const QString& designFile) {
  if (session.samples() == nullptr || session.fit() == nullptr) return networkCommands(now, designFile);
  NetworkSource source(now, session);
  source.addShown();
  source.addSweep();
  return source.commands();
}

QString networkSource(const QString& saved, const Project& now, const NetworkSession& session) {
  NetworkSource source(now, session);
  if (saved == "sweepError") { // the network that is shown is among the points of the sweep
    const InputKind input = session.sweepPoints().empty() ? now.network.input : session.sweepSettings().input;
    source.addSweep();
    if (session.fit() != nullptr && session.fit()->settings.input == input) source.addShown();
  } else if (saved == "sweepTable" || saved == "leaveOneOut" || saved == "condition" || saved == "errorTime") {
    source.addSweep();
  } else if (saved == "trialsError") {
    source.addTrials();
    if (sweepAndTrialsAgree(session)) source.addSweep(); // drawn among them
  } else if (saved == "trialsTable" || saved == "trialsTime") {
    source.addTrials();
  } else if (saved == "trainedNetworks") {
    source.addList();
  } else {
    source.addShown();
  }
  return source.lines();
}

} // namespace palp
