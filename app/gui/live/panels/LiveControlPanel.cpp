#include "app/gui/live/panels/LiveControlPanel.h"

#include "app/gui/live/LiveNews.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStyle>
#include <QVBoxLayout>

namespace palp {

namespace {

constexpr const char* kTareTip = QT_TR_NOOP("Takes the next frames as rest; waits while the sensor is moving (T)");
constexpr double kMegabyte = 1e6;
constexpr double kRecordedReport = 64 + 12; // bytes with kind, length and time

QLabel* words(const QString& name, const char* role) {
  auto* label = textLabel(name, role);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
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

/// Selects a scale; one that is not in the list is added.
void showScale(QComboBox& scales, double value, const char* unit) {
  if (scales.findData(value) < 0) scales.addItem(QString::fromUtf8("\u00b1%1 %2").arg(value).arg(unit), value);
  scales.setCurrentIndex(scales.findData(value));
}

} // namespace

LiveControlPanel::LiveControlPanel(QWidget* parent)
    : QWidget(parent), fields_([this](const QString& what, const LiveSettings& next) { emit edited(what, next); }) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  recording_ = buildRecording();
  addTo(*column, {recording_, buildNetwork(), buildAlarm(), buildScales(), Part::stretch()});
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
  column->addLayout(inRow({open, shipped_}));
  column->addWidget(back_);
  auto* frames =
      fields_.bind(wholeBox("tareFrames", {.low = 1, .high = 100000, .unit = tr(" frames"), .whileTyping = true},
                            tr("Number of frames averaged as rest; more frames reduce the noise of the zero")),
                   tr("Change the frames of the tare"), &LiveSettings::tareFrames);
  tare_ = pushButton(tr("Tare"), "tare", tr(kTareTip));
  clearTare_ = pushButton(tr("Clear"), "clearTare",
                          tr("Clears the tare: changes are then relative to the design's resistances at rest"));
  column->addLayout(inRow({tare_, frames, clearTare_}));
  tareState_ = words("tareState", "hint");
  tareState_->setText(tr("Not tared."));
  column->addWidget(tareState_);
  column->addWidget(networkProblem_); // below: no button moves when it comes
  connect(open, &QPushButton::clicked, this, &LiveControlPanel::chooseNetwork);
  connect(shipped_, &QPushButton::clicked, this, [this] {
    if (fields_.settings().network.empty() && !fields_.settings().calibrated) return emit shippedRequested();
    useNetwork({});
  });
  connect(back_, &QPushButton::clicked, this, &LiveControlPanel::backRequested);
  connect(tare_, &QPushButton::clicked, this, &LiveControlPanel::tareRequested);
  connect(clearTare_, &QPushButton::clicked, this, &LiveControlPanel::clearTareRequested);
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
  column->addLayout(inRow({file_, choose}));
  recorded_ = words("recorded", "hint");
  recorded_->setAlignment(Qt::AlignTop);
  recorded_->setMinimumHeight(2 * recorded_->fontMetrics().lineSpacing()); // its text moves nothing below
  column->addWidget(recorded_);
  mark_ = lineEdit("markText", tr("Text of the event mark in the curves and in the recording"));
  mark_->setPlaceholderText(tr("mark 1"));
  auto* mark = pushButton(tr("Mark"), "mark", tr("Adds an event mark now (M)"));
  column->addLayout(inRow({mark_, mark}));
  auto* csv = pushButton(tr("Export CSV..."), "exportLive",
                         tr("Exports time, forces and deviations [N], resistances [ohm], marks and temperature: every "
                            "frame of a recording, or of a board the frames in the curves, at most the last 60 s"));
  column->addLayout(inRow({pause_, csv}));
  connect(file_, &QLineEdit::textChanged, this, &LiveControlPanel::lookForFile);
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString file = askFileToSave(this, tr("Record to"), file_->text(), tr("Recordings (*.palprec)"));
    if (file.isEmpty()) return;
    file_->setText(file);
    replaceable_ = QFile::exists(file) ? file : QString(); // confirmed in the dialog
    lookForFile();
  });
  connect(record_, &QPushButton::clicked, this, &LiveControlPanel::record);
  connect(pause_, &QPushButton::clicked, this, [this] { emit pauseRequested(pause_->isChecked()); });
  connect(mark_, &QLineEdit::returnPressed, mark, &QPushButton::click);
  connect(mark, &QPushButton::clicked, this, [this] {
    emit markRequested(markText());
    mark_->clear();
    mark_->setPlaceholderText(tr("mark %1").arg(++marks_ + 1));
  });
  connect(csv, &QPushButton::clicked, this, [this] {
    std::filesystem::path name =
        fields_.settings().source == LiveSourceKind::Recording ? fields_.settings().recording : "live";
    const QString proposal = QString::fromStdString(name.replace_extension(".csv").string());
    const QString file = askFileToSave(this, tr("Export CSV"), proposal, tr("Tables (*.csv)"));
    if (!file.isEmpty()) emit exportRequested(file);
  });
  return box;
}

