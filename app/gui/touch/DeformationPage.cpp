#include "app/gui/touch/DeformationPage.h"

#include "app/gui/project/Command.h"
#include "app/gui/touch/LoadPanel.h"
#include "app/gui/touch/ResultPanel.h"
#include "app/gui/touch/TouchTabs.h"
#include "app/gui/touch/ViewPanel.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/window/SidePanel.h"

#include <QButtonGroup>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kPanelWidth_px = 300;
constexpr double kMostForce_N = 500;

QGroupBox* group(const QString& title, QWidget* content) {
  auto* box = new QGroupBox(title);
  auto* layout = new QVBoxLayout(box);
  layout->addWidget(content);
  return box;
}

std::array<double, 3> rounded_mm(const Eigen::Vector3d& place) {
  return {std::round(1000 * place.x()) / 1000, std::round(1000 * place.y()) / 1000,
          std::round(1000 * place.z()) / 1000};
}

} // namespace

DeformationPage::DeformationPage(Workbench& workbench, QWidget* parent) : Scene(parent), workbench_(workbench) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 8, 8, 8);
  row->addWidget(buildPanels());
  row->addWidget(buildViews(), 1);

  connect(load_, &LoadPanel::edited, this, [this](const LoadCase& load) {
    Project next = workbench_.project();
    next.load = load;
    workbench_.edit(tr("Change the load on area %1").arg(load_->area()), next);
  });
  connect(view_, &ViewPanel::edited, this,
          [this](const ViewSettings& view) { editView(tr("Change the view of the block"), view); });
  connect(tabs_, &TouchTabs::edited, this, &DeformationPage::editView);
  connect(tabs_, &TouchTabs::cellClicked, this, [this](int rowWire, int columnWire) {
    ViewSettings view = workbench_.project().view;
    const std::array cell{rowWire, columnWire};
    view.litCell = view.litCell == cell ? std::nullopt : std::optional(cell);
    editView(tr("Light the electrodes of a cell"), view);
  });
  connect(tabs_, &TouchTabs::lineShownChanged, this, [this] { drawBlock(false); });
  connect(block_, &BlockView::nodeClicked, this, &DeformationPage::clicked);
  connect(block_, &BlockView::forceDragged, this, &DeformationPage::setForce);
  connect(result_, &ResultPanel::estimateAsked, this, [this] { workbench_.touch().estimateError(); });
  connect(&workbench_, &Workbench::projectChanged, this, &DeformationPage::displayProject);
  connect(&workbench_, &Workbench::projectReplaced, this, [this] {
    lineStart_ = -1;
    probe(-1);
  });
  connect(&workbench_.touch(), &TouchSession::changed, this, &DeformationPage::displayTouch);
  connect(&workbench_.touch(), &TouchSession::newtonStepped, this, [this] { tabs_->drawNewton(); });
  connect(&workbench_.touch(), &TouchSession::errorEstimated, this, [this](double relative, const QString& method) {
    result_->setErrorWords(std::isnan(relative) ? method : tr("%1 % (%2)").arg(100 * relative, 0, 'g', 3).arg(method));
    result_->display(workbench_.touch());
  });
  displayProject();
}

QWidget* DeformationPage::buildPanels() {
  auto* panels = new QWidget;
  auto* column = new QVBoxLayout(panels);
  column->setContentsMargins(0, 0, 6, 0);
  load_ = new LoadPanel;
  view_ = new ViewPanel;
  result_ = new ResultPanel;
  column->addWidget(group(tr("Load"), load_));
  column->addWidget(group(tr("View"), view_));
  column->addWidget(group(tr("Result"), result_));
  column->addStretch(1);
  return sidePanel(panels, kPanelWidth_px);
}

QWidget* DeformationPage::buildViews() {
  auto* upper = new QWidget;
  auto* column = new QVBoxLayout(upper);
  column->setContentsMargins(0, 0, 0, 0);
  block_ = new BlockView;
  block_->setObjectName("block");
  block_->setForcesMovable(true);
  block_->setToolTip(
      tr("Drag an arrow: force (Shift: its size alone); drag: turn; Shift or middle button: move; wheel: "
         "zoom; double click: all of it; right click: picture"));
  column->addWidget(buildClicks());
  column->addWidget(block_, 1);
  column->addWidget(buildIncrements());
  tabs_ = new TouchTabs(workbench_.touch());
  auto* views = new QSplitter(Qt::Vertical);
  views->setObjectName("deformationSplitter");
  views->addWidget(upper);
  views->addWidget(tabs_);
  views->setStretchFactor(0, 5);
  views->setStretchFactor(1, 2);
  views->setSizes({560, 240});
  return views;
}

