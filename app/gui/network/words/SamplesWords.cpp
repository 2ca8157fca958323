#include "app/gui/network/words/SamplesWords.h"

#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/jobs/samples/SampleFiles.h"
#include "app/gui/jobs/samples/SampleTimes.h"
#include "app/gui/network/words/FitWords.h"

#include <QFileInfo>
#include <QObject>
#include <QStringList>

#include <cmath>
#include <filesystem>

namespace palp {

namespace {

QString spanned(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const double low = values.minCoeff(), high = values.maxCoeff();
  const auto words = [](double value) { return QString::number(value + 0.0, 'g', 3); }; // no -0
  return low == high ? words(low) : QObject::tr("%1 to %2").arg(words(low), words(high));
}

/// Of the training and the test together.
QString spanWords(const NetworkSamples& samples) {
  const SampleSet &training = samples.training, &test = samples.test;
  const auto of = [&](Eigen::MatrixXd SampleSet::*values, Eigen::Index row) {
    Eigen::MatrixXd both(1, training.size() + test.size());
    both << (training.*values).row(row), (test.*values).row(row);
    return spanned(both);
  };
  QStringList words;
  if (training.size() == 0 || test.size() == 0) return {};
  if (training.forces_N.rows() == 3 && test.forces_N.rows() == 3)
    words << QObject::tr("Fx %1 N").arg(of(&SampleSet::forces_N, 0))
          << QObject::tr("Fy %1 N").arg(of(&SampleSet::forces_N, 1))
          << QObject::tr("Fz %1 N").arg(of(&SampleSet::forces_N, 2));
  else
    words << QObject::tr("forces %1 N").arg(spanned(training.forces_N));
  if (training.hasPlaces()) {
    const Eigen::Matrix2Xd places = training.touchedPlaces_mm();
    words << QObject::tr("x %1 mm").arg(spanned(places.row(0))) << QObject::tr("y %1 mm").arg(spanned(places.row(1)));
  }
  if (training.resistances_ohm.size() > 0)
    words << QObject::tr("resistances %1 ohm").arg(spanned(training.resistances_ohm));
  return words.join(", ") + ".";
}

QString madeWords(const NetworkSamples& samples) {
  QString words;
  if (samples.seconds > 0) words += QObject::tr(", made in %1").arg(roughly(samples.seconds));
  if (samples.batchError > 0)
    words += QObject::tr("; solver error %1 (against full Newton)").arg(samples.batchError, 0, 'g', 2);
  if (samples.redrawn > 0)
    words += QObject::tr("; touches without an equilibrium, replaced by others: %1").arg(samples.redrawn);
  if (!samples.doubts.isEmpty()) words += "; " + samples.doubts;
  return words;
}

/// `file`: that they were opened from last.
QString openedWords(const NetworkSamples& samples, const QString& file) {
  QString words = QObject::tr(" from %1 ").arg(QFileInfo(file).fileName());
  if (samples.training.origin.imported())
    words += samples.ofNoDesign ? QObject::tr("(measured; their design is not open)") : QObject::tr("(measured)");
  else
    words += QObject::tr("(%1, seed %2)").arg(countWords(samples.settings)).arg(samples.settings.seed);
  const QString makers = QString::fromStdString(samples.training.origin.madeBy);
  if (makers.contains("; ")) words += QObject::tr("; made by several programs: %1").arg(makers);
  if (!samples.split) return words;
  const std::filesystem::path beside = testFileOf(samples.file.toStdString());
  const QString test = QString::fromStdString(beside.filename().string());
  const QString heldOut = heldOutWords(samples.training);
  words += std::filesystem::exists(beside)
               ? QObject::tr("; %1 is used for testing, %2 could not be used").arg(heldOut, test)
               : QObject::tr("; %1 is used for testing, as there is no %2").arg(heldOut, test);
  return words;
}

} // namespace

QString samplesWords(const NetworkSession& session) {
  const NetworkSamples* samples = session.samples();
  if (samples == nullptr)
    return session.openingResults() ? QObject::tr("Being opened.") : QObject::tr("None yet for this design.");
  const QString counts =
      QObject::tr("%1 for training, %2 for testing").arg(samples->training.size()).arg(samples->test.size());
  if (!session.upToDate())
    return counts + QObject::tr(", of %1: undo the change, or generate new ones.").arg(earlierDesign(session));
  const QString& opened = session.results().openedFrom;
  const QString& file = opened.isEmpty() ? samples->file : opened;
  return counts + (file.isEmpty() ? madeWords(*samples) : openedWords(*samples, file)) + ". " + spanWords(*samples);
}

QString plannedWords(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh) {
  const int count = samples.touches ? samples.touches->count : samples.perArea * design.areas.count();
  const QString words = QObject::tr("Generates %1 samples for training and as many for testing").arg(count);
  const auto time = sampleTime(samples, design, mesh);
  if (!time) return words + QObject::tr("; the time on this mesh is not known yet.");
  return words +
         (time->measuredHere ? QObject::tr(", in about %1 (last run).") : QObject::tr(", in about %1 (estimate)."))
             .arg(roughly(time->seconds));
}

} // namespace palp
