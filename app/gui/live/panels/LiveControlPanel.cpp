#include "app/gui/live/panels/LiveControlPanel.h"

#include "app/gui/live/LiveNews.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/PushButton.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileInfo>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStyle>
#include <QVBoxLayout>

namespace palp {

namespace {

constexpr const char* kTareTip = QT_TR_NOOP("Takes the next frames as rest; waits while the sensor is moving (T)");
constexpr double kMegabyte = 1e6;
constexpr double kRecordedReport = 64 + 12; // bytes with kind, length and time

QLabel* words(const QString& name, const char* role) {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  label->setProperty("role", role);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

QHBoxLayout* beside(std::initializer_list<QWidget*> widgets) {
  auto* row = new QHBoxLayout;
  for (QWidget* widget : widgets) row->addWidget(widget);
  return row;
}

void setRole(QLabel& label, const char* role) {
  if (label.property("role").toString() == role) return;
  label.setProperty("role", role);
  label.style()->unpolish(&label);
  label.style()->polish(&label);
}

void setText(QLabel& label, const QString& text) {
  if (label.text() != text) label.setText(text);
  label.setVisible(!text.isEmpty());
}

} // namespace

LiveControlPanel::LiveControlPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  recording_ = buildRecording();
  column->addWidget(recording_);
  column->addWidget(buildNetwork());
  column->addWidget(buildAlarm());
  column->addWidget(buildScales());
  column->addStretch(1);
}

QWidget* LiveControlPanel::buildNetwork() {
  auto* box = new QGroupBox(tr("Network and tare"));
  auto* column = new QVBoxLayout(box);
  network_ = words("networkName", "hint");
  networkProblem_ = words("networkProblem", "problem");
  column->addWidget(network_);
  auto* open =
      pushButton(tr("Open..."), "chooseNetwork",
                 tr("Opens a network that reads resistances; if it cannot be used, the present one stays in use"));
  shipped_ =
      pushButton(tr("Built-in"), "shippedNetwork",
                 tr("Uses the network that ships with Palp: all row-wires of the paper's design, noise of 5 ppm"));
  back_ = pushButton(tr("Back"), "networkBack", tr("Uses the previous network again"));
  column->addLayout(beside({open, shipped_}));
  column->addWidget(back_);
  tareFrames_ = new WholeBox;
  tareFrames_->setObjectName("tareFrames");
  tareFrames_->setRange(1, 100000);
  tareFrames_->setSuffix(tr(" frames"));
  tareFrames_->setToolTip(tr("Number of frames averaged as rest; more frames reduce the noise of the zero"));
  tare_ = pushButton(tr("Tare"), "tare", tr(kTareTip));
  clearTare_ = pushButton(tr("Clear"), "clearTare",
                          tr("Clears the tare: changes are then relative to the design's resistances at rest"));
  column->addLayout(beside({tare_, tareFrames_, clearTare_}));
  tareState_ = words("tareState", "hint");
  tareState_->setText(tr("Not tared."));
  column->addWidget(tareState_);
  column->addWidget(networkProblem_); // below: no button moves when it comes
  connect(open, &QPushButton::clicked, this, &LiveControlPanel::chooseNetwork);
  connect(shipped_, &QPushButton::clicked, this, [this] {
    if (settings_.network.empty() && !settings_.calibrated) return emit shippedAsked();
    useNetwork({});
  });
  connect(back_, &QPushButton::clicked, this, &LiveControlPanel::backAsked);
  connect(tare_, &QPushButton::clicked, this, &LiveControlPanel::tareAsked);
  connect(clearTare_, &QPushButton::clicked, this, &LiveControlPanel::clearTareAsked);
  connect(tareFrames_, &QSpinBox::valueChanged, this, [this](int value) {
    edit(tr("frames of the tare"), [&](LiveSettings& settings) { settings.tareFrames = value; });
  });
  return box;
}

QWidget* LiveControlPanel::buildRecording() {
  auto* box = new QGroupBox(tr("Recording"));
  auto* column = new QVBoxLayout(box);
  record_ = pushButton(tr("Record"), "record",
                       tr("Records the raw reports; written to disk every second (R; Shift+R ends it)"));
  record_->setCheckable(true);
  pause_ = pushButton(tr("Freeze display"), "pause",
                      tr("Freezes the pictures and curves; the board and a recording continue (Space)"));
  pause_->setCheckable(true);
  column->addWidget(record_);
  file_ = new QLineEdit(QDir::home().filePath("touch.palprec"));
  file_->setObjectName("recordFile");
  file_->setToolTip(tr("File for the raw reports; if it exists, the next recording gets date and time in its name"));
  auto* choose = pushButton(tr("..."), "chooseRecordFile", tr("Selects the file of the recording"));
  choose->setMaximumWidth(32);
  column->addLayout(beside({file_, choose}));
  recorded_ = words("recorded", "hint");
  recorded_->setAlignment(Qt::AlignTop);
  recorded_->setMinimumHeight(2 * recorded_->fontMetrics().lineSpacing()); // what it says moves nothing below
  column->addWidget(recorded_);
  mark_ = new QLineEdit;
  mark_->setObjectName("markText");
  mark_->setPlaceholderText(tr("mark 1"));
  mark_->setToolTip(tr("Text of the event mark in the curves and in the recording"));
  auto* mark = pushButton(tr("Mark"), "mark", tr("Adds an event mark now (M)"));
  column->addLayout(beside({mark_, mark}));
  auto* csv = pushButton(tr("Export CSV..."), "exportLive",
                         tr("Exports time, forces and deviations [N], resistances [ohm], marks and temperature: every "
                            "frame of a recording, or of a board the frames in the curves, at most the last 60 s"));
  column->addLayout(beside({pause_, csv}));
  connect(file_, &QLineEdit::textChanged, this, &LiveControlPanel::lookForFile);
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString file = askFileToSave(this, tr("Record to"), file_->text(), tr("Recordings (*.palprec)"));
    if (file.isEmpty()) return;
    file_->setText(file);
    replaceable_ = QFile::exists(file) ? file : QString(); // the dialog has asked
    lookForFile();
  });
  connect(record_, &QPushButton::clicked, this, &LiveControlPanel::record);
  connect(pause_, &QPushButton::clicked, this, [this] { emit pauseAsked(pause_->isChecked()); });
  connect(mark_, &QLineEdit::returnPressed, mark, &QPushButton::click);
  connect(mark, &QPushButton::clicked, this, [this] {
    emit markAsked(markText());
    mark_->clear();
    mark_->setPlaceholderText(tr("mark %1").arg(++marks_ + 1));
  });
  connect(csv, &QPushButton::clicked, this, [this] {
    std::filesystem::path name = settings_.source == LiveSourceKind::Recording ? settings_.recording : "live";
    const QString proposal = QString::fromStdString(name.replace_extension(".csv").string());
    const QString file = askFileToSave(this, tr("Export CSV"), proposal, tr("Tables (*.csv)"));
    if (!file.isEmpty()) emit exportAsked(file);
  });
  return box;
}

