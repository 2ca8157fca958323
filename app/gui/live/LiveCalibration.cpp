#include "app/gui/live/LiveCalibration.h"

#include "app/gui/live/panels/CalibrationWords.h"
#include "app/gui/live/panels/KnownLoad.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "io/DecoderFile.h"
#include "io/SampleFile.h"
#include "model/base/Error.h"

#include <QDateTime>
#include <QGridLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollBar>
#include <QSpinBox>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace palp {

namespace {

constexpr double kDay_s = 86400;

/// Of a network that gives one force whatever area is touched, that force; NaN where a component is not measured.
Eigen::Vector3d forceOn(const DecodedForces& forces, int area) {
  return forces.measuredAlone(forces.forces_N)
      .col(forces.forces_N.cols() > 1 ? std::min<Eigen::Index>(area, forces.forces_N.cols() - 1) : 0);
}

} // namespace

LiveCalibration::LiveCalibration(LiveHost& host, QWidget* parent) : QWidget(parent), host_(host) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(4, 4, 4, 4);
  addTo(*row, {buildLabel(), {buildFrames(), 2}, {buildFit(), 3}});
  for (const JobRunner* runner : {&runner_, &writer_})
    connect(runner, &JobRunner::failed, this, [this](const QString& sentence) { complain(sentence); });
  connect(&host_, &LiveHost::decoderChanged, this, [this] {
    known_->setSensor(host_.sensor(), host_.network().decoder() ? &*host_.network().decoder() : nullptr);
    displayFrames();
    displayState();
  });
  displayFrames();
  displayFit();
  displayState();
}

QWidget* LiveCalibration::buildLabel() {
  auto* box = new QGroupBox(tr("Known load"));
  auto* column = new QVBoxLayout(box);
  known_ = new KnownLoad;
  known_->setSensor(host_.sensor(), host_.network().decoder() ? &*host_.network().decoder() : nullptr);
  column->addWidget(known_);
  count_ = wholeBox("labelFrames", {.low = 1, .high = 100000, .unit = tr(" frames"), .whileTyping = true},
                    tr("Number of frames that are averaged to one labelled frame"));
  count_->setValue(50);
  count_->setPrefix(tr("Mean of "));
  collect_ = pushButton(tr("Collect"), "collect", tr("Averages the next frames under this load"));
  column->addLayout(inRow({{count_, 1}, collect_}));
  problem_ = textLabel("calibrationProblem", "problem");
  problem_->hide();
  progress_ = new QProgressBar;
  progress_->setMaximumHeight(10);
  progress_->setTextVisible(false);
  addTo(*column, {progress_, problem_, Part::stretch()});
  connect(collect_, &QPushButton::clicked, this, &LiveCalibration::collect);
  return box;
}

