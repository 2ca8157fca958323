#include "app/gui/window/MainWindow.h"

#include "app/gui/design/DesignPage.h"
#include "app/gui/document/Document.h"
#include "app/gui/import/ImportDialog.h"
#include "app/gui/jobs/ExportJob.h"
#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/live/LiveBoards.h"
#include "app/gui/network/NetworkPage.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/reports/ReportsPage.h"
#include "app/gui/touch/DeformationPage.h"
#include "app/gui/touch/LoadPathAnimation.h"
#include "app/gui/touch/ResistancePage.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/DataTable.h"
#include "app/gui/views/PictureView.h"
#include "app/gui/views/SceneExport.h"
#include "app/gui/views/VtkView.h"
#include "app/gui/widgets/AccessibleNames.h"
#include "app/gui/widgets/EscapeKey.h"
#include "app/gui/widgets/ToolTipWrap.h"
#include "app/gui/widgets/WheelGuard.h"
#include "app/gui/window/Layout.h"
#include "app/gui/window/Menus.h"
#include "app/gui/window/MessageLog.h"
#include "app/gui/window/StatusLamps.h"
#include "app/gui/window/Style.h"
#include "app/gui/window/exports/ExportSource.h"
#include "app/gui/window/history/HistorySteps.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDropEvent>
#include <QHBoxLayout>
#include <QListWidget>
#include <QMessageBox>
#include <QMimeData>
#include <QScrollArea>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolButton>

#include <algorithm>

namespace palp {

namespace {

constexpr int kLog_px = 110;        ///< height of the messages when they are opened: the scene keeps its room
constexpr int kRailWidth_px = 128;  ///< at least
constexpr int kRailMargins_px = 34; ///< of its style
constexpr int kMessage_ms = 15000;

/// As large as the scene that is shown needs it, whatever the others need.
class SceneStack : public QStackedWidget {
public:
  [[nodiscard]] QSize minimumSizeHint() const override {
    return currentWidget() == nullptr ? QSize() : currentWidget()->minimumSizeHint();
  }
  [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }
};

} // namespace

MainWindow::MainWindow(Workbench& workbench, NetworkSession& network) : workbench_(workbench), network_(network) {
  setWindowIcon(QIcon(":/icons/palp.svg"));
  new ToolTipWrap(this);
  new WheelGuard(this);
  auto* centre = new QWidget;
  auto* row = new QHBoxLayout(centre);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  rail_ = new QListWidget;
  rail_->setObjectName("rail");
  rail_->setFocusPolicy(Qt::TabFocus); // a click leads to the scene
  rail_->setAccessibleName(tr("Scenes"));
  scenes_ = new SceneStack;
  auto* room = new QScrollArea; // on a small screen a scene is scrolled, so that the window always fits
  room->setObjectName("sceneRoom");
  room->setFrameShape(QFrame::NoFrame);
  room->setWidgetResizable(true);
  room->setWidget(scenes_);
  row->addWidget(rail_);
  row->addWidget(room, 1);
  setCentralWidget(centre);

  log_ = new MessageLog(this);
  addDockWidget(Qt::BottomDockWidgetArea, log_);
  log_->hide();
  connect(log_, &MessageLog::asked, this, &MainWindow::showMessage);
  connect(log_->toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
    if (shown) resizeDocks({log_}, {kLog_px}, Qt::Vertical);
  });
  log_->toggleViewAction()->setStatusTip(tr("Message log: alarms, boards, wires, tares, files"));
  auto* designPage = new DesignPage(workbench, network);
  connect(designPage, &DesignPage::stageChanged, this, [this] { workbench_.touch().need(currentScene().stage()); });
  connect(designPage, &DesignPage::sceneRequested, this, &MainWindow::showScene);
  addScene("design", tr("Design"), tr("Sensor at rest and all its parameters"), designPage);
  deformation_ = new DeformationPage(workbench);
  connect(deformation_, &DeformationPage::message, this, &MainWindow::showMessage);
  animation_ = new LoadPathAnimation(workbench.touch(), deformation_->block(), this);
  connect(animation_, &LoadPathAnimation::done, this, &MainWindow::showMessage);
  addScene("deformation", tr("Deformation"), tr("Block under load"), deformation_);
  addScene("resistance", tr("Resistance"), tr("Row-column resistances under load"), new ResistancePage(workbench));
  networkPage_ = new NetworkPage(workbench, network);
  connect(networkPage_, &NetworkPage::sceneRequested, this, &MainWindow::showScene);
  connect(networkPage_, &NetworkPage::importRequested, this, &MainWindow::importTables);
  addScene("network", tr("Network"), tr("Samples, training and the sweep of the spread"), networkPage_);
  live_ = new LiveBoards(workbench);
  connect(live_, &LiveBoards::message, this, &MainWindow::showMessage);
  connect(live_, &LiveBoards::recordingsChanged, this, &MainWindow::recordingsChanged);
  connect(live_, &LiveBoards::sceneRequested, this, &MainWindow::showScene);
  connect(networkPage_, &NetworkPage::liveNetworkReplaced, this, [this] { live_->page().host().useChosenNetwork(); });
  addScene("live", tr("Live"), tr("Forces of a board, the simulated board or a recording"), live_);
  reports_ = new ReportsPage(workbench);
  connect(reports_, &ReportsPage::message, this, &MainWindow::showMessage);
  addScene("reports", tr("Reports"), tr("Reproduction of the paper, and other reports"), reports_);
  for (const PictureView* view : findChildren<PictureView*>())
    connect(view, &PictureView::message, this, &MainWindow::showMessage);
  exports_ = new ExportJob(this);
  connect(exports_, &ExportJob::done, this, &MainWindow::showMessage);
  connect(&exports_->runner(), &JobRunner::failed, this,
          [this](const QString& sentence) { QMessageBox::warning(this, tr("Export"), sentence); });
  for (const DataTable* table : findChildren<DataTable*>())
    connect(table, &DataTable::message, this, &MainWindow::showMessage);
  sceneExport_ = new SceneExport(this);
  connect(sceneExport_, &SceneExport::done, this, &MainWindow::showMessage);
  connect(&sceneExport_->runner(), &JobRunner::failed, this,
          [this](const QString& sentence) { QMessageBox::warning(this, tr("Export"), sentence); });
  document_ = new Document(*this, workbench, network);
  workbench.lossQuestion().ask(*this, [this](const Leaving& leaving) { return losses(leaving); });
  buildStatusLine();
  new Menus(*this, workbench, *document_);
  new HistorySteps(*this, workbench);
  connect(&network, &NetworkSession::memoryNeeded, this, &MainWindow::releaseMemory);
  connect(&workbench, &Workbench::projectReplaced, this,
          &MainWindow::releaseMemory); // after the document has released it
  setAcceptDrops(true);
  connect(new EscapeKey(this), &EscapeKey::pressed, this, &MainWindow::cancelAll);
  connect(rail_, &QListWidget::currentRowChanged, this, &MainWindow::sceneChosen);
  nameControls(*this);
  restoreLayout();
  showScene("deformation");
}