QWidget* DeformationPage::buildClicks() {
  struct Choice {
    Click click;
    const char* name;
    QString words, tip;
  };
  const std::array<Choice, 3> choices{
      {{Click::Load, "clickLoad", tr("Load"), tr("A click on the top face chooses its load area, and loads it")},
       {Click::Probe, "clickProbe", tr("Probe"), tr("A click reads displacement [mm] and stress [MPa] at a point")},
       {Click::Line, "clickLine", tr("Line"), tr("Two clicks are the ends of a line to plot along")}}};
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 2);
  row->addWidget(new QLabel(tr("A click")));
  auto* all = new QButtonGroup(this);
  for (const Choice& choice : choices) {
    auto* button = new QToolButton;
    button->setObjectName(choice.name);
    button->setText(choice.words);
    button->setToolTip(choice.tip);
    button->setCheckable(true);
    button->setChecked(choice.click == click_);
    all->addButton(button);
    row->addWidget(button);
    connect(button, &QToolButton::clicked, this, [this, click = choice.click] {
      click_ = click;
      lineStart_ = -1;
      if (click == Click::Line) tabs_->showLine();
    });
  }
  row->addStretch(1);
  return bar;
}

QWidget* DeformationPage::buildIncrements() {
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  incrementLabel_ = new QLabel;
  increments_ = new QSlider(Qt::Horizontal);
  increments_->setObjectName("increments");
  increments_->setToolTip(tr("Equilibria on the way from rest to the full load"));
  row->addWidget(incrementLabel_);
  row->addWidget(increments_, 1);
  connect(increments_, &QSlider::valueChanged, this, [this](int k) {
    workbench_.touch().showIncrement(k);
    if (workbench_.touch().scrubbingTo() == k) return;
    const QSignalBlocker quiet(increments_); // a solve runs: its result comes first
    increments_->setValue(workbench_.touch().increment());
  });
  return bar;
}

void DeformationPage::setTheme(Theme theme) {
  theme_ = theme;
  tabs_->setTheme(theme);
  block_->setTheme(theme);
  drawBlock(false);
}

bool DeformationPage::complete() const {
  return workbench_.touch().fields() != nullptr && workbench_.touch().upToDate();
}

QString DeformationPage::commands(const Project& project, const QString& designFile) const {
  return solveCommands(project, designFile);
}

void DeformationPage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  displayTouch(!meshDrawn_);
}

void DeformationPage::displayProject() {
  const Project& project = workbench_.project();
  load_->display(project.design, project.load);
  view_->display(project.view, project.design.block_mm);
  tabs_->displayProject(project);
  if (!workbench_.touch().upToDate()) result_->setErrorWords({});
  if (isVisible()) result_->display(workbench_.touch());
  if (!(drawn_ == project.view)) drawBlock(false);
}

void DeformationPage::displayTouch(bool meshChanged) {
  meshDrawn_ = meshDrawn_ && !meshChanged;
  if (meshChanged) probedNode_ = lineStart_ = -1;
  tabs_->displayTouch(meshChanged);
  if (!isVisible()) return;
  drawBlock(meshChanged);
  displayIncrements();
  result_->display(workbench_.touch());
  probe(probedNode_);
}

void DeformationPage::displayIncrements() {
  const TouchSession& touch = workbench_.touch();
  const QSignalBlocker quiet(increments_);
  increments_->setRange(0, std::max(0, touch.incrementCount() - 1));
  increments_->setEnabled(touch.incrementCount() > 1);
  increments_->setValue(touch.increment());
  incrementLabel_->setText(tr("Load fraction %1").arg(touch.loadFraction(), 0, 'g', 3));
}