QWidget* LiveControlPanel::buildAlarm() {
  auto* box = new QGroupBox(tr("Alarm"));
  auto* row = new QHBoxLayout(box);
  alarmOn_ = new QCheckBox(tr("On"));
  alarmOn_->setObjectName("alarmOn");
  alarmOn_->setAccessibleName(tr("Alarm"));
  alarmOn_->setToolTip(
      tr("Triggers when the decoded force on any area exceeds the limit; the alarm is marked in the curves and in a "
         "recording. A force below its noise counts as zero. The alarm works while another scene is shown; the board "
         "is then read and decoded, which uses a few per cent of a core."));
  alarmForce_ = new QComboBox;
  alarmForce_->setObjectName("alarmForce");
  for (const auto& [value, text] : kForceQuantities.all()) alarmForce_->addItem(text, static_cast<int>(value));
  alarmForce_->setToolTip(tr("Monitored component of the force on every area; |F| is the magnitude of the force"));
  alarmSide_ = new QComboBox;
  alarmSide_->setObjectName("alarmSide");
  for (const auto& [value, text] : kAlarmSides.all()) alarmSide_->addItem(tr(text), static_cast<int>(value));
  alarmSide_->setToolTip(tr("Side of the limit on which the alarm triggers; a push is negative in z"));
  alarmLimit_ = new NumberBox;
  alarmLimit_->setObjectName("alarmLimit");
  alarmLimit_->setRange(-1000, 1000);
  alarmLimit_->setDecimals(2);
  alarmLimit_->setSingleStep(0.5);
  alarmLimit_->setSuffix(tr(" N"));
  alarmLimit_->setKeyboardTracking(false); // no alarm at a limit that is half typed
  alarmLimit_->setToolTip(
      tr("Limit of the alarm [N]; the alarm ends when the forces on all areas have returned by 5 % of it"));
  for (QWidget* widget : {static_cast<QWidget*>(alarmOn_), static_cast<QWidget*>(alarmForce_),
                          static_cast<QWidget*>(alarmSide_), static_cast<QWidget*>(alarmLimit_)})
    row->addWidget(widget);
  alarmLimit_->setMinimumWidth(72);
  connect(alarmOn_, &QCheckBox::toggled, this,
          [this](bool on) { edit(tr("alarm"), [&](LiveSettings& settings) { settings.alarmOn = on; }); });
  connect(alarmForce_, &QComboBox::currentIndexChanged, this, [this](int index) {
    edit(tr("alarm"), [&](LiveSettings& s) {
      s.alarm.quantity = static_cast<ForceQuantity>(index);
      if (s.alarm.quantity != ForceQuantity::Size || s.alarm.limit_N > 0) return;
      s.alarm.side = AlarmSide::Above; // a size is never below 0
      s.alarm.limit_N = std::max(0.1, -s.alarm.limit_N);
    });
  });
  connect(alarmSide_, &QComboBox::currentIndexChanged, this, [this](int index) {
    edit(tr("alarm"), [&](LiveSettings& settings) { settings.alarm.side = static_cast<AlarmSide>(index); });
  });
  connect(alarmLimit_, &QDoubleSpinBox::valueChanged, this,
          [this](double value) { edit(tr("alarm"), [&](LiveSettings& settings) { settings.alarm.limit_N = value; }); });
  return box;
}

