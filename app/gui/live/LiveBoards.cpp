#include "app/gui/live/LiveBoards.h"

#include "app/gui/widgets/AccessibleNames.h"
#include "app/gui/widgets/ElidedLabel.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/window/SidePanel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace palp {

namespace {

constexpr int kLeaving_ms = 50;
constexpr int kBoardWithPanel_px = 1000; // that a board needs with its panel

} // namespace

LiveBoards::LiveBoards(Workbench& workbench, BoardAccess access, QWidget* parent)
    : Scene(parent), workbench_(workbench), boards_(std::make_shared<SharedBoards>(std::move(access))) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  row_ = new QSplitter(Qt::Horizontal);
  row_->setChildrenCollapsible(false);
  column->addWidget(row_);
  leavingTimer_.setInterval(kLeaving_ms);
  connect(&leavingTimer_, &QTimer::timeout, this, &LiveBoards::tidy);
  connect(&workbench_, &Workbench::projectChanged, this, [this] {
    if (isVisible() || workbench_.project().boards() < cells_.size()) follow();
  });
  build();
  arrange();
}

LiveBoards::~LiveBoards() {
  qDeleteAll(leaving_);
}

void LiveBoards::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  follow();
}

/// As many pages as the project has boards.
void LiveBoards::follow() {
  const std::size_t wanted = workbench_.project().boards();
  if (wanted == cells_.size()) return;
  while (cells_.size() > wanted) takeAway(cells_.size() - 1);
  while (cells_.size() < wanted) build();
  arrange();
}

void LiveBoards::build() {
  const std::size_t board = cells_.size();
  Cell cell;
  cell.box = new QWidget;
  auto* column = new QVBoxLayout(cell.box);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  cell.head = new QWidget;
  auto* head = new QHBoxLayout(cell.head);
  head->setContentsMargins(8, 6, 8, 0);
  cell.title = new ElidedLabel;
  cell.title->setObjectName("boardTitle");
  cell.title->setProperty("role", "title");
  auto* away = pushButton(tr("Close board"), "takeBoardAway",
                          tr("Closes this board's view; its recordings stay in their files"));
  auto* panelShown =
      pushButton(tr("Panel"), "boardPanel", tr("Shows or hides this board's panel with source, tare and recording"));
  panelShown->setCheckable(true);
  panelShown->setChecked(true);
  addTo(*head, {{cell.title, 1}, panelShown, away});
  cell.page = new LivePage(workbench_, boards_->accessOf(readers_++), board);
  cell.page->setObjectName("board");
  cell.page->setTheme(theme_);
  column->addWidget(cell.head);
  column->addWidget(cell.page, 1);
  LivePage* page = cell.page;
  for (auto* panel : cell.page->findChildren<SidePanel*>()) {
    connect(panelShown, &QPushButton::clicked, panel, [panel](bool shown) { panel->setFoldedForNow(!shown); });
    // One whose panel is opened gets the room for it: its views stay in sight.
    connect(panel, &SidePanel::foldedNow, this, [this, page](bool folded) {
      const auto boards = static_cast<int>(cells_.size());
      const int wide = std::max(width() / std::max(boards, 1), std::min(kBoardWithPanel_px, 2 * width() / 3));
      QList<int> sizes;
      for (const Cell& other : cells_)
        sizes << (folded || boards < 2 ? width() : other.page == page ? wide : (width() - wide) / (boards - 1));
      row_->setSizes(sizes);
    });
    connect(panel, &SidePanel::foldedNow, panelShown, [panelShown](bool folded) { panelShown->setChecked(!folded); });
  }
  connect(away, &QPushButton::clicked, this, [this, page] { remove(page); });
  connect(page, &LivePage::anotherRequested, this, &LiveBoards::add);
  connect(page, &LivePage::sceneRequested, this, &LiveBoards::sceneRequested);
  connect(page, &LivePage::looked, this, [this] {
    if (cells_.size() > 1 && isVisible()) displayTitles();
    tellRecordings();
    emit looked();
  });
  connect(page, &LivePage::message, this, [this, page](const QString& sentence) {
    const auto its = std::find_if(cells_.begin(), cells_.end(), [&](const Cell& c) { return c.page == page; });
    emit message(cells_.size() > 1 ? tr("Board %1: %2").arg(its - cells_.begin()).arg(sentence) : sentence);
  });
  cells_.push_back(cell);
  nameControls(*cell.box);
  row_->addWidget(cell.box);
}

/// The board's number, name and state are shown over its page where there are several.
void LiveBoards::arrange() {
  const bool several = cells_.size() > 1;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    cells_[k].head->setVisible(several);
    cells_[k].page->setBeside(several);
    cells_[k].page->setMoreAllowed(cells_.size() < Project::kMostBoards);
  }
  row_->setSizes(QList<int>(static_cast<int>(cells_.size()), width()));
  setFocusProxy(cells_[0].page);
  displayTitles();
  tellRecordings();
  emit countChanged();
}

void LiveBoards::tellRecordings() {
  const QStringList now = recordings();
  if (now != std::exchange(recordings_, now)) emit recordingsChanged(now);
}

void LiveBoards::displayTitles() {
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const LiveStatus& status = cells_[k].page->host().status();
    const QString source = QString::fromStdString(status.source);
    QString words = tr("Board %1").arg(k) + (source.isEmpty() ? QString() : ": " + source);
    words += QString::fromUtf8(" \u2014 ") + QString::fromLatin1(name(status.state));
    if (status.recording) words += tr(", recording");
    if (cells_[k].title->text() == words) continue;
    cells_[k].title->setText(words);
    cells_[k].page->setAccessibleName(words);
  }
}

