#include "app/gui/live/LivePage.h"

#include "app/gui/live/LiveBanner.h"
#include "app/gui/live/LiveCalibration.h"
#include "app/gui/live/LiveCounters.h"
#include "app/gui/live/LiveCurves.h"
#include "app/gui/live/LiveDrawings.h"
#include "app/gui/live/LiveModelView.h"
#include "app/gui/live/LiveView.h"
#include "app/gui/live/panels/LiveControlPanel.h"
#include "app/gui/live/panels/LiveSourcePanel.h"
#include "app/gui/live/panels/SimulationPanel.h"
#include "app/gui/live/recordings/ReplayBar.h"
#include "app/gui/live/send/SendPanel.h"
#include "app/gui/project/Command.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/window/SidePanel.h"

#include <QAbstractButton>
#include <QDir>
#include <QEvent>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QShortcut>
#include <QSplitter>
#include <QTabWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kPanelWidth_px = 340;
constexpr int kFrame_ms = 34; // at most 30 frames per second
constexpr int kHiddenLook_ms = 250;
constexpr int kHiddenLooks = 4;           // until it is known that nothing is recorded or watched
constexpr double kForceDigit_N = 0.01;    // that the panel shows
constexpr double kMostHandForce_N = 100;  // that it takes
constexpr int kStateEvery = 6;            // looks between two drawings of the counters, where the state is the same
constexpr double kSnapshotPatience_s = 3; // for a source that gives nothing

void holdLabel(SimulationSettings& simulation, const KnownTouch& load) {
  simulation.held = true;
  simulation.heldArea = load.load.area;
  if (load.place_mm) simulation.heldPlace_mm = {load.place_mm->x(), load.place_mm->y()};
  const Eigen::Vector3d& force_N = load.load.force_N;
  simulation.heldForce_N = {force_N.x(), force_N.y(), force_N.z()};
}

} // namespace

LivePage::LivePage(Workbench& workbench, BoardAccess access, std::size_t board)
    : workbench_(workbench), board_(board), host_(std::move(access)) {
  setFocusPolicy(Qt::ClickFocus); // its keys are for the board that was clicked on
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 8, 8, 8);
  row->addWidget(buildPanels());
  views_ = buildViews();
  row->addWidget(views_, 1);
  row->addStretch(0); // next to a panel without views
  timer_.setInterval(kFrame_ms);
  connect(&timer_, &QTimer::timeout, this, &LivePage::look);
  hiddenTimer_.setInterval(kHiddenLook_ms);
  connect(&hiddenTimer_, &QTimer::timeout, this, &LivePage::lookHidden);
  connect(&workbench_, &Workbench::projectChanged, this, &LivePage::displayProject);
  connect(&workbench_, &Workbench::projectReplaced, this, [this] {
    host_.network().forgetBefore();
    emit host_.decoderChanged();
    calibration_->forgetFit();
  });
  workbench_.lossQuestion().ask(*this, [this](const Leaving& leaving) {
    return endsRecording(leaving) ? QStringList{recordingEnds()} : QStringList{};
  });
  connectPanels();
  buildKeys();
  displayProject();
}

LivePage::~LivePage() = default;

QWidget* LivePage::buildPanels() {
  auto* panels = new QWidget;
  auto* column = new QVBoxLayout(panels);
  column->setContentsMargins(0, 0, 4, 0);
  source_ = new LiveSourcePanel;
  simulation_ = new SimulationPanel;
  control_ = new LiveControlPanel;
  if (board_ > 0) control_->displayRecording(QDir::home().filePath(QString("touch-board%1.palprec").arg(board_)), {});
  addTo(*column, {control_->recording(), source_, simulation_});
  send_ = new SendPanel;
  column->addWidget(send_);
  column->addWidget(control_, 1);
  panels_ = new SidePanel(panels, kPanelWidth_px);
  connect(panels_, &SidePanel::foldedNow, this, &LivePage::arrangeViews);
  return panels_;
}

