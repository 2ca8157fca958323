// What the Live page draws of what has come.

#include "app/gui/live/LiveBanner.h"
#include "app/gui/live/LiveCalibration.h"
#include "app/gui/live/LiveCounters.h"
#include "app/gui/live/LiveCurves.h"
#include "app/gui/live/LiveDrawings.h"
#include "app/gui/live/LiveModelView.h"
#include "app/gui/live/LivePage.h"
#include "app/gui/live/LiveView.h"
#include "app/gui/live/panels/LiveControlPanel.h"
#include "app/gui/live/panels/LiveSourcePanel.h"
#include "app/gui/live/panels/SimulationPanel.h"
#include "app/gui/live/send/SendPanel.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/window/SidePanel.h"
#include "io/DesignFile.h"

#include <QSplitter>
#include <QTabWidget>

#include <algorithm>

namespace palp {

namespace {

constexpr double kColorSteps = 256;  // a smaller change of a cell is not seen
constexpr int kNarrowViews_px = 640; // narrower views are placed one above the other
constexpr int kTower_px = 640;       // that four of them need to be read
constexpr int kLowTower_px = 400;    // that three of them need

/// Some cell has another colour than it was drawn with.
bool looksDifferent(const Eigen::MatrixXd& now, const Eigen::MatrixXd& drawn, double step) {
  if (now.rows() != drawn.rows() || now.cols() != drawn.cols()) return true;
  if ((now.array().isNaN() != drawn.array().isNaN()).any()) return true;
  return ((now - drawn).array().abs() > step).any();
}

/// A recording of a simulated board is marked so in its reports; the design of a board is known from the project only.
DeviationNote noteOf(const LiveHost& host, const SensorDesign& project) {
  const LiveFrame* last = host.history().last();
  if (!host.network().decoder() || last == nullptr) return {};
  const bool simulated = host.simulated();
  const bool ofSimulation = simulated || (last->frame.flags & ReadingFlag::Simulated) != 0;
  const bool indenter = simulated && host.settings().simulation.moving && host.simulatesOwnDesign();
  DeviationNote note =
      deviationNote(*host.network().decoder(),
                    {designFingerprint(simulated ? host.simulatedSensor() : project), ofSimulation, indenter});
  if (note.wrong && simulated) note.sentence += "; \"Built-in\" under Network selects the one made for this board";
  return note;
}

} // namespace

/// Several boards share the window's width.
void LivePage::arrangeViews() {
  const int rest_px = width() - panels_->sizeHint().width();
  views_->setVisible(!beside_ || panels_->folded() || 2 * rest_px >= 3 * counters_->tileWidth());
  QWidget& views = *upper_->parentWidget();
  const bool narrow = views.width() < kNarrowViews_px;
  views.setMinimumHeight(narrow ? kLowTower_px : 0);
  placeHeatmap(narrow && views.height() < kTower_px);
  const Qt::Orientation way = narrow ? Qt::Vertical : Qt::Horizontal;
  if (upper_->orientation() != way) upper_->setOrientation(way);
  if (curves_->orientation() != way) curves_->setOrientation(way);
}

/// A tab of its own where there is no room for it under the forces.
void LivePage::placeHeatmap(bool inTab) {
  const bool isInTab = blockTabs_->indexOf(heatmap_) >= 0;
  if (inTab == isInTab) return;
  if (inTab) {
    blockTabs_->addTab(heatmap_, tr("dR/R"));
    return;
  }
  upper_->addWidget(heatmap_); // which takes it out of the tabs
  heatmap_->show();
  upper_->setSizes({width(), width()});
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
  modelView_->setTheme(theme);
  heatmap_->setTheme(theme);
  curves_->setTheme(theme);
}

void LivePage::drawState() {
  const LiveStatus& status = host_.status();
  const bool simulated = host_.simulated();
  note_ = noteOf(host_, workbench_.project().design);
  counters_->display(status, host_.history().last(), simulated, host_.replaying(), host_.network().loading(), note_);
  std::vector<LiveSourceState::Board> boards;
  for (const HidBoard& board : host_.boards()) boards.push_back({board, host_.free(board)});
  const int rowWires = status.info ? status.info->rowWires : host_.sensor().rowWires();
  const auto recordings = host_.recordingFile().empty()
                              ? std::filesystem::path(host_.settings().recording).parent_path()
                              : host_.recordingFile().parent_path();
  source_->displayState(
      {status, std::move(boards), host_.replaying(), rowWires, QString::fromStdString(recordings.string())});
  simulation_->setVisible(simulated);
  const SensorDesign& simulates = host_.simulatedSensor();
  simulation_->displayState({host_.pluggedIn(), host_.simulatesOwnDesign(), simulates.areas.count(),
                             simulates.rowWires(), simulates.columnWires(), host_.simulator().running()});
  const SimulationSettings& hand = host_.settings().simulation;
  block_->setPressable(simulated && hand.held, hand.heldArea);
  control_->displayState({status, host_.paused(), host_.replaying(), host_.recorded_s(), networkWords(host_),
                          host_.network().nameBefore()});
  send_->displayState(host_.sending());
  calibration_->displayState();
  banner_->display(host_, watch_.alarm(host_));
  const bool streams = status.state == LiveState::Streaming || status.state == LiveState::Paused;
  if (!streams) drawForces(); // the arrows turn grey
}

void LivePage::drawForces() {
  const LiveFrame* last = host_.history().last();
  if (last == nullptr) return block_->showForces({}, false, {tr("Force vectors: no data yet").toStdString()});
  const LiveState state = host_.status().state;
  const bool gone = state != LiveState::Streaming && state != LiveState::Paused;
  const bool stale = gone || !last->forces.valid;
  const LiveFrame* known = stale ? host_.history().lastValid() : last;
  const std::vector<LiveArrow> arrows = known != nullptr ? arrowsOf(known->forces) : std::vector<LiveArrow>{};
  arrowSeen_ = arrowSeen_ || std::any_of(arrows.begin(), arrows.end(), [](const LiveArrow& arrow) {
                 return arrow.force_N.norm() > 3; // a picture of the scene shows a good press
               });
  std::vector<std::string> lines = forceLines(*last, host_.settings(), note_.sentence);
  if (gone && host_.replaying() && state == LiveState::Ended)
    lines = {lines.front(), "end of the recording"};
  else if (gone)
    lines = {lines.front(), std::string("last known forces; the source is ") + name(state)};
  else if (stale && !arrows.empty())
    lines.insert(lines.begin() + 1, "grey: last known forces");
  std::optional<Eigen::Vector2d> truth_mm;
  if (const auto truth = gone ? std::nullopt : host_.trueTouch(last->frame); truth && truth->force_N.z() < 0) {
    truth_mm = truth->place_mm;
    lines.push_back(truthLine(*truth, last->forces));
  }
  const bool doubted = !gone && last->forces.valid && !last->forces.doubt.empty();
  block_->showForces(arrows, stale || doubted, lines, truth_mm);
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

} // namespace palp
