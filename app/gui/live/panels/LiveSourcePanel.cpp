#include "app/gui/live/panels/LiveSourcePanel.h"

#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QFileInfo>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QListWidget>
#include <QPushButton>
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

LiveSourcePanel::LiveSourcePanel(QWidget* parent)
    : QWidget(parent), fields_([this](const QString& what, const LiveSettings& next) { emit edited(what, next); }) {
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
  again_ = pushButton(tr("Reopen"), "openAgain", tr("Opens the source again; a recording plays from its start"));
  auto* open = pushButton(tr("Open a recording..."), "openRecording",
                          tr("Plays a file that was recorded here or on the command line"));
  auto* row = inRow({open, again_});
  column->addLayout(row);
  another_ = pushButton(tr("Add board"), "anotherBoard",
                        tr("Shows another board next to this one, with its own settings, tare and recording; without a "
                           "second board it is a simulated one"));
  column->addWidget(another_);
  connect(another_, &QPushButton::clicked, this, &LiveSourcePanel::anotherRequested);
  connect(devices_, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* item) { chooseDevice(devices_->row(item)); });
  connect(devices_, &QListWidget::itemActivated, this,
          [this](QListWidgetItem* item) { chooseDevice(devices_->row(item)); });
  connect(again_, &QPushButton::clicked, this, &LiveSourcePanel::openAgainRequested);
  connect(open, &QPushButton::clicked, this, &LiveSourcePanel::chooseRecording);
  return box;
}

QWidget* LiveSourcePanel::buildScan() {
  auto* box = new QGroupBox(tr("Scan"));
  auto* form = new QFormLayout(box);
  rate_ =
      fields_.bind(wholeBox("rate", {.low = 1, .high = 8000, .unit = tr(" reports/s")},
                            tr("Requested reports per second [1/s]; one row-wire of 30 readings takes two reports")),
                   tr("Change the report rate"), &LiveSettings::rate_Hz);
  rows_ = choiceBox("rows", {tr("All row-wires")},
                    tr("Scanned row-wires; a single row-wire, as in the paper, is read ten times as often"));
  fields_.add(
      rows_, &QComboBox::currentIndexChanged, tr("Change the scanned rows"), [this] { listRows(rows_->count() - 1); },
      [](LiveSettings& settings, int index) { settings.row = index - 1; });
  form->addRow(tr("Rate"), rate_);
  form->addRow(tr("Rows"), rows_);
  return box;
}

void LiveSourcePanel::chooseDevice(int row) {
  const QListWidgetItem* item = devices_->item(row);
  if (item == nullptr) return;
  fields_.edit(tr("Change the source"), [&](LiveSettings& settings) {
    settings.source = static_cast<LiveSourceKind>(item->data(KindRole).toInt());
    if (settings.source == LiveSourceKind::Board) settings.device = item->data(DeviceNameRole).toString().toStdString();
  });
}

void LiveSourcePanel::chooseRecording() {
  const QString file =
      askFileToOpen(this, tr("Open a recording"), tr("Recordings (*.palprec);;All files (*)"), recordings_);
  if (file.isEmpty()) return;
  fields_.edit(tr("Change the source"), [&](LiveSettings& settings) {
    settings.source = LiveSourceKind::Recording;
    settings.recording = file.toStdString();
  });
}

void LiveSourcePanel::display(const LiveSettings& settings) {
  listed_.clear(); // so that the line in use is the chosen one again
  fields_.display(settings);
}

/// The row-wires of the board, and one that was selected on another board.
void LiveSourcePanel::listRows(int rowWires) {
  const QSignalBlocker quiet(rows_);
  const int wanted = 1 + std::max(rowWires, fields_.settings().row + 1);
  while (rows_->count() > wanted) rows_->removeItem(rows_->count() - 1);
  while (rows_->count() < wanted) rows_->addItem(tr("Row-wire %1 alone").arg(rows_->count() - 1));
  rows_->setCurrentIndex(fields_.settings().row + 1);
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
  std::vector<Line> lines{
      {stated(tr("First board, else simulated"), fields_.settings().source == LiveSourceKind::Automatic),
       LiveSourceKind::Automatic,
       {}}};
  for (const LiveSourceState::Board& board : state.boards) {
    const QString place = QString::fromStdString(board.path);
    const bool inUse = fields_.settings().source == LiveSourceKind::Board &&
                       (fields_.settings().device == board.serial || fields_.settings().device == board.path);
    const bool twins = std::count_if(state.boards.begin(), state.boards.end(),
                                     [&](const HidBoard& other) { return other.serial == board.serial; }) > 1;
    lines.push_back({stated(QString::fromStdString(board.serial) + tr(" at ") + place, inUse,
                            !board.free        ? tr("shown in another view")
                            : board.permission ? tr("ready")
                                               : tr("no permission")),
                     LiveSourceKind::Board, twins ? place : QString::fromStdString(board.serial)});
  }
  if (fields_.settings().source == LiveSourceKind::Board && state.boards.empty())
    lines.push_back({stated(QString::fromStdString(fields_.settings().device), true), LiveSourceKind::Board,
                     QString::fromStdString(fields_.settings().device)});
  lines.push_back({stated(tr("Simulated board"), fields_.settings().source == LiveSourceKind::Simulated),
                   LiveSourceKind::Simulated,
                   {}});
  if (!fields_.settings().recording.empty())
    lines.push_back({stated(QFileInfo(QString::fromStdString(fields_.settings().recording)).fileName(),
                            fields_.settings().source == LiveSourceKind::Recording),
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
    const bool chosen = line.kind == fields_.settings().source &&
                        (line.kind != LiveSourceKind::Board || line.device.toStdString() == fields_.settings().device);
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