QWidget* LivePage::buildViews() {
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  counters_ = new LiveCounters;
  column->addWidget(counters_);
  banner_ = new LiveBanner;
  column->addWidget(banner_);
  replay_ = new ReplayBar(host_);
  column->addWidget(replay_);
  block_ = new LiveView;
  block_->setObjectName("liveBlock");
  block_->setAccessibleName(tr("Force vectors over the sensor"));
  modelView_ = new LiveModelView;
  modelView_->setObjectName("liveTwin");
  blockTabs_ = new QTabWidget;
  blockTabs_->setObjectName("blockTabs");
  blockTabs_->addTab(block_, tr("Forces"));
  blockTabs_->addTab(modelView_, tr("Model view"));
  blockTabs_->setTabToolTip(1, tr("Finite element model under the decoded force, solved on request"));
  heatmap_ = new HeatmapView;
  heatmap_->setObjectName("liveHeatmap");
  upper_ = new QSplitter(Qt::Horizontal);
  upper_->addWidget(blockTabs_);
  upper_->addWidget(heatmap_);
  upper_->setSizes({520, 520});

  curves_ = new LiveCurves(host_);
  calibration_ = new LiveCalibration(host_);
  calibration_->setObjectName("calibration");
  curveTabs_ = new QTabWidget;
  curveTabs_->setObjectName("curveTabs");
  curveTabs_->addTab(curves_, tr("Curves"));
  auto* room = new QScrollArea; // its tables must not make the scene wider than the window
  room->setFrameShape(QFrame::NoFrame);
  room->setWidgetResizable(true);
  room->setWidget(calibration_);
  curveTabs_->addTab(room, tr("Calibration"));
  auto* views = new QSplitter(Qt::Vertical);
  views->addWidget(upper_);
  views->addWidget(curveTabs_);
  views->setSizes({430, 320});
  views->installEventFilter(this);
  column->addWidget(views, 1);
  return page;
}

void LivePage::buildKeys() {
  const auto key = [this](const QKeySequence& keys, auto act) {
    auto* shortcut = new QShortcut(keys, this);
    shortcut->setContext(Qt::WidgetWithChildrenShortcut);
    connect(shortcut, &QShortcut::activated, this, act);
  };
  const auto click = [this](const char* name) {
    return [this, name] {
      if (auto* button = findChild<QAbstractButton*>(name)) button->click();
    };
  };
  key(Qt::Key_T, click("tare"));
  key(Qt::Key_R, [this, press = click("record")] { // typed by mistake it must not end one
    if (!host_.recording()) return press();
    emit message(tr("A recording is running; press Shift+R or the button to end it."));
  });
  key(Qt::SHIFT | Qt::Key_R, [this] {
    if (host_.recording()) stopRecording();
  });
  key(Qt::Key_M, click("mark"));
  key(Qt::Key_W, click("solveTwin"));
  key(Qt::Key_Period, click("replayStep"));
  key(Qt::Key_Comma, click("replayBack"));
  key(Qt::Key_Space, [this] { host_.setPaused(!host_.paused()); });
}

void LivePage::connectPanels() {
  connect(source_, &LiveSourcePanel::edited, this, &LivePage::edit);
  connect(control_, &LiveControlPanel::edited, this, &LivePage::edit);
  connect(send_, &SendPanel::edited, this, &LivePage::edit);
  connectSimulation();
  connect(replay_, &ReplayBar::message, this, &LivePage::message);
  connect(replay_, &ReplayBar::speedRequested, this, [this](double speed) {
    change(tr("replay speed"), [&](LiveSettings& settings) { settings.replaySpeed = speed; });
  });
  connect(replay_, &ReplayBar::boardRequested, this, [this] {
    change(tr("source"), [](LiveSettings& settings) { settings.source = LiveSourceKind::Automatic; });
  });
  connect(control_, &LiveControlPanel::backRequested, &host_.network(), &LiveNetwork::restore);
  connect(control_, &LiveControlPanel::shippedRequested, &host_, &LiveHost::useChosenNetwork);
  connect(source_, &LiveSourcePanel::openAgainRequested, this, [this] {
    if (!host_.recording() || acceptsLosses({recordingEnds()}, this)) host_.restart();
  });
  connect(source_, &LiveSourcePanel::anotherRequested, this, &LivePage::anotherRequested);
  connect(control_, &LiveControlPanel::tareRequested, this, &LivePage::tare);
  connect(control_, &LiveControlPanel::clearTareRequested, &host_, &LiveHost::clearTare);
  connect(control_, &LiveControlPanel::pauseRequested, &host_, &LiveHost::setPaused);
  connect(control_, &LiveControlPanel::markRequested, this, [this](const QString& text) {
    host_.mark(text.toStdString());
    emit message(host_.recording() ? tr("Marked: %1.").arg(text)
                                   : tr("Marked: %1; no recording is running.").arg(text));
  });
  connect(control_, &LiveControlPanel::recordRequested, this, &LivePage::record);
  connect(control_, &LiveControlPanel::exportRequested, this, &LivePage::exportFrames);
  connect(heatmap_, &HeatmapView::cellClicked, this, &LivePage::toggleCell);
  connect(&host_.network(), &LiveNetwork::refused, this, &LivePage::refuseNetwork);
  connect(&host_.network(), &LiveNetwork::otherInUse, this, &LivePage::takeNetworkInUse);
  connect(&host_, &LiveHost::decoderChanged, this, [this] {
    control_->displayNetworkProblem({});
    stateLook_ = 0;
    displayProject();
  });
  connect(curves_, &LiveCurves::message, this, &LivePage::message);
  connect(calibration_, &LiveCalibration::message, this, &LivePage::message);
  connect(calibration_, &LiveCalibration::framesEdited, this, [this] {
    change(tr("labelled frames"), [&](LiveSettings& settings) { settings.frames = calibration_->shown(); });
  });
  connect(calibration_, &LiveCalibration::simulatedLoadRequested, this, [this](const KnownTouch& load) {
    change(tr("simulated touch"), [&](LiveSettings& settings) { holdLabel(settings.simulation, load); });
  });
  connect(banner_, &LiveBanner::tareRequested, this, &LivePage::tare);
  connect(banner_, &LiveBanner::networkOfRowsRequested, this, &LivePage::prepareNetwork);
  connect(modelView_, &LiveModelView::solveRequested, this, &LivePage::solveModelView);
  connect(modelView_, &LiveModelView::loadRequested, this, [this](const LoadCase& load) {
    Project next = workbench_.project();
    next.design = host_.sensor();
    next.load = load;
    workbench_.edit(tr("Use the live force as the load"), next);
    emit message(tr("The decoded force is now the load of the Deformation scene."));
  });
}