void MainWindow::addScene(const QString& name, const QString& title, const QString& tip, Scene* scene) {
  names_ << name;
  scene->setObjectName(name);
  auto* item = new QListWidgetItem(title, rail_);
  item->setToolTip(tip + QString(" (Ctrl+%1)").arg(names_.size()));
  scenes_->addWidget(scene);
  scene->setExportSource(
      [this, scene](const QWidget& saved) { return exportSource(*scene, saved, workbench_, network_); });
}

void MainWindow::buildStatusLine() {
  auto* status = new StatusLamps(*live_, statusBar());
  connect(status, &StatusLamps::message, this, &MainWindow::showMessage);
  connect(status, &StatusLamps::sceneRequested, this, &MainWindow::showScene);
  lamps_ = status;
  auto* messages = new QToolButton; // after the lamps: where users look for messages
  messages->setObjectName("messagesShown");
  messages->setAutoRaise(true);
  messages->setDefaultAction(log_->toggleViewAction());
  statusBar()->addPermanentWidget(messages);
  connect(reports_, &ReportsPage::runs, lamps_, &StatusLamps::showReport);
  const auto gather = [this] {
    std::vector<SceneJob> jobs{
        {&workbench_.touch().runner(), "deformation"}, {&network_.runner(), "network"},
        {&animation_->runner(), "deformation"},        {&network_.writer(), "network"},
        {&workbench_.kept().runner(), "deformation"},  {&exports_->runner(), "deformation"},
        {&workbench_.field().runner(), "resistance"},  {&workbench_.referenceField().runner(), "resistance"},
        {&sceneExport_->runner(), "network"}};
    for (int k = 0; k < scenes_->count(); ++k)
      for (JobRunner* runner : static_cast<Scene*>(scenes_->widget(k))->runners()) jobs.push_back({runner, names_[k]});
    lamps_->setJobs(jobs);
  };
  connect(live_, &LiveBoards::countChanged, this, gather);
  gather();
}

void MainWindow::cancelAll() {
  if (&currentScene() == reports_) reports_->cancel();
  lamps_->cancel(names_[scenes_->currentIndex()]);
}

void MainWindow::releaseMemory() {
  workbench_.touch().rest();
  releaseViews(*this);
}

bool MainWindow::busy() const {
  return lamps_->busy();
}

void MainWindow::sceneChosen(int index) {
  if (index < 0) return;
  const bool choosing = rail_->hasFocus();
  scenes_->setCurrentIndex(index);
  if (!choosing) currentScene().setFocus(Qt::OtherFocusReason); // its keys work, and no field takes them for text
  scenes_->updateGeometry();                                    // each needs its own room
  workbench_.setPlace(names_[index]);
  // Before the window is seen no scene is: what it opens on computes nothing for the others.
  if (isVisible()) workbench_.touch().need(currentScene().stage());
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  workbench_.touch().need(currentScene().stage());
}

