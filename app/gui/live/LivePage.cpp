#include "app/gui/live/LivePage.h"

#include "app/gui/live/LiveBanner.h"
#include "app/gui/live/LiveCalibration.h"
#include "app/gui/live/LiveControlPanel.h"
#include "app/gui/live/LiveCounters.h"
#include "app/gui/live/LiveCurves.h"
#include "app/gui/live/LiveDrawings.h"
#include "app/gui/live/LiveSourcePanel.h"
#include "app/gui/live/LiveTwin.h"
#include "app/gui/live/LiveView.h"
#include "app/gui/live/RecordingName.h"
#include "app/gui/live/ReplayBar.h"
#include "app/gui/live/SimulationPanel.h"
#include "app/gui/project/Command.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/window/SidePanel.h"

#include <QAbstractButton>
#include <QHBoxLayout>
#include <QShortcut>
#include <QSplitter>
#include <QTabWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

constexpr int kPanelWidth_px = 340;
constexpr int kFrame_ms = 34;             // 30 frames a second at most
constexpr int kStateEvery = 6;            // looks between two drawings of the counters, where the state is the same
constexpr double kColorSteps = 256;       // a smaller change of a cell is not seen
constexpr double kSnapshotPatience_s = 3; // for a source that gives nothing

/// Some cell has another colour than it was drawn with.
bool looksDifferent(const Eigen::MatrixXd& now, const Eigen::MatrixXd& drawn, double step) {
  if (now.rows() != drawn.rows() || now.cols() != drawn.cols()) return true;
  if ((now.array().isNaN() != drawn.array().isNaN()).any()) return true;
  return ((now - drawn).array().abs() > step).any();
}

} // namespace

LivePage::LivePage(Workbench& workbench, BoardAccess access, QWidget* parent)
    : Scene(parent), workbench_(workbench), host_(std::move(access)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 8, 8, 8);
  row->addWidget(buildPanels());
  row->addWidget(buildViews(), 1);
  timer_.setInterval(kFrame_ms);
  connect(&timer_, &QTimer::timeout, this, &LivePage::look);
  connect(&workbench_, &Workbench::projectChanged, this, &LivePage::displayProject);
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
  column->addWidget(source_);
  column->addWidget(simulation_);
  column->addWidget(control_, 1);
  return sidePanel(panels, kPanelWidth_px);
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
  twin_ = new LiveTwin;
  twin_->setObjectName("liveTwin");
  blockTabs_ = new QTabWidget;
  blockTabs_->setObjectName("blockTabs");
  blockTabs_->addTab(block_, tr("Forces"));
  blockTabs_->addTab(twin_, tr("Twin"));
  blockTabs_->setTabToolTip(1, tr("The finite element model under the decoded force, on demand"));
  heatmap_ = new HeatmapView;
  heatmap_->setObjectName("liveHeatmap");
  auto* upper = new QSplitter(Qt::Horizontal);
  upper->addWidget(blockTabs_);
  upper->addWidget(heatmap_);
  upper->setSizes({520, 520});

  curves_ = new LiveCurves(host_);
  calibration_ = new LiveCalibration(host_);
  calibration_->setObjectName("calibration");
  curveTabs_ = new QTabWidget;
  curveTabs_->setObjectName("curveTabs");
  curveTabs_->addTab(curves_, tr("Curves"));
  curveTabs_->addTab(calibration_, tr("Calibration"));
  auto* views = new QSplitter(Qt::Vertical);
  views->addWidget(upper);
  views->addWidget(curveTabs_);
  views->setSizes({430, 320});
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
  key(Qt::Key_R, click("record"));
  key(Qt::Key_M, click("mark"));
  key(Qt::Key_W, click("solveTwin"));
  key(Qt::Key_Period, click("replayStep"));
  key(Qt::Key_Space, [this] { host_.setPaused(!host_.paused()); });
}

