#include "app/gui/live/LiveSourcePanel.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

/// What a row of the list chooses.
enum DeviceRole { KindRole = Qt::UserRole, DeviceNameRole };

QComboBox* numberBox(const QString& name, const QStringList& values, const QString& tip) {
  auto* box = new QComboBox;
  box->setObjectName(name);
  box->setEditable(true);
  box->setInsertPolicy(QComboBox::NoInsert);
  box->addItems(values);
  box->setToolTip(tip);
  return box;
}

QSpinBox* wireBox(const QString& name, int most, const QString& tip) {
  auto* box = new QSpinBox;
  box->setObjectName(name);
  box->setRange(-1, most);
  box->setSpecialValueText(QObject::tr("none"));
  box->setToolTip(tip);
  return box;
}

QString stateWords(const LiveStatus& status) {
  if (status.state == LiveState::Streaming && status.recording) return QObject::tr("streaming, recording");
  return QString::fromLatin1(name(status.state));
}

} // namespace

LiveSourcePanel::LiveSourcePanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(buildDevices());
  column->addWidget(buildReplay());
  column->addWidget(buildSimulation());
  column->addWidget(buildScan());
}

QWidget* LiveSourcePanel::buildDevices() {
  auto* box = new QGroupBox(tr("Source"));
  auto* column = new QVBoxLayout(box);
  devices_ = new QListWidget;
  devices_->setObjectName("devices");
  devices_->setToolTip(tr("Boards that are plugged in, with their state; click one to listen to it"));
  devices_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  devices_->setTextElideMode(Qt::ElideMiddle);
  column->addWidget(devices_);
  reason_ = new QLabel;
  reason_->setObjectName("sourceReason");
  reason_->setWordWrap(true);
  reason_->setProperty("role", "problem");
  reason_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(reason_);
  copyRemedy_ = new QPushButton(tr("Copy the command"));
  copyRemedy_->setObjectName("copyRemedy");
  copyRemedy_->setToolTip(tr("Copies the command that installs the udev rule"));
  column->addWidget(copyRemedy_);
  again_ = new QPushButton(tr("Open again"));
  again_->setObjectName("openAgain");
  again_->setToolTip(tr("Opens the source once more; a recording plays from its start"));
  column->addWidget(again_);
  auto* open = new QPushButton(tr("Open a recording..."));
  open->setObjectName("openRecording");
  open->setToolTip(tr("Plays a file of palp listen --record"));
  column->addWidget(open);
  connect(devices_, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* item) { chooseDevice(devices_->row(item)); });
  connect(devices_, &QListWidget::itemActivated, this,
          [this](QListWidgetItem* item) { chooseDevice(devices_->row(item)); });
  connect(again_, &QPushButton::clicked, this, &LiveSourcePanel::openAgainAsked);
  connect(open, &QPushButton::clicked, this, &LiveSourcePanel::chooseRecording);
  connect(copyRemedy_, &QPushButton::clicked, this, [] {
    const QString remedy = QString::fromStdString(permissionRemedy());
    QApplication::clipboard()->setText(remedy.section(": ", 1).section(" (", 0, 0));
  });
  return box;
}

QWidget* LiveSourcePanel::buildScan() {
  auto* box = new QGroupBox(tr("Scan"));
  auto* form = new QFormLayout(box);
  rate_ = new QSpinBox;
  rate_->setObjectName("rate");
  rate_->setRange(1, 8000);
  rate_->setSuffix(tr(" reports/s"));
  rate_->setKeyboardTracking(false);
  rate_->setToolTip(tr("Reports a second that the board is asked to send [1/s]; two reports are one row-wire of 30"));
  rows_ = new QComboBox;
  rows_->setObjectName("rows");
  rows_->addItem(tr("all row-wires"));
  for (int row = 0; row < 32; ++row) rows_->addItem(tr("row-wire %1 alone").arg(row));
  rows_->setToolTip(tr("One row-wire alone, as in the paper, is scanned ten times as often"));
  form->addRow(tr("Rate"), rate_);
  form->addRow(tr("Rows"), rows_);
  connect(rate_, &QSpinBox::valueChanged, this,
          [this](int value) { edit(tr("report rate"), [&](LiveSettings& settings) { settings.rate_Hz = value; }); });
  connect(rows_, &QComboBox::currentIndexChanged, this,
          [this](int index) { edit(tr("scanned rows"), [&](LiveSettings& settings) { settings.row = index - 1; }); });
  return box;
}