QWidget* LiveControlPanel::buildScales() {
  auto* box = new QGroupBox(tr("Scales (the same for all frames)"));
  auto* form = new QFormLayout(box);
  arrow_ = new NumberBox;
  arrow_->setObjectName("arrowScale");
  arrow_->setRange(0.1, 100);
  arrow_->setSingleStep(0.5);
  arrow_->setDecimals(1);
  arrow_->setSuffix(tr(" mm/N"));
  arrow_->setToolTip(tr("Length of a force arrow [mm/N]"));
  change_ = new QComboBox;
  change_->setObjectName("changeScale");
  for (const char* percent : {"0.005", "0.01", "0.02", "0.05", "0.1", "0.2", "0.3", "0.5", "1", "2", "5"})
    change_->addItem(QString::fromUtf8("\u00b1%1 %").arg(percent), QString(percent).toDouble());
  change_->setToolTip(tr("End of the colour scale and of the dR/R curves [%]"));
  window_ = new WholeBox;
  window_->setObjectName("window");
  window_->setRange(1, 60);
  window_->setSuffix(tr(" s"));
  window_->setToolTip(tr("Time span of the curves [s]"));
  form->addRow(tr("Arrows"), arrow_);
  form->addRow(tr("dR/R"), change_);
  form->addRow(tr("Curves"), window_);
  force_ = new QComboBox;
  force_->setObjectName("forceScale");
  force_->addItem(tr("Range of the network"), 0.0);
  force_->addItem(tr("Automatic"), -1.0);
  for (const double newton : {0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0})
    force_->addItem(QString::fromUtf8("\u00b1%1 N").arg(newton), newton);
  force_->setToolTip(tr("Scale of the force curves: the training range of the network, automatic, or fixed"));
  form->addRow(tr("Force"), force_);
  connect(force_, &QComboBox::currentIndexChanged, this, [this] {
    const double value = force_->currentData().toDouble();
    edit(tr("scale of the force"), [&](LiveSettings& settings) {
      settings.forceScale = value > 0 ? ForceScale::Fixed : value < 0 ? ForceScale::Automatic : ForceScale::Network;
      if (value > 0) settings.force_N = value;
    });
  });
  connect(arrow_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    edit(tr("scale of the arrows"), [&](LiveSettings& settings) { settings.arrow_mm_per_N = value; });
  });
  connect(change_, &QComboBox::currentIndexChanged, this, [this] {
    edit(tr("scale of dR/R"), [&](LiveSettings& s) { s.change_percent = change_->currentData().toDouble(); });
  });
  connect(window_, &QSpinBox::valueChanged, this, [this](int value) {
    edit(tr("time of the curves"), [&](LiveSettings& settings) { settings.window_s = value; });
  });
  return box;
}