QWidget* LiveCalibration::buildFrames() {
  auto* box = new QGroupBox(tr("Labelled frames [N]"));
  auto* column = new QVBoxLayout(box);
  table_ = new QTableWidget(0, 3);
  table_->setObjectName("labelledFrames");
  table_->setHorizontalHeaderLabels({tr("area"), tr("load\nFx, Fy, Fz"), tr("network\nFx, Fy, Fz")});
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setMinimumSectionSize(24);
  table_->verticalHeader()->setDefaultAlignment(Qt::AlignCenter); // numbers, by which the report names a frame
  table_->setWordWrap(false);
  table_->setToolTip(tr("Known loads, and the network's mean prediction for each labelled frame [N]"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  auto* row = new QGridLayout; // two in a line, for narrow windows; above, where a low window does not cut them
  auto* load = pushButton(tr("Load..."), "loadFrames", tr("Adds the labelled frames of a CSV file"));
  saveFrames_ = pushButton(tr("Save..."), "saveFrames", tr("Saves the labelled frames to a CSV file"));
  remove_ = pushButton(tr("Remove"), "removeFrame", tr("Removes the selected frame"));
  row->addWidget(load, 0, 0);
  row->addWidget(saveFrames_, 0, 1);
  row->addWidget(remove_, 1, 0, 1, 2);
  column->addLayout(row);
  column->addWidget(table_, 1);
  connect(load, &QPushButton::clicked, this, [this] {
    const QString file = askFileToOpen(this, tr("Labelled frames"), tr("Samples (*.csv *.h5 *.hdf5 *.npz)"));
    if (!file.isEmpty()) this->load(file.toStdString());
  });
  connect(saveFrames_, &QPushButton::clicked, this, [this] {
    const QString file =
        askFileToSave(this, tr("Labelled frames"), "frames.csv", tr("Samples (*.csv *.h5 *.hdf5 *.npz)"));
    if (!file.isEmpty()) saveFrames(file);
  });
  connect(remove_, &QPushButton::clicked, this, [this] {
    frames_.remove(table_->currentRow());
    complain({}); // it may have been of that frame
    displayFrames();
    tellFrames();
  });
  return box;
}

QWidget* LiveCalibration::buildFit() {
  auto* box = new QGroupBox(tr("Refined network"));
  auto* column = new QVBoxLayout(box);
  report_ = markupLabel();
  report_->setObjectName("calibrationReport");
  report_->setWordWrap(true);
  report_->setAlignment(Qt::AlignTop);
  report_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* row = new QGridLayout; // two in a line, for narrow windows; above, where a low window does not cut them
  fit_ = pushButton(
      tr("Fit"), "fitCalibration",
      tr("Fits gains and offsets of the network's forces by recursive least squares, validated on held-out frames"));
  use_ = pushButton(tr("Use"), "useCalibration", tr("Uses the refined network for decoding from now on"));
  saveNetwork_ = pushButton(tr("Save network..."), "saveCalibration", tr("Saves the refined network to a file"));
  back_ = pushButton(tr("Back"), "backFromCalibration", tr("Uses the previous network for decoding again"));
  for (const auto& [push, place] : {std::pair{fit_, 0}, {use_, 1}, {saveNetwork_, 2}, {back_, 3}})
    row->addWidget(push, place / 2, place % 2);
  column->addLayout(row);
  column->addWidget(report_, 1);
  connect(fit_, &QPushButton::clicked, this, &LiveCalibration::fit);
  connect(use_, &QPushButton::clicked, this, &LiveCalibration::use);
  connect(back_, &QPushButton::clicked, this, [this] {
    host_.network().restore();
    emit message(tr("Now decoding with %1.").arg(host_.network().name()));
  });
  connect(saveNetwork_, &QPushButton::clicked, this, [this] {
    const QString file = askFileToSave(this, tr("Save network"), "better.json", tr("Networks (*.json)"));
    if (!file.isEmpty() && calibration_) saveNetwork(file);
  });
  return box;
}

/// In turn with other saves: the frames that are here now.
void LiveCalibration::saveFrames(const QString& file) {
  const auto work = [this, file, saved = shown_, frames = frames_](const auto&, JobProgress&) {
    frames.save(file.toStdString());
    return [this, file, saved] {
      if (saved == shown_) unsaved_ = false; // no others came meanwhile
      emit message(tr("Saved the labelled frames to %1.").arg(file));
    };
  };
  writer_.start(tr("Saving labelled frames"), work, JobRunner::Loss::Work);
}

void LiveCalibration::saveNetwork(const QString& file) {
  const auto work = [this, file, decoder = calibration_->decoder](const auto&, JobProgress&) {
    writeNetwork(decoder, file.toStdString());
    return [this, file] { emit message(tr("Saved the refined network to %1.").arg(file)); };
  };
  writer_.start(tr("Saving the refined network"), work, JobRunner::Loss::Work);
}

void LiveCalibration::guarded(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& refusal) {
    complain(QString::fromStdString(refusal.what()));
  }
  displayFrames();
}

/// Red, where one looks, until the next try.
void LiveCalibration::complain(const QString& sentence) {
  problem_->setText(sentence);
  problem_->setVisible(!sentence.isEmpty());
  if (!sentence.isEmpty()) emit message(sentence);
}

/// Asks before a bad fit is used.
bool LiveCalibration::mayUse() {
  QStringList words;
  for (const std::string& warning : warningsOf(calibration_->report)) words << QString::fromStdString(warning);
  if (words.isEmpty()) return true;
  const auto answer =
      QMessageBox::question(this, tr("Use a poor fit?"),
                            tr("This calibration is a poor fit: %1. Use it for decoding anyway?").arg(words.join("; ")),
                            QMessageBox::Yes | QMessageBox::No, QMessageBox::No);
  return answer == QMessageBox::Yes;
}

void LiveCalibration::use() {
  if (!mayUse()) return;
  const QString name = tr("calibrated, %1 frames, %2")
                           .arg(calibration_->report.samples)
                           .arg(QDateTime::currentDateTime().toString("yyyy-MM-dd HH:mm"));
  host_.network().refine(calibration_->decoder, name);
  emit message(tr("Now decoding with the network %1; Back returns to %2.").arg(name, host_.network().nameBefore()));
}

void LiveCalibration::displayState() {
  const QString& before = host_.network().nameBefore();
  back_->setEnabled(!before.isEmpty());
  back_->setToolTip(before.isEmpty() ? tr("Uses the previous network for decoding again; there is none yet")
                                     : tr("Uses %1 for decoding again").arg(before));
  back_->setText(before.isEmpty() ? tr("Back") : tr("Back to %1").arg(before.section(',', 0, 0)));
  const LiveFrame* last = host_.history().last();
  const bool reads = last != nullptr && last->forces.valid && last->forces.forces_N.cols() > 0;
  known_->displayReading(reads ? std::optional<Eigen::Vector3d>(forceOn(last->forces, known_->load().load.area))
                               : std::nullopt);
}

void LiveCalibration::load(const std::filesystem::path& file) {
  runner_.start(tr("Reading the frames"), [this, file](const std::stop_token&, JobProgress&) -> JobRunner::Taking {
    const auto frames = std::make_shared<const SampleSet>(loadSamples(file));
    const auto written = std::filesystem::last_write_time(file);
    return [this, file, frames, written] {
      frames_.append(*frames, file.string());
      written_ = written;
      displayFrames();
      tellFrames();
    };
  });
}

void LiveCalibration::collect() {
  complain({});
  if (frames_.collecting()) {
    frames_.stop();
    displayFrames();
    return;
  }
  if (!host_.network().decoder()) {
    complain(tr("There is no network, so the design of the frames is unknown. Open a network first."));
    return;
  }
  if (!mayCollect()) return;
  guarded([&] { frames_.begin(*host_.network().decoder(), host_.sensor(), known_->load(), count_->value()); });
}

/// Asks where what the network reads now can hardly be the label.
bool LiveCalibration::mayCollect() {
  const LiveFrame* last = host_.history().last();
  const KnownTouch label = known_->load();
  const std::string doubt = last == nullptr ? std::string()
                                            : labelAgainstReading(label.load.force_N, last->forces, label.load.area,
                                                                  *host_.network().decoder());
  if (doubt.empty()) return true;
  QMessageBox question(QMessageBox::Question, tr("Collect this load?"),
                       tr("Known load: %1 Collect a frame with this label anyway?").arg(QString::fromStdString(doubt)),
                       QMessageBox::Yes | QMessageBox::No, this);
  question.setDefaultButton(QMessageBox::No);
  QAbstractButton* put = nullptr;
  if (host_.simulated()) {
    question.setInformativeText(tr("Set the load of the simulated board at the left, under Touch by hand."));
    put = question.addButton(tr("Apply to the simulated board"), QMessageBox::ActionRole);
    put->setObjectName("putSimulatedLoad");
  }
  const int answer = question.exec();
  if (put != nullptr && question.clickedButton() == put) {
    emit simulatedLoadRequested(label);
    emit message(tr("The simulated board now carries the labelled load: collect a frame."));
  }
  return answer == QMessageBox::Yes;
}

void LiveCalibration::take() {
  if (!frames_.collecting()) return;
  bool taken = false;
  for (const auto& frame : host_.fresh()) {
    if (host_.status().taring || !frames_.collecting()) break;
    guarded([&] {
      if (!frames_.add(frame->forces)) return;
      newest_s_ = hostClock_s();
      unsaved_ = taken = true;
      if (!frame->forces.doubt.empty())
        complain(tr("Frame %1 is implausible: %2. If the sensor drifts, unload it, tare, and collect again.")
                     .arg(frames_.samples().size())
                     .arg(QString::fromStdString(frame->forces.doubt)));
      if (!frames_.doubt().empty())
        complain(tr("Frame %1: %2. If the label is wrong, remove the frame.")
                     .arg(frames_.samples().size())
                     .arg(QString::fromStdString(frames_.doubt())));
    });
  }
  progress_->setValue(frames_.collected());
  if (taken) tellFrames();
}

void LiveCalibration::display(const std::shared_ptr<const BoardFrames>& frames) {
  if (frames == shown_) return;
  shown_ = frames;
  frames_.stop();
  if (frames)
    frames_.replace(frames->samples, frames->read_N);
  else
    frames_.clear();
  unsaved_ = frames != nullptr;
  newest_s_ = 0;
  written_.reset();
  table_->setRowCount(0);
  complain({});
  forgetFit();
}

void LiveCalibration::forgetFit() {
  runner_.cancel(); // it refines with frames, or reads some, of another project
  calibration_.reset();
  displayFrames();
}

/// Those that are here now are the project's.
void LiveCalibration::tellFrames() {
  const SampleSet& samples = frames_.samples();
  shown_ =
      samples.size() == 0 ? nullptr : std::make_shared<const BoardFrames>(BoardFrames{samples, frames_.predicted_N()});
  emit framesEdited();
}

void LiveCalibration::displayFrames() {
  const SampleSet& samples = frames_.samples();
  collect_->setText(frames_.collecting() ? tr("Stop") : tr("Collect"));
  progress_->setRange(0, std::max(1, frames_.wanted()));
  progress_->setValue(frames_.collected());
  const bool any = samples.size() > 0;
  for (QPushButton* push : {remove_, saveFrames_}) push->setEnabled(any);
  fit_->setEnabled(samples.size() >= kFewestCalibrationFrames);
  displayFit();
  if (table_->rowCount() == samples.size()) return;
  table_->setRowCount(static_cast<int>(samples.size()));
  const bool placed = samples.places_mm.rows() > 0;
  table_->horizontalHeaderItem(0)->setText(placed ? tr("position\nx, y [mm]") : tr("area"));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const QString where =
        placed ? QString("%1, %2").arg(samples.places_mm(0, row), 0, 'f', 2).arg(samples.places_mm(1, row), 0, 'f', 2)
               : QString::number(samples.area(row));
    table_->setItem(row, 0, new QTableWidgetItem(where));
    QStringList load, said;
    for (int d = 0; d < 3; ++d) {
      load << QString::number(samples.forces_N(d, row), 'g', 4);
      const double predicted_N = frames_.predicted_N()(d, row);
      if (!std::isnan(predicted_N)) said << QString::number(std::round(1e3 * predicted_N) / 1e3 + 0.0, 'f', 3);
    }
    table_->setItem(row, 1, new QTableWidgetItem(load.join(", ")));
    table_->setItem(row, 2, new QTableWidgetItem(said.join(", ")));
  }
  const int cells = table_->horizontalHeader()->length() + table_->verticalHeader()->sizeHint().width();
  table_->setMinimumWidth(cells + table_->verticalScrollBar()->sizeHint().width() + 2 * table_->frameWidth());
  table_->scrollToBottom();
}