QWidget* LiveSourcePanel::buildSimulation() {
  simulation_ = new QGroupBox(tr("Simulated board"));
  auto* form = new QFormLayout(simulation_);
  buildDisturbances(*form);
  buildFaults(*form);
  plug_ = new QPushButton(tr("Pull out"));
  plug_->setObjectName("plug");
  plug_->setToolTip(tr("Pulls the simulated board out, or puts it in again"));
  form->addRow(plug_);
  connect(plug_, &QPushButton::clicked, this, [this] { emit plugAsked(plug_->text() != tr("Pull out")); });
  return simulation_;
}

/// What `signal` of `box` gives goes into the simulation's settings.
template <class Box, class Signal, class Change>
void LiveSourcePanel::follow(Box* box, Signal signal, const QString& what, Change change) {
  connect(box, signal, this,
          [this, what, change](auto value) { edit(what, [&](LiveSettings& s) { change(s.simulation, value); }); });
}

/// What makes the readings of a board that works differ from those of a perfect one.
void LiveSourcePanel::buildDisturbances(QFormLayout& form) {
  noise_ = numberBox("noise", {"5e-6", "1e-5", "1e-4"},
                     tr("Noise of a reading, relative to R (rms): 5e-6 is a good board, 1e-4 a plain one"));
  warming_ = new QDoubleSpinBox;
  warming_->setObjectName("warming");
  warming_->setRange(0, 100);
  warming_->setSuffix(tr(" K"));
  warming_->setToolTip(tr("The board warms up by this much [K] with a time constant of 5 min; R drifts by 0.1 %/K"));
  hysteresis_ = new QDoubleSpinBox;
  hysteresis_->setObjectName("hysteresis");
  hysteresis_->setRange(0, 100);
  hysteresis_->setSuffix(tr(" %"));
  hysteresis_->setToolTip(tr("Share of the change of R that goes through a play of 1e-4 of R [%]"));
  form.addRow(tr("Noise"), noise_);
  form.addRow(tr("Warming"), warming_);
  form.addRow(tr("Hysteresis"), hysteresis_);
  connect(noise_, &QComboBox::currentTextChanged, this, [this](const QString& text) {
    bool good = false;
    const double value = text.toDouble(&good);
    if (good && value >= 0 && value <= 1)
      edit(tr("noise"), [&](LiveSettings& settings) { settings.simulation.noise = value; });
  });
  follow(warming_, &QDoubleSpinBox::valueChanged, tr("warming"),
         [](SimulationSettings& s, double value) { s.warming_degC = value; });
  follow(hysteresis_, &QDoubleSpinBox::valueChanged, tr("hysteresis"),
         [](SimulationSettings& s, double value) { s.hysteresisShare = value / 100; });
}