void LiveControlPanel::edit(const QString& what, const std::function<void(LiveSettings&)>& change) {
  LiveSettings next = settings_;
  change(next);
  if (next == settings_) return;
  settings_ = next;
  emit edited(what, next);
}

void LiveControlPanel::chooseNetwork() {
  const QString file = askFileToOpen(this, tr("Open a network"), tr("Networks (*.json)"));
  if (!file.isEmpty()) useNetwork(file.toStdString());
}

/// In place of one that was calibrated, too.
void LiveControlPanel::useNetwork(const std::string& file) {
  edit(tr("network"), [&](LiveSettings& settings) {
    settings.network = file;
    settings.calibrated.reset();
  });
}

QString LiveControlPanel::markText() const {
  return mark_->text().isEmpty() ? mark_->placeholderText() : mark_->text();
}

void LiveControlPanel::record() {
  const QString file = file_->text();
  emit recordAsked(file, file == std::exchange(replaceable_, QString()));
}

void LiveControlPanel::display(const LiveSettings& settings) {
  settings_ = settings;
  const QSignalBlocker quietForce(force_), quietChange(change_), quietWindow(window_), quietTare(tareFrames_);
  const QSignalBlocker quietOn(alarmOn_), quietWhich(alarmForce_), quietSide(alarmSide_), quietLimit(alarmLimit_);
  alarmOn_->setChecked(settings.alarmOn);
  alarmForce_->setCurrentIndex(static_cast<int>(settings.alarm.quantity));
  alarmSide_->setCurrentIndex(static_cast<int>(settings.alarm.side));
  showExactly(*alarmLimit_, settings.alarm.limit_N);
  showExactly(*arrow_, settings.arrow_mm_per_N);
  if (window_->value() != static_cast<int>(settings.window_s)) window_->setValue(static_cast<int>(settings.window_s));
  if (tareFrames_->value() != settings.tareFrames) tareFrames_->setValue(settings.tareFrames);
  int place = change_->findData(settings.change_percent);
  if (place < 0) {
    change_->addItem(QString::fromUtf8("\u00b1%1 %").arg(settings.change_percent), settings.change_percent);
    place = change_->count() - 1;
  }
  change_->setCurrentIndex(place);
  double force = settings.forceScale == ForceScale::Automatic ? -1 : 0;
  if (settings.forceScale == ForceScale::Fixed) force = settings.force_N;
  if (force_->findData(force) < 0) force_->addItem(QString::fromUtf8("\u00b1%1 N").arg(force), force);
  force_->setCurrentIndex(force_->findData(force));
}

void LiveControlPanel::displayNetworkProblem(const QString& sentence) {
  networkRefused_ = sentence;
  setText(*networkProblem_, sentence);
}