void LivePage::connectSimulation() {
  connect(simulation_, &SimulationPanel::edited, this, &LivePage::edit);
  connect(simulation_, &SimulationPanel::plugRequested, &host_, &LiveHost::setPluggedIn);
  connect(simulation_, &SimulationPanel::designRequested, this, [this] {
    if (!host_.simulatesOwnDesign()) host_.simulateDesign(workbench_.project().mesh);
  });
  connect(&host_.simulator(), &JobRunner::failed, this, &LivePage::message);
  connect(&exporter_, &JobRunner::failed, this, &LivePage::message);
  connect(block_, &LiveView::areaPressed, this, [this](int area) {
    change(tr("simulated touch"), [&](LiveSettings& settings) { settings.simulation.heldArea = area; });
  });
  const auto press = [this](const Eigen::Vector3d& force_N) {
    change(tr("simulated touch"), [&](LiveSettings& settings) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        settings.simulation.heldForce_N[axis] =
            std::clamp(std::round(force_N(static_cast<Eigen::Index>(axis)) / kForceDigit_N) * kForceDigit_N,
                       -kMostHandForce_N, kMostHandForce_N);
    });
  };
  connect(block_, &LiveView::sheared, this, [this, press](const Eigen::Vector2d& force_N) {
    press({force_N.x(), force_N.y(), settings().simulation.heldForce_N[2]});
  });
  connect(block_, &LiveView::forceStepped, this, [this, press](const Eigen::Vector3d& by_N) {
    press(Eigen::Map<const Eigen::Vector3d>(settings().simulation.heldForce_N.data()) + by_N);
  });
  const auto place = [this](const Eigen::Vector2d& at_mm) {
    const Eigen::Vector2d on = at_mm.cwiseMax(0).cwiseMin(host_.sensor().block_mm.head<2>());
    change(tr("simulated touch"), [&](LiveSettings& settings) {
      settings.simulation.heldPlace_mm = {std::round(100 * on.x()) / 100, std::round(100 * on.y()) / 100};
    });
  };
  connect(block_, &LiveView::placePressed, this, place);
  connect(block_, &LiveView::placeStepped, this, [this, place](const Eigen::Vector2d& by_mm) {
    place(Eigen::Vector2d(settings().simulation.heldPlace_mm.data()) + by_mm);
  });
  connect(block_, &LiveView::handRequested, this, [this] {
    if (!host_.simulated()) return;
    change(tr("simulated touch"), [](LiveSettings& settings) { settings.simulation.held = !settings.simulation.held; });
  });
  connect(block_, &PictureView::clicked, this, [this] {
    if (host_.simulated() && !settings().simulation.held)
      emit message(tr("To press here, tick \"Touch by hand\" in the panel or press Return."));
  });
}