void LiveSourcePanel::buildFaults(QFormLayout& form) {
  openRow_ = wireBox("openRow", 31, tr("This row-wire is broken"));
  openColumn_ = wireBox("openColumn", 254, tr("This column-wire is broken"));
  dropEvery_ = new QSpinBox;
  dropEvery_->setObjectName("dropEvery");
  dropEvery_->setRange(0, 100000);
  dropEvery_->setSpecialValueText(tr("none"));
  dropEvery_->setToolTip(tr("Every n-th report is lost on its way"));
  form.addRow(tr("Broken row-wire"), openRow_);
  form.addRow(tr("Broken column-wire"), openColumn_);
  form.addRow(tr("Lose every n-th"), dropEvery_);
  follow(openRow_, &QSpinBox::valueChanged, tr("broken row-wire"),
         [](SimulationSettings& s, int value) { s.openRow = value; });
  follow(openColumn_, &QSpinBox::valueChanged, tr("broken column-wire"),
         [](SimulationSettings& s, int value) { s.openColumn = value; });
  follow(dropEvery_, &QSpinBox::valueChanged, tr("lost reports"),
         [](SimulationSettings& s, int value) { s.dropEvery = value; });
}

QWidget* LiveSourcePanel::buildReplay() {
  replay_ = new QGroupBox(tr("Replay"));
  auto* form = new QFormLayout(replay_);
  speed_ = numberBox("replaySpeed", {"0.1", "0.5", "1", "2", "10", "0"},
                     tr("Times as fast as it was recorded; 0: as fast as it can be read"));
  form->addRow(tr("Speed"), speed_);
  auto* row = new QHBoxLayout;
  pause_ = new QPushButton;
  pause_->setObjectName("replayPause");
  pause_->setToolTip(tr("Holds the recording, or goes on (Space)"));
  step_ = new QPushButton(tr("One frame on"));
  step_->setObjectName("replayStep");
  step_->setToolTip(tr("Goes on by one frame and holds (Period)"));
  row->addWidget(pause_);
  row->addWidget(step_);
  form->addRow(row);
  connect(speed_, &QComboBox::currentTextChanged, this, [this](const QString& text) {
    bool good = false;
    const double value = text.toDouble(&good);
    if (good && value >= 0 && value <= 1000)
      edit(tr("replay speed"), [&](LiveSettings& settings) { settings.replaySpeed = value; });
  });
  connect(pause_, &QPushButton::clicked, this, [this] { emit pauseAsked(pause_->text() == tr("Hold")); });
  connect(step_, &QPushButton::clicked, this, [this] { emit stepAsked(1); });
  replay_->hide();
  return replay_;
}

void LiveSourcePanel::edit(const QString& what, const std::function<void(LiveSettings&)>& change) {
  LiveSettings next = settings_;
  change(next);
  if (next == settings_) return;
  settings_ = next;
  emit edited(what, next);
}

void LiveSourcePanel::chooseDevice(int row) {
  const QListWidgetItem* item = devices_->item(row);
  if (item == nullptr) return;
  edit(tr("source"), [&](LiveSettings& settings) {
    settings.source = static_cast<LiveSourceKind>(item->data(KindRole).toInt());
    if (settings.source == LiveSourceKind::Board) settings.device = item->data(DeviceNameRole).toString().toStdString();
  });
}

void LiveSourcePanel::chooseRecording() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Open a recording"), {}, tr("Recordings (*.palprec);;All files (*)"));
  if (file.isEmpty()) return;
  edit(tr("source"), [&](LiveSettings& settings) {
    settings.source = LiveSourceKind::Recording;
    settings.recording = file.toStdString();
  });
}

void LiveSourcePanel::display(const LiveSettings& settings) {
  settings_ = settings;
  const auto put = [](auto* box, auto value) {
    const QSignalBlocker quiet(box);
    box->setValue(value);
  };
  const auto type = [](QComboBox* box, double value) {
    const QSignalBlocker quiet(box);
    if (box->currentText().toDouble() != value || box->currentText().isEmpty())
      box->setEditText(QString::number(value, 'g', 6));
  };
  put(rate_, settings.rate_Hz);
  put(warming_, settings.simulation.warming_degC);
  put(hysteresis_, 100 * settings.simulation.hysteresisShare);
  put(openRow_, settings.simulation.openRow);
  put(openColumn_, settings.simulation.openColumn);
  put(dropEvery_, settings.simulation.dropEvery);
  type(noise_, settings.simulation.noise);
  type(speed_, settings.replaySpeed);
  const QSignalBlocker quiet(rows_);
  rows_->setCurrentIndex(settings.row + 1);
}