/// The first board that nobody shows yet; where there is none, a simulated one that does not do what the others do.
LiveSettings LiveBoards::settingsOfAnother() const {
  LiveSettings settings = workbench_.project().live;
  settings.source = LiveSourceKind::Simulated;
  settings.device.clear();
  settings.frames.reset(); // they are of one board
  settings.calibrated.reset();
  settings.simulation.openRow = settings.simulation.openColumn = -1; // a wire broken on one board is intact on another
  settings.simulation.dropEvery = 0;
  for (std::size_t k = 0; k < cells_.size(); ++k)
    settings.simulation.seed = std::max(settings.simulation.seed, workbench_.project().board(k).simulation.seed + 1);
  const std::vector<HidBoard> there = cells_[0].page->host().boards();
  for (const HidBoard& board : there) {
    const bool shown = std::any_of(cells_.begin(), cells_.end(), [&](const Cell& cell) {
      const LiveSettings& other = cell.page->host().settings();
      return (other.source == LiveSourceKind::Board && (other.device == board.path || other.device == board.serial));
    });
    if (shown || !boards_->free(board.path, readers_)) continue;
    const auto twins =
        std::count_if(there.begin(), there.end(), [&](const HidBoard& other) { return other.serial == board.serial; });
    settings.source = LiveSourceKind::Board;
    settings.device = twins > 1 ? board.path : board.serial;
    break;
  }
  return settings;
}

void LiveBoards::add() {
  if (cells_.size() >= Project::kMostBoards) return;
  workbench_.edit(tr("Add a board"), [&](Project& next) { next.moreBoards.push_back(settingsOfAnother()); });
  // Where it is narrow the views of all count more than a panel, which a button over each board brings back.
  const bool narrow = width() < kBoardWithPanel_px * static_cast<int>(cells_.size());
  for (const Cell& cell : cells_)
    for (auto* panel : cell.box->findChildren<SidePanel*>()) panel->setFoldedForNow(narrow);
  cells_.back().page->setFocus();
}

void LiveBoards::remove(LivePage* page) {
  const auto cell = std::find_if(cells_.begin(), cells_.end(), [&](const Cell& c) { return c.page == page; });
  if (cell == cells_.end() || cells_.size() < 2) return;
  if (!acceptsLosses(page->lossesByClosing(), this)) return;
  const auto board = static_cast<std::size_t>(cell - cells_.begin());
  Project next = workbench_.project();
  if (board == 0) next.live = next.moreBoards.front();
  next.moreBoards.erase(next.moreBoards.begin() + static_cast<std::ptrdiff_t>(board == 0 ? 0 : board - 1));
  takeAway(board);
  for (std::size_t k = 0; k < cells_.size(); ++k) cells_[k].page->setBoard(k);
  workbench_.edit(tr("Close a board"), next);
  if (cells_.size() == 1)
    for (auto* panel : cells_[0].box->findChildren<SidePanel*>()) panel->setFoldedForNow(panel->foldedByHand());
  arrange();
}

/// Its session ends without the window's waiting.
void LiveBoards::takeAway(std::size_t board) {
  const Cell cell = cells_[board];
  cells_.erase(cells_.begin() + static_cast<std::ptrdiff_t>(board));
  if (cell.page->host().recording())
    emit message(tr("The recording to %1 has ended because its board was closed.")
                     .arg(QString::fromStdString(cell.page->host().recordingFile().string())));
  cell.page->disconnect(this);
  cell.page->setParent(nullptr); // hides it
  for (JobRunner* runner : cell.page->runners()) runner->cancel();
  cell.page->host().close();
  delete cell.box;
  leaving_.push_back(cell.page);
  leavingTimer_.start();
}

void LiveBoards::tidy() {
  std::erase_if(leaving_, [](LivePage* page) {
    const std::vector<JobRunner*> runners = page->runners();
    const bool works = std::any_of(runners.begin(), runners.end(), [](const JobRunner* job) { return job->running(); });
    if (works || !page->host().closed()) return false;
    page->deleteLater();
    return true;
  });
  if (leaving_.empty()) leavingTimer_.stop();
}

void LiveBoards::setTheme(Theme theme) {
  theme_ = theme;
  for (const Cell& cell : cells_) cell.page->setTheme(theme);
}

bool LiveBoards::complete() const {
  return std::all_of(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell.page->complete(); });
}

std::vector<JobRunner*> LiveBoards::runners() {
  std::vector<JobRunner*> all;
  for (const Cell& cell : cells_)
    for (JobRunner* runner : cell.page->runners()) all.push_back(runner);
  return all;
}

QString LiveBoards::commands(const Project& project, const QString& designFile) const {
  QStringList lines;
  for (const Cell& cell : cells_) lines << cell.page->commands(project, designFile);
  return lines.join('\n');
}

std::vector<LiveLampState> LiveBoards::lamps() const {
  std::vector<LiveLampState> lamps;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    lamps.push_back(cells_[k].page->lamp());
    if (cells_.size() > 1) lamps.back().words = tr("Board %1: %2").arg(k).arg(lamps.back().words);
  }
  return lamps;
}

QStringList LiveBoards::recordings() const {
  QStringList files;
  for (const Cell& cell : cells_)
    if (cell.page->host().recording()) files << QString::fromStdString(cell.page->host().recordingFile().string());
  return files;
}

} // namespace palp