void LivePage::change(const QString& what, const std::function<void(LiveSettings&)>& change) {
  LiveSettings next = settings();
  change(next);
  edit(what, next);
}

/// What was chosen cannot be used: the network in use stays, and the settings name it again.
void LivePage::refuseNetwork(const QString& sentence) {
  if (host_.network().decoder()) takeNetworkInUse();
  const QString words =
      host_.network().decoder() ? tr("%1. Still in use: %2.").arg(sentence, host_.network().name()) : sentence;
  control_->displayNetworkProblem(words);
  emit message(words);
}

/// The settings name the network in use.
void LivePage::takeNetworkInUse() {
  if (board_ >= workbench_.project().boards()) return; // it is about to go
  change(tr("network"), [&](LiveSettings& settings) {
    settings.network = host_.network().file();
    settings.calibrated = host_.network().calibrated();
  });
}

void LivePage::edit(const QString& what, const LiveSettings& settings) {
  workbench_.edit(what, [&](Project& next) { next.board(board_) = settings; });
}

void LivePage::displayProject() {
  if (board_ >= workbench_.project().boards()) return; // it is about to go
  const LiveSettings settings = this->settings();
  if (host_.recording() && !sameSource(host_.settings(), settings)) stopRecording(); // and reports it
  host_.setSettings(settings, workbench_.project().design);
  calibration_->display(settings.frames);
  source_->display(settings);
  simulation_->display(settings);
  send_->display(settings);
  block_->setPressable(host_.simulated() && settings.simulation.held, settings.simulation.heldArea);
  block_->setPlaced(settings.simulation.moving);
  replay_->display(settings);
  control_->display(settings);
  if (isVisible()) draw();
}

std::vector<JobRunner*> LivePage::runners() {
  return {&modelView_->runner(),     &calibration_->runner(), &calibration_->writer(),
          &host_.network().loader(), &host_.simulator(),      &exporter_};
}

QString LivePage::commands(const Project& project, const QString&) const {
  return liveCommand(project.board(board_));
}

bool LivePage::complete() const {
  if (host_.network().loading()) return false;
  const bool waited = shownSince_s_ > 0 && hostClock_s() - shownSince_s_ > kSnapshotPatience_s;
  return waited || (host_.simulated() && arrowSeen_);
}

void LivePage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  hiddenTimer_.stop();
  shownSince_s_ = hostClock_s();
  stateLook_ = 0;
  draw(); // what was edited while the page was hidden
  host_.setVisible(true);
  timer_.start();
}

void LivePage::hideEvent(QHideEvent* event) {
  Scene::hideEvent(event);
  timer_.stop();
  host_.setVisible(false);
  hiddenLooks_ = 0;
  hiddenTimer_.start();
}

void LivePage::resizeEvent(QResizeEvent* event) {
  Scene::resizeEvent(event);
  arrangeViews();
}

/// The views have another size, after a fold of the panel too: they are arranged when the layout is complete.
bool LivePage::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) QMetaObject::invokeMethod(this, &LivePage::arrangeViews, Qt::QueuedConnection);
  return Scene::eventFilter(watched, event);
}

void LivePage::setMoreAllowed(bool allowed) {
  source_->setMoreAllowed(allowed);
}

void LivePage::setBeside(bool beside) {
  beside_ = beside;
  arrangeViews();
}

/// A recording or an alarm continues while hidden; without either, nothing runs.
void LivePage::lookHidden() {
  host_.look();
  announce();
  emit looked();
  if (!host_.worksHidden() && ++hiddenLooks_ > kHiddenLooks) hiddenTimer_.stop();
}

void LivePage::announce() {
  for (const QString& sentence : news_.take(host_)) emit message(sentence);
  const QString alarm = watch_.take(host_, isVisible());
  if (alarm.isEmpty()) return;
  stateLook_ = 0; // shown immediately
  emit message(alarm);
}

void LivePage::look() {
  ++looks_;
  const LiveState before = host_.status().state;
  const bool recorded = host_.status().recording;
  const bool fresh = host_.look();
  announce();
  emit looked();
  const bool changed = host_.status().state != before || host_.status().recording != recorded;
  if (changed || stateLook_++ % kStateEvery == 0) drawState(); // also of a recording shorter than kStateEvery looks
  replay_->displayState();
  if (!fresh) return;
  calibration_->take();
  drawForces();
  drawHeatmap();
  drawCurves();
}

} // namespace palp