void LiveCalibration::fit() {
  complain({});
  if (!host_.network().decoder()) return;
  runner_.start(tr("Refining the network"), [this, decoder = *host_.network().decoder(),
                                             frames = frames_.samples()](const std::stop_token&, JobProgress&) {
    auto result = std::make_shared<Calibration>(calibrate(decoder, frames));
    return [this, result, fitted = frames.resistances_ohm] {
      calibration_ = std::move(*result);
      fitted_ohm_ = fitted;
      displayFit();
    };
  });
}

void LiveCalibration::displayFit() {
  use_->setEnabled(calibration_.has_value());
  saveNetwork_->setEnabled(calibration_.has_value());
  if (!calibration_) {
    const auto count = frames_.samples().size();
    report_->setText(tr("Put known loads on the sensor one after the other and collect a frame under each. Begin with "
                        "the three suggested weights on each area (a push is negative in z). At least %1 frames over "
                        "the complete force range are needed; a load may be repeated. Then fit. ")
                         .arg(kFewestCalibrationFrames) +
                     (host_.simulated()
                          ? tr("The simulated board carries the load set at the left, under Touch by hand. ")
                          : QString()) +
                     (count < kFewestCalibrationFrames ? tr("%1 of %2 so far.").arg(count).arg(kFewestCalibrationFrames)
                                                       : tr("%1 so far, enough to fit.").arg(count)));
    return;
  }
  double age_days = newest_s_ > 0 ? (hostClock_s() - newest_s_) / kDay_s : 0;
  if (newest_s_ == 0 && written_) {
    const auto age = std::filesystem::file_time_type::clock::now() - *written_;
    age_days = std::chrono::duration<double>(age).count() / kDay_s;
  }
  const auto count = frames_.samples().size();
  const bool changed = count != fitted_ohm_.cols() || frames_.samples().resistances_ohm != fitted_ohm_;
  report_->setText(
      (changed ? tr("<p><b>The frames have changed since the fit: %1 now%2.</b></p>")
                     .arg(count)
                     .arg(count < kFewestCalibrationFrames ? tr(", %1 are needed").arg(kFewestCalibrationFrames)
                                                           : tr(", fit again"))
               : QString()) +
      calibrationWords(*calibration_, std::max(0.0, age_days)));
}

} // namespace palp