void MainWindow::openSamples(const std::vector<std::filesystem::path>& files) {
  showScene("network");
  networkPage_->openSamples(files);
}

void MainWindow::importTables(const QStringList& files) {
  std::vector<std::filesystem::path> paths;
  for (const QString& file : files) paths.emplace_back(file.toStdString());
  auto* dialog = new ImportDialog(paths, workbench_.project().design, this);
  connect(dialog, &ImportDialog::imported, this, [this](const std::filesystem::path& samples, std::size_t count) {
    showMessage(tr("Imported %1 samples into %2.").arg(count).arg(QString::fromStdString(samples.string())));
    openSamples({samples});
  });
  dialog->open();
}

void MainWindow::chooseTables() {
  showScene("network");
  networkPage_->chooseTables();
}

void MainWindow::showStudy(const QString& file) {
  reports_->openStudy(file);
  showScene("reports");
}

bool MainWindow::showScene(const QString& name) {
  const auto index = names_.indexOf(name);
  if (index < 0) return false;
  rail_->setCurrentRow(static_cast<int>(index));
  return true;
}

QStringList MainWindow::sceneNames() const {
  return names_;
}

QString MainWindow::sceneTitle() const {
  return rail_->currentItem()->text();
}

Scene& MainWindow::currentScene() const {
  return static_cast<Scene&>(*scenes_->currentWidget());
}

void MainWindow::setTheme(Theme theme) {
  theme_ = theme;
  applyTheme(*qApp, theme);
  QFont chosen = rail_->font();
  chosen.setBold(true);
  int width = kRailWidth_px;
  for (int k = 0; k < rail_->count(); ++k)
    width = std::max(width, QFontMetrics(chosen).horizontalAdvance(rail_->item(k)->text()) + kRailMargins_px);
  rail_->setFixedWidth(width);
  for (int k = 0; k < scenes_->count(); ++k) static_cast<Scene*>(scenes_->widget(k))->setTheme(theme);
}

QSize MainWindow::filmedSize() const {
  return deformation_->block().size();
}

void MainWindow::animate(const QString& path, const FilmSettings& film) {
  LoadPathAnimation::Settings settings;
  settings.options = deformation_->blockOptions();
  settings.options.scale = 1;
  settings.options.fullLoad = true;
  settings.kept = deformation_->shownLess();
  settings.frames = film.pictures;
  settings.width = film.width_px;
  settings.height = filmHeight_px(film.width_px, filmedSize());
  settings.seconds = film.seconds;
  (film.gif ? settings.gif : settings.folder) = path.toStdString();
  if (!animation_->start(settings))
    showMessage(tr("There is no load path yet; wait until the Deformation scene has solved the load."));
}

void MainWindow::showMessage(const QString& sentence) {
  statusBar()->showMessage(sentence, kMessage_ms);
  if (!sentence.isEmpty()) log_->add(sentence); // else the message there is over
}

void MainWindow::restoreLayout() {
  QSettings settings;
  resize(1500, 900);
  restoreGeometry(settings.value("geometry").toByteArray());
  restoreState(settings.value("state").toByteArray());
  palp::restoreLayout(*this);
  setTheme(kThemes.find(settings.value("theme").toString().toStdString()).value_or(Theme::Light));
}

/// Recordings are the boards' to answer.
QStringList MainWindow::losses(const Leaving& leaving) const {
  if (leaving.way == Leaving::Way::Edit) return {};
  const bool quits = leaving.way == Leaving::Way::Quit; // else files are written to their end
  std::vector<const JobRunner*> runners{&network_.runner()};
  for (int k = 0; k < scenes_->count(); ++k) {
    auto* scene = static_cast<Scene*>(scenes_->widget(k));
    if (!quits && scene == live_) continue;
    for (const JobRunner* runner : scene->runners()) runners.push_back(runner);
  }
  if (quits) runners.insert(runners.end(), {&animation_->runner(), &exports_->runner(), &sceneExport_->runner()});
  QStringList all;
  if (quits && reports_->running()) all << reports_->endsWords();
  for (const JobRunner* runner : runners)
    if (const QString loss = runner->loss(); !loss.isEmpty()) all << loss;
  return all;
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!document_->mayLeave({Leaving::Way::Quit})) {
    event->ignore();
    return;
  }
  QSettings().setValue("geometry", saveGeometry());
  QSettings().setValue("state", saveState());
  saveLayout(*this);
  lamps_->cancelAll();
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  QStringList files;
  for (const QUrl& url : event->mimeData()->urls()) files << url.toLocalFile();
  if (!files.isEmpty()) document_->open(files);
}

} // namespace palp
