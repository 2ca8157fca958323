#include "app/gui/touch/DeformationPage.h"

#include "app/gui/project/Command.h"
#include "app/gui/touch/LoadPathBar.h"
#include "app/gui/touch/ResultPanel.h"
#include "app/gui/touch/StaleNote.h"
#include "app/gui/touch/TouchTabs.h"
#include "app/gui/touch/ViewPanel.h"
#include "app/gui/touch/loads/LoadPanel.h"
#include "app/gui/touch/loads/PathPanel.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ViewBar.h"
#include "app/gui/widgets/FoldingRow.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/window/SidePanel.h"

#include <QButtonGroup>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kPanelWidth_px = 300;
constexpr double kMostGripForce_N = 500;

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

  connect(load_, &LoadPanel::edited, this, [this](const QString& what, const LoadCase& load) {
    Project next = workbench_.project();
    next.load = load;
    next.path = pathKept(next.path, workbench_.project().load, load);
    workbench_.edit(what, next);
  });
  connect(view_, &ViewPanel::edited, this,
          [this](const ViewSettings& view) { editView(tr("Change the view of the block"), view); });
  connect(tabs_, &TouchTabs::edited, this, &DeformationPage::editView);
  connect(tabs_, &TouchTabs::cellClicked, this, [this](int rowWire, int columnWire) {
    ViewSettings view = workbench_.project().view;
    const std::array cell{rowWire, columnWire};
    view.litCell = view.litCell == cell ? std::nullopt : std::optional(cell);
    view.cell = cell; // the Resistance scene opens with it
    editView(tr("Highlight the electrodes of a cell"), view);
  });
  connect(tabs_, &TouchTabs::lineShownChanged, this, [this] { drawBlock(false); });
  connect(block_, &BlockView::nodeClicked, this, &DeformationPage::clicked);
  connect(block_, &BlockView::materialClicked, this, &DeformationPage::press);
  connect(block_, &BlockView::discDragged, this,
          [this](int disc, const PatchLoad& to) { load_->changeDisc(disc, to.centre_mm, to.radius_mm); });
  connect(block_, &BlockView::indenterMoved, load_, &LoadPanel::moveIndenter);
  connect(block_, &BlockView::indenterSized, load_, &LoadPanel::sizeIndenter);
  connect(block_, &BlockView::wayDrawn, steps_, &PathPanel::draw);
  connect(steps_, &PathPanel::message, this, &DeformationPage::message);
  connect(result_, &ResultPanel::uniformRequested, this, [this](bool on) {
    ViewSettings view = workbench_.project().view;
    view.lessReference = view.uniform = on;
    editView(tr("Compare with uniform load"), view);
  });
  connect(block_, &BlockView::cutDragged, this, [this](double at_mm) {
    ViewSettings view = workbench_.project().view;
    if (!view.cut) return;
    view.cut->at_mm = at_mm;
    editView(tr("Move the cut"), view);
  });
  connect(block_, &BlockView::forceDragged, this, &DeformationPage::setForce);
  connect(result_, &ResultPanel::estimateRequested, this, [this] { workbench_.touch().estimateError(); });
  connect(&workbench_, &Workbench::projectChanged, this, &DeformationPage::displayProject);
  connect(&workbench_, &Workbench::projectReplaced, this, [this] {
    lineStart_ = -1;
    probe(-1);
  });
  connect(&workbench_.touch(), &TouchSession::changed, this, &DeformationPage::displayTouch);
  connect(&workbench_.kept(), &ReferenceTouch::changed, this, [this] { displayTouch(false); });
  connect(&workbench_.touch(), &TouchSession::newtonStepped, this, [this] { tabs_->drawNewton(); });
  connect(&workbench_.touch(), &TouchSession::errorEstimated, this, [this](double relative, const QString& method) {
    result_->setErrorWords(std::isnan(relative) ? method : tr("%1 % (%2)").arg(100 * relative, 0, 'g', 3).arg(method));
    displayResult();
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
  addTo(*column, {group(tr("Load"), load_), group(tr("View"), view_), group(tr("Result"), result_), Part::stretch()});
  return sidePanel(panels, kPanelWidth_px);
}

QWidget* DeformationPage::buildViews() {
  auto* upper = new QWidget;
  auto* column = new QVBoxLayout(upper);
  column->setContentsMargins(0, 0, 0, 0);
  block_ = new BlockView;
  block_->setObjectName("block");
  block_->setForcesMovable(true);
  new StaleNote(*block_, workbench_);
  block_->setToolTip(tr("Drag an arrow: force (Shift: magnitude only); drag: rotate; Shift or middle button: pan; "
                        "wheel: zoom; double click: show all; right click: picture"));
  column->addWidget(buildClicks());
  column->addWidget(block_, 1);
  path_ = new LoadPathBar(workbench_.touch());
  column->addWidget(path_);
  tabs_ = new TouchTabs(workbench_);
  steps_ = new PathPanel(workbench_);
  tabs_->addTab(steps_, tr("Path"));
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
    QKeySequence key;
    QString words, tip;
  };
  const std::array<Choice, 5> choices{
      {{Click::Probe, "clickProbe", Qt::Key_P, tr("Probe"),
        tr("Click to read displacement [mm] and stress [MPa] at a point")},
       {Click::Load, "clickLoad", Qt::Key_A, tr("Press an area"),
        tr("Click on the top face to select its load area and load it")},
       {Click::Disc, "clickDisc", Qt::Key_D, tr("Press a disc"),
        tr("Click on the top face to add a round load; drag it to move it, drag its rim to resize it, Shift-click to "
           "remove it")},
       {Click::Indenter, "clickIndenter", Qt::Key_I, tr("Indenter"),
        tr("Click on the top face to press with a rigid body there; drag it to move it, drag its rim to resize it, "
           "drag its arrow to press harder, Ctrl-drag to draw a sliding path, Shift-click to remove it")},
       {Click::Line, "clickLine", Qt::Key_L, tr("Line"), tr("Click twice to set the ends of a line to plot along")}}};
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 2);
  row->addWidget(new QLabel(tr("Tool")));
  auto* all = new QButtonGroup(this);
  for (const Choice& choice : choices) {
    auto* button = new QToolButton;
    button->setObjectName(choice.name);
    button->setText(choice.words);
    button->setToolTip(tr("%1 (key %2)").arg(choice.tip, choice.key.toString()));
    button->setShortcut(choice.key);
    button->setCheckable(true);
    button->setChecked(choice.click == click_);
    all->addButton(button);
    row->addWidget(button);
    connect(button, &QToolButton::clicked, this, [this, click = choice.click] { chooseTool(click); });
  }
  return new FoldingRow(bar, new ViewBar(*block_));
}

