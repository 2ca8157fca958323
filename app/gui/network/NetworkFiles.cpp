#include "app/gui/network/NetworkFiles.h"

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/jobs/samples/SampleFiles.h"
#include "app/gui/project/FileKind.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/widgets/FileDialogs.h"
#include "model/base/Error.h"

#include <QFileInfo>
#include <QMessageBox>

namespace palp {

namespace {

constexpr double kLong_s = 30; // samples that took longer are not discarded silently

} // namespace

NetworkFiles::NetworkFiles(Workbench& workbench, NetworkSession& session, QWidget* page)
    : QObject(page), workbench_(workbench), session_(session), page_(page) {}

void NetworkFiles::openSamples() {
  openChosen(askFilesToOpen(page_, tr("Open samples"), tr("Samples (*.csv *.h5 *.hdf5 *.npz)")));
}

void NetworkFiles::chooseTables() {
  openChosen(askFilesToOpen(page_, tr("Import a table of measured data"),
                            tr("Tables (*.csv *.tsv *.txt *.dat *.h5 *.hdf5 *.npz *.mat *.json);;All files (*)")));
}

void NetworkFiles::openChosen(const QStringList& chosen) {
  std::vector<std::filesystem::path> files;
  for (const QString& file : chosen) files.emplace_back(file.toStdString());
  if (!files.empty()) openSamples(files);
}

/// Reports a file without samples before any question.
void NetworkFiles::openSamples(const std::vector<std::filesystem::path>& files) {
  try {
    QStringList names;
    for (const std::filesystem::path& file : files) names << QString::fromStdString(file.string());
    if (areTables(names)) {
      emit importRequested(names);
      return;
    }
    for (const std::filesystem::path& file : files) requireSamples(file);
    if (mayReplaceSamples()) session_.openSamples(files);
  } catch (const Error& error) {
    emit problem(QString::fromStdString(error.what()));
  }
}

bool NetworkFiles::mayReplaceSamples() const {
  const auto samples = session_.sharedSamples();
  const bool inFile = samples && (!samples->file.isEmpty() || !session_.results().openedFrom.isEmpty());
  if (!samples || samples->seconds < kLong_s || inFile || saved_.lock() == samples) return true;
  return QMessageBox::question(
             page_, tr("Open samples"),
             tr("The %1 samples were generated in %2 and have not been saved. Open other samples instead?")
                 .arg(samples->training.size() + samples->test.size())
                 .arg(roughly(samples->seconds)),
             QMessageBox::Yes | QMessageBox::No, QMessageBox::No) == QMessageBox::Yes;
}

void NetworkFiles::saveSamples() {
  const QString file = askFileToSave(page_, tr("Save samples"), "samples.csv", tr("Samples (*.csv *.h5 *.hdf5 *.npz)"));
  if (file.isEmpty() || session_.samples() == nullptr) return;
  const QString test =
      QString::fromStdString(testFileOf(file.toStdString()).string()); // which the dialog does not cover
  if (QFileInfo::exists(test) &&
      QMessageBox::question(page_, tr("Save samples"),
                            tr("The test samples go into %1, which exists. Replace it?").arg(test)) != QMessageBox::Yes)
    return;
  session_.saveSamples(file.toStdString(),
                       [this, samples = std::weak_ptr(session_.sharedSamples())] { saved_ = samples; });
}

/// After the name that it was given.
QString NetworkFiles::proposedName() const {
  QString name = session_.fit() != nullptr ? session_.fit()->name.trimmed() : QString();
  name.replace('/', '-');
  return (name.isEmpty() ? "network" : name) + ".json";
}

void NetworkFiles::saveNetwork() {
  const QString file = askFileToSave(page_, tr("Save network"), proposedName(), tr("Networks (*.json)"));
  if (!file.isEmpty() && session_.fit() != nullptr) session_.saveNetwork(file.toStdString());
}

void NetworkFiles::useInLive() {
  const QString file = askFileToSave(page_, tr("Save the network for Live"), proposedName(), tr("Networks (*.json)"));
  if (file.isEmpty() || session_.fit() == nullptr) return;
  session_.saveNetwork(file.toStdString(), [this, file] { takeIntoLive(file.toStdString()); });
}

void NetworkFiles::takeIntoLive(const std::filesystem::path& network) {
  Project next = workbench_.project();
  if (next.live.network == network.string()) emit liveNetworkReplaced();
  next.live.network = network.string();
  next.live.calibrated.reset();
  workbench_.edit(tr("Use a network in Live"), next);
  emit sceneRequested("live");
}

void NetworkFiles::openNetwork() {
  const QString file = askFileToOpen(page_, tr("Open network"), tr("Networks (*.json)"));
  if (file.isEmpty()) return;
  try {
    session_.open(file.toStdString());
  } catch (const Error& error) {
    emit problem(QString::fromStdString(error.what()));
  }
}

} // namespace palp