DeformationOptions DeformationPage::blockOptions() const {
  const ViewSettings& view = workbench_.project().view;
  const Touch& touch = workbench_.touch().touch();
  DeformationOptions options = view.blockOptions();
  options.theme = theme_;
  options.scale = devicePixelRatioF();
  for (const AreaLoad& load : touch.load().areas) options.selectedAreas.push_back(load.area);
  if (options.litCell &&
      ((*options.litCell)[0] >= touch.design().rowWires() || (*options.litCell)[1] >= touch.design().columnWires()))
    options.litCell.reset();
  if (tabs_->lineShown())
    options.line_mm = {Eigen::Vector3d(view.lineFrom_mm.data()), Eigen::Vector3d(view.lineTo_mm.data())};
  return options;
}

void DeformationPage::drawBlock(bool meshChanged) {
  const TouchSession& touch = workbench_.touch();
  if (touch.touch().mesh() == nullptr || !isVisible()) return;
  const SensorDesign& design = touch.touch().design();
  drawn_ = workbench_.project().view;
  const DeformationState state{
      &design, touch.touch().mesh(), touch.fields(), touch.electrodes(), &touch.touch().load(), touch.loadFraction()};
  block_->show(state, blockOptions(), meshChanged || !meshDrawn_);
  meshDrawn_ = true;
  view_->displayWarp(block_->warpFactor());
}

void DeformationPage::clicked(int node) {
  if (workbench_.touch().fields() == nullptr) return;
  if (click_ == Click::Line) {
    addLineEnd(node);
    return;
  }
  probe(node);
  if (click_ == Click::Load) loadAreaOf(node);
}

void DeformationPage::loadAreaOf(int node) {
  const Touch& touch = workbench_.touch().touch();
  const Eigen::Vector3d place = touch.mesh()->nodes_mm.col(node);
  if (place.z() < touch.design().block_mm.z() * (1 - 1e-9)) return;
  const SensorDesign& design = workbench_.project().design;
  for (int area = 0; area < design.areas.count(); ++area) {
    const Rectangle box = design.areaRectangle(area);
    if ((place.head<2>().array() < box.low_mm.array()).any() || (place.head<2>().array() > box.high_mm.array()).any())
      continue;
    load_->chooseArea(area);
    return;
  }
}

void DeformationPage::addLineEnd(int node) {
  if (lineStart_ < 0) {
    lineStart_ = node;
    block_->markNode(node);
    emit message(tr("Now click on the other end of the line."));
    return;
  }
  const Eigen::Matrix3Xd& nodes = workbench_.touch().touch().mesh()->nodes_mm;
  ViewSettings view = workbench_.project().view;
  view.lineFrom_mm = rounded_mm(nodes.col(lineStart_));
  view.lineTo_mm = rounded_mm(nodes.col(node));
  lineStart_ = -1;
  block_->markNode(-1);
  editView(tr("Change the line"), view);
}

void DeformationPage::setForce(int load, const Eigen::Vector3d& drawn_N) {
  const double fraction = workbench_.touch().loadFraction();
  if (!(fraction > 0)) return;
  Project next = workbench_.project();
  const auto areas = static_cast<int>(next.load.areas.size());
  if (load >= areas + static_cast<int>(next.load.patches.size())) return;
  Eigen::Vector3d& force_N = load < areas ? next.load.areas[static_cast<std::size_t>(load)].force_N
                                          : next.load.patches[static_cast<std::size_t>(load - areas)].force_N;
  force_N = (drawn_N / fraction).cwiseMax(-kMostForce_N).cwiseMin(kMostForce_N);
  if (load < areas) load_->chooseArea(next.load.areas[static_cast<std::size_t>(load)].area);
  workbench_.edit(tr("Drag a force"), next);
}

void DeformationPage::editView(const QString& what, const ViewSettings& view) {
  Project next = workbench_.project();
  next.view = view;
  workbench_.edit(what, next);
}

void DeformationPage::probe(int node) {
  const TouchSession& session = workbench_.touch();
  const bool known = node >= 0 && session.fields() != nullptr && node < session.touch().mesh()->nodeCount();
  probedNode_ = known ? node : -1;
  block_->markNode(probedNode_);
  result_->displayProbe(session, probedNode_);
}

} // namespace palp