void DeformationPage::setTheme(Theme theme) {
  theme_ = theme;
  tabs_->setTheme(theme);
  block_->setTheme(theme);
  drawBlock(false);
}

bool DeformationPage::complete() const {
  const bool compared = !lessReference() || shownLess() || !workbench_.kept().problem().isEmpty();
  return workbench_.touch().fields() != nullptr && workbench_.touch().upToDate() && compared && tabs_->complete();
}

QString DeformationPage::commands(const Project& project, const QString& designFile) const {
  return solveCommands(project, designFile);
}

void DeformationPage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  workbench_.field().retry();
  displayTouch(!meshDrawn_);
}

void DeformationPage::displayProject() {
  const Project& project = workbench_.project();
  load_->display(project.design, project.load);
  view_->display(project.view, project.design.block_mm, project.kept.has_value(), !project.load.indenters.empty());
  tabs_->displayProject(project);
  if (!workbench_.touch().upToDate()) result_->setErrorWords({});
  if (isVisible()) displayResult();
  if (lessReference() || drawn_.lessReference)
    displayTouch(false);
  else if (!(drawn_ == project.view) || drawnPath_ != project.path)
    drawBlock(false);
}

bool DeformationPage::lessReference() const {
  return workbench_.project().view.lessReference && workbench_.comparable();
}

std::shared_ptr<const ReferencePath> DeformationPage::shownLess() const {
  return lessReference() ? workbench_.referencePath() : nullptr;
}

void DeformationPage::displayResult() {
  result_->display(workbench_.touch());
  const auto kept = shownLess();
  result_->displayDifference(workbench_.project(), workbench_.touch(), kept.get(),
                             lessReference() ? workbench_.kept().problem() : QString());
}

void DeformationPage::displayTouch(bool meshChanged) {
  meshDrawn_ = meshDrawn_ && !meshChanged;
  if (meshChanged) probedNode_ = lineStart_ = -1;
  if (isVisible() && lessReference()) workbench_.needReference();
  tabs_->displayTouch(meshChanged, shownLess());
  if (!isVisible()) return;
  drawBlock(meshChanged);
  path_->display();
  displayResult();
  probe(probedNode_);
}

DeformationOptions DeformationPage::blockOptions() const {
  const ViewSettings& view = workbench_.project().view;
  const Touch& touch = workbench_.touch().touch();
  DeformationOptions options = view.blockOptions();
  options.theme = theme_;
  options.cutGrip = true;
  options.lessReference = lessReference();
  const auto kept = shownLess();
  // One colour scale and one deformation scale on the complete load path.
  if (const NodalFields* end = workbench_.touch().endFields(); end != nullptr) {
    if (!options.fixedRange && !options.lessReference)
      options.fixedRange = quantityRange(options, quantityValues(options.quantity, *end));
    if (!options.fixedRange && kept)
      options.fixedRange = quantityRange(
          options, quantityValues(options.quantity, *end, kept->at(touch.solution()->reachedLoadFraction).fields));
    if (!options.deformationScale)
      options.deformationScale = automaticDeformationScale(touch.design(), end->displacement_mm);
  }
  options.scale = devicePixelRatioF();
  options.way_mm = wayOf(workbench_.project().load, workbench_.project().path);
  for (const AreaLoad& load : touch.load().areas) options.selectedAreas.push_back(load.area);
  if (options.litCell &&
      ((*options.litCell)[0] >= touch.design().rowWires() || (*options.litCell)[1] >= touch.design().columnWires()))
    options.litCell.reset();
  if (tabs_->lineShown()) {
    const auto line = view.lineIn(touch.design().block_mm);
    options.line_mm = {Eigen::Vector3d(line[0].data()), Eigen::Vector3d(line[1].data())};
  }
  return options;
}

