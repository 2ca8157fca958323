// What the buttons of the Live page do: tare, record, export, solve the model view.

#include "app/gui/live/LiveCalibration.h"
#include "app/gui/live/LiveDrawings.h"
#include "app/gui/live/LiveModelView.h"
#include "app/gui/live/LivePage.h"
#include "app/gui/live/panels/LiveControlPanel.h"
#include "app/gui/live/recordings/RecordingName.h"
#include "app/gui/views/CsvExport.h"
#include "app/study/live/recordings/RecordingTable.h"
#include "app/study/touch/TouchLoad.h"
#include "io/DesignFile.h"

#include <QMessageBox>
#include <QTabWidget>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kHeld_s = 0.5;  // a force that stays for so long is held
constexpr double kSteady = 0.05; // of it, that it may move meanwhile
constexpr std::size_t kLeastFrames = 3;
constexpr double kLeastTrainedNoise = 5e-6; // of a good board

/// The force that has rested on the sensor for half a second; null where there is none that could be true.
const LiveFrame* heldTouch(const LiveHistory& history) {
  const auto& entries = history.entries();
  double least_N = 0, most_N = 0;
  std::size_t seen = 0;
  for (auto entry = entries.rbegin(); entry != entries.rend() && entries.back().t_s - entry->t_s < kHeld_s; ++entry) {
    const DecodedForces& forces = entry->frame->forces;
    const bool shown = std::find(forces.shown.begin(), forces.shown.end(), true) != forces.shown.end();
    if (!forces.valid || !shown || !forces.doubt.empty()) return nullptr;
    const double size_N = std::sqrt(forces.forces_N.colwise().squaredNorm().maxCoeff());
    least_N = seen == 0 ? size_N : std::min(least_N, size_N);
    most_N = std::max(most_N, size_N);
    ++seen;
  }
  return seen >= kLeastFrames && most_N - least_N < kSteady * most_N ? history.last() : nullptr;
}

} // namespace

void LivePage::tare() {
  const LiveFrame* held = host_.status().tareSuggested ? nullptr : heldTouch(host_.history());
  if (held != nullptr) {
    const LiveArrow touch = arrowsOf(held->forces).front();
    const auto hundredths = [](double force_N) { return std::round(100 * force_N) / 100 + 0.0; }; // no -0
    const auto answer =
        QMessageBox::question(this, tr("Tare under a load?"),
                              tr("The network reads (%1, %2, %3) N on area %4. A tare takes the present readings as "
                                 "rest: this force will then read as zero. Tare anyway?")
                                  .arg(hundredths(touch.force_N.x()), 0, 'f', 2)
                                  .arg(hundredths(touch.force_N.y()), 0, 'f', 2)
                                  .arg(hundredths(touch.force_N.z()), 0, 'f', 2)
                                  .arg(touch.area),
                              QMessageBox::Yes | QMessageBox::No, QMessageBox::No);
    if (answer != QMessageBox::Yes) return;
  }
  host_.tare();
}

/// Of a recording all of it, else the frames that the curves hold.
void LivePage::exportFrames(const QString& file) {
  if (host_.replaying()) return exportRecording(file);
  exporter_.start(
      tr("Exporting frames"),
      [this, file, history = host_.history(), head = sourceOf(*this).toStdString()](const std::stop_token&,
                                                                                    JobProgress&) -> JobRunner::Taking {
        writeLiveCsv(file.toStdString(), history, head);
        return [this, file, count = history.entries().size()] {
          emit message(tr("Wrote the last %1 frames to %2.").arg(count).arg(file));
        };
      },
      JobRunner::Loss::Work);
}

void LivePage::exportRecording(const QString& file) {
  RecordingTableRequest request{
      host_.settings().recording, file.toStdString(), host_.network().decoder(), {}, {}, true};
  const bool known =
      host_.network().decoder() && designFingerprint(host_.sensor()) == host_.network().decoder()->designFingerprint;
  if (known) request.design = host_.sensor();
  request.head = sourceOf(*this).toStdString();
  exporter_.start(
      tr("Exporting the recording"),
      [this, file, request](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        const auto show = [&](double share) { progress.set(share, "reading, decoding and writing its frames"); };
        const RecordingTableReport report = writeRecordingTable(request, show, stop);
        return [this, file, report] {
          const QString note = report.note.empty() ? QString() : tr(" %1.").arg(QString::fromStdString(report.note));
          emit message(tr("Wrote all %1 frames of the recording to %2.").arg(report.frames).arg(file) + note);
        };
      },
      JobRunner::Loss::Work);
}