/// Automatic, every board, the virtual one, the recording; the one in use with its state.
void LiveSourcePanel::listDevices(const LiveSourceState& state) {
  struct Line {
    QString text;
    LiveSourceKind kind;
    QString device;
  };
  const QString now = stateWords(state.status);
  const auto stated = [&](const QString& text, bool inUse, const QString& otherwise = {}) {
    const QString words = inUse ? now : otherwise;
    return words.isEmpty() ? text : text + QString::fromUtf8(" \u2014 ") + words;
  };
  std::vector<Line> lines{{stated(tr("First board, else simulated"), settings_.source == LiveSourceKind::Automatic),
                           LiveSourceKind::Automatic,
                           {}}};
  for (const HidBoard& board : state.boards) {
    const QString place = QString::fromStdString(board.path);
    const bool inUse = settings_.source == LiveSourceKind::Board &&
                       (settings_.device == board.serial || settings_.device == board.path);
    const bool twins = std::count_if(state.boards.begin(), state.boards.end(),
                                     [&](const HidBoard& other) { return other.serial == board.serial; }) > 1;
    lines.push_back({stated(QString::fromStdString(board.serial) + tr(" at ") + place, inUse,
                            board.permission ? tr("ready") : tr("no permission")),
                     LiveSourceKind::Board, twins ? place : QString::fromStdString(board.serial)});
  }
  if (settings_.source == LiveSourceKind::Board && state.boards.empty())
    lines.push_back({stated(QString::fromStdString(settings_.device), true), LiveSourceKind::Board,
                     QString::fromStdString(settings_.device)});
  lines.push_back(
      {stated(tr("Simulated board"), settings_.source == LiveSourceKind::Simulated), LiveSourceKind::Simulated, {}});
  if (!settings_.recording.empty())
    lines.push_back({stated(QFileInfo(QString::fromStdString(settings_.recording)).fileName(),
                            settings_.source == LiveSourceKind::Recording),
                     LiveSourceKind::Recording,
                     {}});
  QStringList texts;
  for (const Line& line : lines) texts << line.text + line.device;
  if (texts == listed_) return;
  listed_ = texts;
  devices_->clear();
  for (const Line& line : lines) {
    auto* item = new QListWidgetItem(line.text, devices_);
    item->setData(KindRole, static_cast<int>(line.kind));
    item->setData(DeviceNameRole, line.device);
    item->setToolTip(line.text);
    const bool chosen = line.kind == settings_.source &&
                        (line.kind != LiveSourceKind::Board || line.device.toStdString() == settings_.device);
    if (chosen) devices_->setCurrentItem(item);
  }
  devices_->setFixedHeight(devices_->sizeHintForRow(0) * devices_->count() + 2 * devices_->frameWidth() + 2);
}

void LiveSourcePanel::displayState(const LiveSourceState& state) {
  listDevices(state);
  const LiveState now = state.status.state;
  const QString reason = QString::fromStdString(state.status.reason);
  const bool forbidden = now == LiveState::Refused && reason.contains("permission");
  if (reason_->text() != reason) reason_->setText(reason);
  reason_->setVisible(!reason.isEmpty());
  copyRemedy_->setVisible(forbidden);
  again_->setVisible(now == LiveState::Ended || now == LiveState::Refused);
  simulation_->setVisible(state.simulated);
  replay_->setVisible(state.replaying);
  plug_->setText(state.pluggedIn ? tr("Pull out") : tr("Plug in"));
  pause_->setText(state.paused ? tr("Go on") : tr("Hold"));
  pause_->setEnabled(now != LiveState::Ended);
  step_->setEnabled(now != LiveState::Ended);
  rate_->setEnabled(!state.replaying);
  rows_->setEnabled(!state.replaying);
}

} // namespace palp