void LiveControlPanel::displayRecording(const QString& file, const QString& problem) {
  if (problem.isEmpty()) {
    file_->setText(file);
    file_->setCursorPosition(static_cast<int>(file.size())); // its name is seen
    recordedLast_.clear();
  }
  recordingProblem_ = problem;
  if (!problem.isEmpty()) record_->setChecked(false);
}

void LiveControlPanel::displayTare(const LiveStatus& status) {
  const QString rest = QString::fromStdString(status.restName);
  QString state = rest.isEmpty() ? tr("Not tared.") : tr("Not tared: changes are relative to %1.").arg(rest);
  if (status.tareOfRecording) state = tr("Tared as recorded.");
  if (status.tared && !status.tareOfRecording)
    state = tr("Tared (mean of %1 frames).").arg(status.tare ? status.tare->frames : 0);
  if (status.taring) state = tr("Waiting for the sensor to be at rest, then taring...");
  if (tareState_->text() != state) tareState_->setText(state);
}

/// That the next recording gets another name is said before it is made.
void LiveControlPanel::lookForFile() {
  const QFileInfo wanted(file_->text());
  fileThere_ = file_->text() != replaceable_ && wanted.isFile() ? wanted.fileName() : QString();
}

void LiveControlPanel::displayState(const LiveControlState& state) {
  const LiveStatus& status = state.status;
  setText(*network_, state.network);
  setText(*networkProblem_,
          networkRefused_.isEmpty() ? QString::fromStdString(status.decoderProblem) : networkRefused_);
  back_->setEnabled(!state.networkBefore.isEmpty());
  shipped_->setEnabled(!settings_.network.empty() || settings_.calibrated || !state.networkBefore.isEmpty());
  const QString back = state.networkBefore.isEmpty() ? tr("Uses the previous network again; there is none yet")
                                                     : tr("Uses again: %1").arg(state.networkBefore);
  if (back_->toolTip() != back) back_->setToolTip(back);
  tare_->setText(status.taring          ? tr("Waiting for rest")
                 : status.driftsOn      ? tr("Tare (still drifting)")
                 : status.tareSuggested ? tr("Tare now (drifted)")
                                        : tr("Tare"));
  tare_->setToolTip(status.tareSuggested ? driftWords(status) : tr(kTareTip));
  tare_->setDefault(status.tareSuggested);
  clearTare_->setEnabled(status.tared);
  displayTare(status);
  pause_->setChecked(state.paused);
  const bool records = status.recording || status.recordingWaits;
  const bool ends = records_ && !records;
  if (std::exchange(records_, records) != records) lookForFile();
  record_->setChecked(records);
  record_->setText(records           ? state.replaying ? tr("Stop the copy") : tr("Stop recording")
                             : state.replaying ? tr("Record what is played")
                                     : tr("Record"));
  const QString problem =
      recordingProblem_.isEmpty() ? QString::fromStdString(status.recordingFailure) : recordingProblem_;
  if (records || ends) // of the end too: the last look was before it
    recordedLast_ = tr("%1 s, %2 MB, %3 reports dropped")
                        .arg(state.recorded_s, 0, 'f', 1)
                        .arg(static_cast<double>(status.recordedReports) * kRecordedReport / kMegabyte, 0, 'f', 1)
                        .arg(status.recordingDropped);
  QString recorded = fileThere_.isEmpty()
                         ? state.replaying ? tr("Not recording. A copy contains what is played from its start on.")
                                           : tr("Not recording.")
                         : tr("%1 exists: the next recording gets date and time in its name.").arg(fileThere_);
  if (!problem.isEmpty())
    recorded = problem;
  else if (status.recordingWaits)
    recorded = tr("Waiting for the board, then continuing: %1").arg(recordedLast_);
  else if (!recordedLast_.isEmpty())
    recorded = records ? tr("Recording: %1").arg(recordedLast_)
                       : tr("Recorded: %1; the next recording gets a name of its own").arg(recordedLast_);
  setRole(*recorded_, problem.isEmpty() ? "hint" : "problem");
  setText(*recorded_, recorded);
}

} // namespace palp