QWidget* LiveControlPanel::buildAlarm() {
  auto* box = new QGroupBox(tr("Alarm"));
  const QString what = tr("Change the alarm");
  auto* on = fields_.bind(
      checkBox(
          tr("On"), "alarmOn",
          tr("Triggers when the decoded force on any area exceeds the limit; the alarm is marked in the curves and "
             "in a recording. A force below its noise counts as zero. The alarm works while another scene is "
             "shown; the board is then read and decoded, which uses a few per cent of a core.")),
      what, &LiveSettings::alarmOn);
  on->setAccessibleName(tr("Alarm"));
  auto* force = choiceBox("alarmForce", textsOf(kForceQuantities),
                          tr("Monitored component of the force on every area; |F| is the magnitude of the force"));
  fields_.add(
      force, &QComboBox::currentIndexChanged, what,
      [this, force] { force->setCurrentIndex(static_cast<int>(fields_.settings().alarm.quantity)); },
      [](LiveSettings& settings, int index) {
        ForceAlarm& alarm = settings.alarm;
        alarm.quantity = static_cast<ForceQuantity>(index);
        if (alarm.quantity != ForceQuantity::Size || alarm.limit_N > 0) return;
        alarm.side = AlarmSide::Above; // a magnitude is never below 0
        alarm.limit_N = std::max(0.1, -alarm.limit_N);
      });
  auto* side = fields_.bind(choiceBox("alarmSide", textsOf(kAlarmSides),
                                      tr("Side of the limit on which the alarm triggers; a push is negative in z")),
                            what, [](LiveSettings& settings) -> AlarmSide& { return settings.alarm.side; });
  auto* limit = fields_.bind(
      numberBox("alarmLimit", {.low = -1000, .high = 1000, .step = 0.5, .unit = tr(" N")},
                tr("Limit of the alarm [N]; the alarm ends when the forces on all areas have returned by 5 % of it")),
      what, [](LiveSettings& settings) -> double& { return settings.alarm.limit_N; });
  limit->setMinimumWidth(72);
  addTo(*new QHBoxLayout(box), {on, force, side, limit});
  return box;
}

QWidget* LiveControlPanel::buildScales() {
  auto* box = new QGroupBox(tr("Scales (the same for all frames)"));
  auto* form = new QFormLayout(box);
  form->addRow(
      tr("Arrows"),
      fields_.bind(
          numberBox("arrowScale",
                    {.low = 0.1, .high = 100, .decimals = 1, .step = 0.5, .unit = tr(" mm/N"), .whileTyping = true},
                    tr("Length of a force arrow [mm/N]")),
          tr("Change the scale of the arrows"), &LiveSettings::arrow_mm_per_N));
  auto* change = choiceBox("changeScale", {}, tr("End of the colour scale and of the dR/R curves [%]"));
  for (const char* percent : {"0.005", "0.01", "0.02", "0.05", "0.1", "0.2", "0.3", "0.5", "1", "2", "5"})
    change->addItem(QString::fromUtf8("\u00b1%1 %").arg(percent), QString(percent).toDouble());
  form->addRow(tr("dR/R"), fields_.add(
                               change, &QComboBox::currentIndexChanged, tr("Change the scale of dR/R"),
                               [this, change] { showScale(*change, fields_.settings().change_percent, "%"); },
                               [change](LiveSettings& settings, int index) {
                                 settings.change_percent = change->itemData(index).toDouble();
                               }));
  form->addRow(tr("Curves"),
               fields_.bind(wholeBox("window", {.low = 1, .high = 60, .unit = tr(" s"), .whileTyping = true},
                                     tr("Time span of the curves [s]")),
                            tr("Change the time span of the curves"), &LiveSettings::window_s));
  auto* force = choiceBox("forceScale", {},
                          tr("Scale of the force curves: the training range of the network, automatic, or fixed"));
  force->addItem(tr("Range of the network"), 0.0);
  force->addItem(tr("Automatic"), -1.0);
  for (const double newton : {0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0})
    force->addItem(QString::fromUtf8("\u00b1%1 N").arg(newton), newton);
  form->addRow(tr("Force"), fields_.add(
                                force, &QComboBox::currentIndexChanged, tr("Change the scale of the force"),
                                [this, force] {
                                  const LiveSettings& settings = fields_.settings();
                                  showScale(*force,
                                            settings.forceScale == ForceScale::Fixed       ? settings.force_N
                                            : settings.forceScale == ForceScale::Automatic ? -1
                                                                                           : 0,
                                            "N");
                                },
                                [force](LiveSettings& settings, int index) {
                                  const double value = force->itemData(index).toDouble();
                                  settings.forceScale = value > 0   ? ForceScale::Fixed
                                                        : value < 0 ? ForceScale::Automatic
                                                                    : ForceScale::Network;
                                  if (value > 0) settings.force_N = value;
                                }));
  return box;
}

void LiveControlPanel::chooseNetwork() {
  const QString file = askFileToOpen(this, tr("Open a network"), tr("Networks (*.json)"));
  if (!file.isEmpty()) useNetwork(file.toStdString());
}

/// In place of one that was calibrated, too.
void LiveControlPanel::useNetwork(const std::string& file) {
  fields_.edit(tr("Change the network"), [&](LiveSettings& settings) {
    settings.network = file;
    settings.calibrated.reset();
  });
}

QString LiveControlPanel::markText() const {
  return mark_->text().isEmpty() ? mark_->placeholderText() : mark_->text();
}

void LiveControlPanel::record() {
  const QString file = file_->text();
  emit recordRequested(file, file == std::exchange(replaceable_, QString()));
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

/// Reports that the next recording gets another name, before it is made.
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
  shipped_->setEnabled(!fields_.settings().network.empty() || fields_.settings().calibrated ||
                       !state.networkBefore.isEmpty());
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