void LivePage::connectPanels() {
  connect(source_, &LiveSourcePanel::edited, this, &LivePage::edit);
  connect(control_, &LiveControlPanel::edited, this, &LivePage::edit);
  connectSimulation();
  connect(replay_, &ReplayBar::speedAsked, this, [this](double speed) {
    change(tr("replay speed"), [&](LiveSettings& settings) { settings.replaySpeed = speed; });
  });
  connect(replay_, &ReplayBar::boardAsked, this, [this] {
    change(tr("source"), [](LiveSettings& settings) { settings.source = LiveSourceKind::Automatic; });
  });
  connect(control_, &LiveControlPanel::backAsked, &host_, &LiveHost::backToNetwork);
  connect(source_, &LiveSourcePanel::openAgainAsked, &host_, &LiveHost::restart);
  connect(control_, &LiveControlPanel::tareAsked, &host_, &LiveHost::tare);
  connect(control_, &LiveControlPanel::clearTareAsked, &host_, &LiveHost::clearTare);
  connect(control_, &LiveControlPanel::pauseAsked, &host_, &LiveHost::setPaused);
  connect(control_, &LiveControlPanel::markAsked, this, [this](const QString& text) {
    host_.mark(text.toStdString());
    if (!host_.status().recording) emit message(tr("Marked; nothing is being recorded."));
  });
  connect(control_, &LiveControlPanel::recordAsked, this, &LivePage::record);
  connect(control_, &LiveControlPanel::stopRecordingAsked, &host_, &LiveHost::stopRecording);
  connect(control_, &LiveControlPanel::exportAsked, this, [this](const QString& file) {
    try {
      writeLiveCsv(file.toStdString(), host_.history());
      emit message(tr("Wrote %1 frames to %2.").arg(host_.history().entries().size()).arg(file));
    } catch (const std::exception& refusal) {
      emit message(QString::fromStdString(refusal.what()));
    }
  });
  connect(heatmap_, &HeatmapView::cellClicked, this, &LivePage::toggleCell);
  connect(&host_, &LiveHost::networkRefused, this, &LivePage::refuseNetwork);
  connect(&host_, &LiveHost::decoderChanged, this, [this] {
    control_->displayNetworkProblem({});
    stateLook_ = 0;
    displayProject();
  });
  connect(curves_, &LiveCurves::message, this, &LivePage::message);
  connect(calibration_, &LiveCalibration::message, this, &LivePage::message);
  connect(twin_, &LiveTwin::solveAsked, this, &LivePage::solveTwin);
  connect(twin_, &LiveTwin::loadAsked, this, [this](const LoadCase& load) {
    Project next = workbench_.project();
    next.design = host_.sensor();
    next.load = load;
    workbench_.edit(tr("load of the live force"), next);
    emit message(tr("The decoded force is the load of the Deformation scene now."));
  });
}

void LivePage::connectSimulation() {
  connect(simulation_, &SimulationPanel::edited, this, &LivePage::edit);
  connect(simulation_, &SimulationPanel::plugAsked, &host_, &LiveHost::setPluggedIn);
  connect(simulation_, &SimulationPanel::designAsked, this,
          [this] { host_.simulateDesign(workbench_.project().mesh); });
  connect(&host_.simulator(), &JobRunner::failed, this, &LivePage::message);
  connect(block_, &LiveView::areaPressed, this, [this](int area) {
    change(tr("simulated touch"), [&](LiveSettings& settings) {
      settings.simulation.heldArea = area;
      settings.simulation.heldForce_N[0] = settings.simulation.heldForce_N[1] = 0;
    });
  });
  connect(block_, &LiveView::sheared, this, [this](const Eigen::Vector2d& force_N) {
    change(tr("simulated touch"), [&](LiveSettings& settings) {
      settings.simulation.heldForce_N[0] = force_N.x();
      settings.simulation.heldForce_N[1] = force_N.y();
    });
  });
}

void LivePage::change(const QString& what, const std::function<void(LiveSettings&)>& change) {
  LiveSettings settings = workbench_.project().live;
  change(settings);
  edit(what, settings);
}

/// What was chosen cannot be used: the network in use stays, and the settings name it again.
void LivePage::refuseNetwork(const QString& sentence) {
  if (host_.decoder()) change(tr("network"), [&](LiveSettings& settings) { settings.network = host_.networkFile(); });
  control_->displayNetworkProblem(sentence);
  emit message(sentence);
}

void LivePage::edit(const QString& what, const LiveSettings& settings) {
  Project next = workbench_.project();
  next.live = settings;
  workbench_.edit(what, next);
}

void LivePage::displayProject() {
  const LiveSettings& settings = workbench_.project().live;
  host_.setSettings(settings, workbench_.project().design);
  source_->display(settings);
  simulation_->display(settings);
  block_->setPressable(host_.simulated() && settings.simulation.held);
  replay_->display(settings);
  control_->display(settings);
  if (isVisible()) draw();
}

/// All views anew.
void LivePage::draw() {
  block_->showSensor(host_.sensor(), host_.settings().arrow_mm_per_N, true);
  drawnChange_.resize(0, 0);
  drawForces();
  drawHeatmap();
  drawCurves();
}

void LivePage::setTheme(Theme theme) {
  block_->setTheme(theme);
  twin_->setTheme(theme);
  heatmap_->setTheme(theme);
  curves_->setTheme(theme);
}

std::vector<JobRunner*> LivePage::runners() {
  return {&twin_->runner(), &calibration_->runner(), &host_.loader(), &host_.simulator()};
}

QString LivePage::commands(const Project& project, const QString&) const {
  return liveCommand(project.live);
}

bool LivePage::complete() const {
  if (host_.loading()) return false;
  const bool waited = shownSince_s_ > 0 && hostClock_s() - shownSince_s_ > kSnapshotPatience_s;
  return waited || (host_.simulated() && arrowSeen_);
}

void LivePage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
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
}

