#include "app/gui/live/panels/LiveSourcePanel.h"

#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QComboBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

constexpr int kFewestLines = 4; // of the list: what comes and goes in it moves nothing below

/// What a row of the list chooses.
enum DeviceRole { KindRole = Qt::UserRole, DeviceNameRole };

QString stateWords(const LiveStatus& status) {
  if (status.state == LiveState::Streaming && status.recording) return QObject::tr("streaming, recording");
  return QString::fromLatin1(name(status.state));
}

} // namespace

LiveSourcePanel::LiveSourcePanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(buildDevices());
  column->addWidget(buildScan());
  listDevices({}); // nothing moves when the first state comes
}

QWidget* LiveSourcePanel::buildDevices() {
  auto* box = new QGroupBox(tr("Source"));
  auto* column = new QVBoxLayout(box);
  devices_ = new QListWidget;
  devices_->setObjectName("devices");
  devices_->setToolTip(tr("Boards that are plugged in, with their state; click a board to listen to it"));
  devices_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  devices_->setTextElideMode(Qt::ElideMiddle);
  column->addWidget(devices_);
  again_ = new QPushButton(tr("Reopen"));
  again_->setObjectName("openAgain");
  again_->setToolTip(tr("Opens the source again; a recording plays from its start"));
  auto* open = new QPushButton(tr("Open a recording..."));
  open->setObjectName("openRecording");
  open->setToolTip(tr("Plays a file that was recorded here or on the command line"));
  auto* row = new QHBoxLayout;
  row->addWidget(open);
  row->addWidget(again_);
  column->addLayout(row);
  another_ = new QPushButton(tr("Add board"));
  another_->setObjectName("anotherBoard");
  another_->setToolTip(tr("Shows another board next to this one, with its own settings, tare and recording; without a "
                          "second board it is a simulated one"));
  column->addWidget(another_);
  connect(another_, &QPushButton::clicked, this, &LiveSourcePanel::anotherAsked);
  connect(devices_, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* item) { chooseDevice(devices_->row(item)); });
  connect(devices_, &QListWidget::itemActivated, this,
          [this](QListWidgetItem* item) { chooseDevice(devices_->row(item)); });
  connect(again_, &QPushButton::clicked, this, &LiveSourcePanel::openAgainAsked);
  connect(open, &QPushButton::clicked, this, &LiveSourcePanel::chooseRecording);
  return box;
}

QWidget* LiveSourcePanel::buildScan() {
  auto* box = new QGroupBox(tr("Scan"));
  auto* form = new QFormLayout(box);
  rate_ = new WholeBox;
  rate_->setObjectName("rate");
  rate_->setRange(1, 8000);
  rate_->setSuffix(tr(" reports/s"));
  rate_->setKeyboardTracking(false);
  rate_->setToolTip(tr("Requested reports per second [1/s]; one row-wire of 30 readings takes two reports"));
  rows_ = new QComboBox;
  rows_->setObjectName("rows");
  rows_->addItem(tr("All row-wires"));
  rows_->setToolTip(tr("Scanned row-wires; a single row-wire, as in the paper, is read ten times as often"));
  form->addRow(tr("Rate"), rate_);
  form->addRow(tr("Rows"), rows_);
  connect(rate_, &QSpinBox::valueChanged, this,
          [this](int value) { edit(tr("report rate"), [&](LiveSettings& settings) { settings.rate_Hz = value; }); });
  connect(rows_, &QComboBox::currentIndexChanged, this,
          [this](int index) { edit(tr("scanned rows"), [&](LiveSettings& settings) { settings.row = index - 1; }); });
  return box;
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
      askFileToOpen(this, tr("Open a recording"), tr("Recordings (*.palprec);;All files (*)"), recordings_);
  if (file.isEmpty()) return;
  edit(tr("source"), [&](LiveSettings& settings) {
    settings.source = LiveSourceKind::Recording;
    settings.recording = file.toStdString();
  });
}

void LiveSourcePanel::display(const LiveSettings& settings) {
  settings_ = settings;
  listed_.clear(); // so that the line in use is the chosen one again
  const QSignalBlocker quietRate(rate_);
  rate_->setValue(settings.rate_Hz);
  listRows(rows_->count() - 1);
}

/// Those that there are, and one that was chosen on another board.
void LiveSourcePanel::listRows(int rowWires) {
  const QSignalBlocker quiet(rows_);
  const int wanted = 1 + std::max(rowWires, settings_.row + 1);
  while (rows_->count() > wanted) rows_->removeItem(rows_->count() - 1);
  while (rows_->count() < wanted) rows_->addItem(tr("Row-wire %1 alone").arg(rows_->count() - 1));
  rows_->setCurrentIndex(settings_.row + 1);
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
  for (const LiveSourceState::Board& board : state.boards) {
    const QString place = QString::fromStdString(board.path);
    const bool inUse = settings_.source == LiveSourceKind::Board &&
                       (settings_.device == board.serial || settings_.device == board.path);
    const bool twins = std::count_if(state.boards.begin(), state.boards.end(),
                                     [&](const HidBoard& other) { return other.serial == board.serial; }) > 1;
    lines.push_back({stated(QString::fromStdString(board.serial) + tr(" at ") + place, inUse,
                            !board.free        ? tr("shown in another view")
                            : board.permission ? tr("ready")
                                               : tr("no permission")),
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
  devices_->setFixedHeight(devices_->sizeHintForRow(0) * std::max(kFewestLines, devices_->count()) +
                           2 * devices_->frameWidth() + 2);
}

void LiveSourcePanel::setMoreAllowed(bool allowed) {
  another_->setEnabled(allowed);
}

void LiveSourcePanel::displayState(const LiveSourceState& state) {
  listDevices(state);
  listRows(state.rowWires);
  recordings_ = state.recordings;
  const LiveState now = state.status.state;
  again_->setEnabled(now == LiveState::Ended || now == LiveState::Refused);
  rate_->setEnabled(!state.replaying);
  rows_->setEnabled(!state.replaying);
}

} // namespace palp