void LivePage::record(const QString& file, bool replace) {
  if (host_.recording()) return stopRecording();
  const std::filesystem::path wanted = file.toStdString();
  const std::filesystem::path path = replace ? wanted : freeRecording(wanted, QDateTime::currentDateTime());
  try {
    host_.startRecording(path, replace);
    control_->displayRecording(QString::fromStdString(path.string()), {});
    const QString name = QString::fromStdString(path.string());
    emit message(host_.replaying() ? tr("Recording what is played to %1.").arg(name)
                                   : tr("Recording to %1.").arg(name));
  } catch (const std::exception& refusal) {
    control_->displayRecording({}, QString::fromStdString(refusal.what()));
    emit message(QString::fromStdString(refusal.what()));
  }
  stateLook_ = 0;
}

bool LivePage::endsRecording(const Leaving& leaving) const {
  if (!host_.recording()) return false;
  const Project* next = leaving.next;
  return next == nullptr || board_ >= next->boards() || !sameSource(host_.settings(), next->board(board_));
}

QString LivePage::recordingEnds() const {
  return tr("The recording to %1 is in progress and will be stopped; the data recorded so far are kept.")
      .arg(QString::fromStdString(host_.recordingFile().string()));
}

QStringList LivePage::lossesByClosing() const {
  QStringList losses;
  if (host_.recording()) losses << recordingEnds();
  for (const JobRunner* writer : std::initializer_list<const JobRunner*>{&exporter_, &calibration_->writer()})
    if (const QString lost = writer->loss(); !lost.isEmpty()) losses << lost;
  if (const int frames = unsavedFrames(); frames > 0)
    losses << tr("%1 labelled frames of this board are not saved. Use Save... under Calibration to keep them.")
                  .arg(frames);
  if (host_.network().calibrated())
    losses << tr("The network %1 is used only here and is not saved. Use Save network... under Calibration to keep it.")
                  .arg(host_.network().name());
  return losses;
}

void LivePage::stopRecording() {
  host_.stopRecording();
  emit message(tr("Recorded %1 s to %2.")
                   .arg(host_.recorded_s(), 0, 'f', 1)
                   .arg(QString::fromStdString(host_.recordingFile().string())));
}

void LivePage::solveModelView() {
  const LiveFrame* last = host_.history().lastValid();
  if (last == nullptr) {
    emit message(tr("No force has been decoded yet."));
    return;
  }
  const SensorDesign& sensor = host_.sensor();
  const LoadCase load =
      host_.network().decoder() ? loadOf(last->forces, *host_.network().decoder(), sensor) : LoadCase{};
  if (load == LoadCase{}) {
    emit message(tr("No touch on the sensor: press it, then request the model view."));
    return;
  }
  blockTabs_->setCurrentWidget(modelView_);
  const bool own = sensor == workbench_.project().design;
  modelView_->solve(sensor, load, own ? workbench_.project().mesh : MeshOptions{}, last->change);
}

/// The Network scene is left to generate, train and save; what it needs for such a board is set.
void LivePage::prepareNetwork(const QString& rows) {
  Project next = workbench_.project();
  const int own = next.design.rowWires(), board = host_.status().info ? host_.status().info->rowWires : own;
  if (own != board)
    return emit message(tr("The project's design has %1 row-wires but the board has %2: open the board's design first.")
                            .arg(own)
                            .arg(board));
  NetworkSettings& network = next.network;
  network.input = InputKind::Resistance;
  network.rows = rows.toStdString();
  const double noise = std::max(settings().simulation.noise, kLeastTrainedNoise);
  network.noise = std::max(network.noise, noise);
  network.testNoise = std::max(network.testNoise, noise);
  workbench_.edit(tr("Select intact row-wires"), next);
  emit message(
      tr("The network is set to row-wires %1: generate samples, train it here, then press Use in Live.").arg(rows));
  emit sceneRequested("network");
}

int LivePage::unsavedFrames() const {
  return calibration_->unsavedFrames();
}

} // namespace palp