void DeformationPage::drawBlock(bool meshChanged) {
  const TouchSession& touch = workbench_.touch();
  if (touch.touch().mesh() == nullptr || !isVisible()) return;
  const SensorDesign& design = touch.touch().design();
  drawn_ = workbench_.project().view;
  drawnPath_ = workbench_.project().path;
  DeformationState state{
      &design, touch.touch().mesh(), touch.fields(), touch.electrodes(), &touch.touch().load(), touch.loadFraction()};
  state.indenters = touch.indenters();
  const auto kept = shownLess();
  std::optional<LoadPathState> less;
  if (kept) {
    state.referenceDesign = &kept->design;
    state.keptLoad = &kept->load;
    state.kept = &less.emplace(kept->at(touch.loadFraction())).fields;
  }
  block_->show(state, blockOptions(), meshChanged || !meshDrawn_);
  meshDrawn_ = true;
  view_->displayDrawn(block_->deformationScale(), block_->colorRange());
}

void DeformationPage::chooseTool(Click click) {
  click_ = click;
  lineStart_ = -1;
  block_->setMovable(click == Click::Disc       ? BlockView::Movable::Discs
                     : click == Click::Indenter ? BlockView::Movable::Indenters
                                                : BlockView::Movable::None);
  if (click != Click::Line) return;
  tabs_->showLine();
  emit message(tr("Click on one end of the line, then on the other."));
}

void DeformationPage::clicked(int node) {
  if (workbench_.touch().fields() == nullptr) return;
  click_ == Click::Line ? addLineEnd(node) : probe(node);
}

void DeformationPage::press(const Eigen::Vector3d& rest_mm) {
  const SensorDesign& design = workbench_.project().design;
  const bool pressing = click_ == Click::Load || click_ == Click::Disc || click_ == Click::Indenter;
  if (!pressing || rest_mm.z() < workbench_.touch().touch().design().block_mm.z() * (1 - 1e-6)) return;
  const Eigen::Vector2d place = rest_mm.head<2>();
  if (click_ == Click::Load) {
    for (int area = 0; area < design.areas.count(); ++area) {
      const Rectangle box = design.areaRectangle(area);
      if ((place.array() < box.low_mm.array()).any() || (place.array() > box.high_mm.array()).any()) continue;
      load_->choose({LoadKind::Area, area});
      return;
    }
    return;
  }
  click_ == Click::Indenter ? load_->pressIndenter(place) : load_->pressDisc(place);
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
  emit message(tr("The line is plotted under \"Along a line\"; two more clicks set another line."));
}

void DeformationPage::setForce(int load, const Eigen::Vector3d& drawn_N) {
  const double fraction = workbench_.touch().loadFraction();
  if (!(fraction > 0)) return;
  Project next = workbench_.project();
  const auto areas = static_cast<int>(next.load.areas.size()), discs = static_cast<int>(next.load.patches.size());
  const Eigen::Vector3d force_N = (drawn_N / fraction).cwiseMax(-kMostGripForce_N).cwiseMin(kMostGripForce_N);
  if (load < areas) {
    AreaLoad& area = next.load.areas[static_cast<std::size_t>(load)];
    area.force_N = force_N;
    load_->choose({LoadKind::Area, area.area});
  } else if (load < areas + discs) {
    next.load.patches[static_cast<std::size_t>(load - areas)].force_N = force_N;
    load_->choose({LoadKind::Disc, load - areas});
  } else {
    const auto k = static_cast<std::size_t>(load - areas - discs);
    if (k >= next.load.indenters.size() || next.load.indenters[k].press() == nullptr) return;
    next.load.indenters[k].control = Press{force_N};
    next.path = pathKept(next.path, workbench_.project().load, next.load);
    load_->choose({LoadKind::Indenter, static_cast<int>(k)});
  }
  workbench_.edit(tr("Drag a force"), next);
}

void DeformationPage::editView(const QString& what, const ViewSettings& view) {
  workbench_.edit(what, [&](Project& next) { next.view = view; });
}

void DeformationPage::probe(int node) {
  const TouchSession& session = workbench_.touch();
  const bool known = node >= 0 && session.fields() != nullptr && node < session.touch().mesh()->nodeCount();
  probedNode_ = known ? node : -1;
  block_->markNode(probedNode_);
  const auto kept = shownLess();
  result_->displayProbe(session, probedNode_, kept.get());
}

} // namespace palp