void LivePage::look() {
  ++looks_;
  const LiveState before = host_.status().state;
  const bool fresh = host_.look();
  if (host_.status().state != before || stateLook_++ % kStateEvery == 0) drawState();
  replay_->displayState();
  if (!fresh) return;
  calibration_->take();
  drawForces();
  drawHeatmap();
  drawCurves();
}

void LivePage::drawState() {
  const LiveStatus& status = host_.status();
  const bool simulated = host_.simulated();
  counters_->display(status, host_.history().last(), simulated);
  source_->displayState({status, host_.boards(), host_.replaying()});
  simulation_->setVisible(simulated);
  simulation_->displayState({host_.pluggedIn(), host_.simulatesOwnDesign(), host_.simulatedSensor().areas.count(),
                             host_.simulator().running()});
  block_->setPressable(simulated && host_.settings().simulation.held);
  control_->displayState({status, host_.paused(), networkWords(), host_.networkBefore()});
  calibration_->displayState();
  banner_->display(host_);
  if (status.alarms != alarms_ && status.alarms > 0) emit message(QString::fromStdString(status.lastAlarm));
  alarms_ = status.alarms;
  const bool streams = status.state == LiveState::Streaming || status.state == LiveState::Paused;
  if (!streams) drawForces(); // the arrows turn grey
}

QString LivePage::networkWords() const {
  const std::optional<Decoder>& decoder = host_.decoder();
  if (!decoder) return host_.loading() ? tr("Reading the network...") : tr("No network.");
  const QString rows = static_cast<int>(decoder->input.rows.size()) == decoder->input.rowWires
                           ? tr("all rows")
                           : tr("%1 rows").arg(decoder->input.rows.size());
  return tr("%1: %2, %3, trained for noise %4")
      .arg(host_.networkName())
      .arg(QString::fromStdString(name(decoder->kind)), rows)
      .arg(decoder->noise, 0, 'g', 2);
}

void LivePage::drawForces() {
  const LiveFrame* last = host_.history().last();
  if (last == nullptr) return block_->showForces({}, false, {tr("Force vectors: nothing has come yet").toStdString()});
  const LiveState state = host_.status().state;
  const bool gone = state != LiveState::Streaming && state != LiveState::Paused;
  const bool stale = gone || !last->forces.valid;
  const LiveFrame* known = stale ? host_.history().lastValid() : last;
  const std::vector<LiveArrow> arrows = known != nullptr ? arrowsOf(known->forces) : std::vector<LiveArrow>{};
  arrowSeen_ = arrowSeen_ || std::any_of(arrows.begin(), arrows.end(), [](const LiveArrow& arrow) {
                 return arrow.force_N.norm() > 3; // a picture of the scene shows a good press
               });
  std::vector<std::string> lines = forceLines(*last, host_.settings());
  if (gone) lines = {lines.front(), std::string("last known; the source is ") + name(state)};
  block_->showForces(arrows, stale, lines);
}

void LivePage::drawHeatmap() {
  const LiveFrame* last = host_.history().last();
  if (last == nullptr) return;
  const LiveSettings& settings = host_.settings();
  if (!looksDifferent(last->change, drawnChange_, 0.02 * settings.change_percent / kColorSteps)) return;
  drawnChange_ = last->change;
  heatmap_->setHeatmap(changeHeatmap(*last, host_.status().restName, settings, curves_->chosenCell()));
}

void LivePage::drawCurves() {
  if (curveTabs_->currentIndex() == 0) curves_->draw();
}

void LivePage::toggleCell(int row, int column) {
  curves_->toggleCell(row, column);
  drawnChange_.resize(0, 0);
  drawHeatmap();
}

void LivePage::record(const QString& file, bool replace) {
  if (host_.status().recording) return host_.stopRecording(); // the button has not heard of it yet
  const std::filesystem::path wanted = file.toStdString();
  const std::filesystem::path path = replace ? wanted : freeRecording(wanted, QDateTime::currentDateTime());
  try {
    host_.startRecording(path, replace);
    control_->displayRecording(QString::fromStdString(path.string()), {});
    emit message(tr("Recording to %1.").arg(QString::fromStdString(path.string())));
  } catch (const std::exception& refusal) {
    control_->displayRecording({}, QString::fromStdString(refusal.what()));
    emit message(QString::fromStdString(refusal.what()));
  }
  stateLook_ = 0;
}

void LivePage::solveTwin() {
  const LiveFrame* last = host_.history().lastValid();
  if (last == nullptr) {
    emit message(tr("No force has been decoded yet."));
    return;
  }
  LoadCase load;
  for (const LiveArrow& arrow : arrowsOf(last->forces)) load.areas.push_back({arrow.area, arrow.force_N});
  if (load.areas.empty()) {
    emit message(tr("The sensor is at rest: press it, then ask for the twin."));
    return;
  }
  blockTabs_->setCurrentWidget(twin_);
  const SensorDesign& sensor = host_.sensor();
  const bool own = sensor == workbench_.project().design;
  twin_->solve(sensor, load, own ? workbench_.project().mesh : MeshOptions{}, last->change);
}

} // namespace palp
