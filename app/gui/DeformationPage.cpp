#include "app/gui/DeformationPage.h"

#include "app/gui/BlockView.h"
#include "app/gui/ChartView.h"
#include "app/gui/DeformationCharts.h"
#include "app/gui/HeatmapSpecs.h"
#include "app/gui/HeatmapView.h"
#include "app/gui/LoadPanel.h"
#include "app/gui/ViewPanel.h"

#include <QGroupBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QSplitter>
#include <QTabWidget>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

constexpr int kPanelWidth_px = 300;
constexpr int kTextWidth_px = 250; ///< of the panels, less their frames

QGroupBox* group(const QString& title, QWidget* content) {
  auto* box = new QGroupBox(title);
  auto* layout = new QVBoxLayout(box);
  layout->addWidget(content);
  return box;
}

/// As high as its words; a layout alone takes the height of the words before.
void fitHeight(QLabel& label) {
  label.setMinimumHeight(0);
  label.setMinimumHeight(label.heightForWidth(kTextWidth_px));
}

QString number(double value, int digits = 4) {
  return QString::number(value, 'g', digits);
}

bool sameSteps(const std::vector<NewtonStep>& a, const std::vector<NewtonStep>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const NewtonStep& one, const NewtonStep& other) {
    return one.loadFraction == other.loadFraction && one.relativeResidual == other.relativeResidual;
  });
}

} // namespace

DeformationPage::DeformationPage(Workbench& workbench, QWidget* parent) : Scene(parent), workbench_(workbench) {
  options_.meshEdges = false;
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 8, 8, 8);
  row->addWidget(buildPanels());
  row->addWidget(buildViews(), 1);

  connect(load_, &LoadPanel::edited, this, [this](const LoadCase& load) {
    Project next = workbench_.project();
    next.load = load;
    workbench_.edit(tr("Change the load on area %1").arg(load_->area()), next);
  });
  connect(view_, &ViewPanel::edited, this, [this] { drawBlock(false); });
  connect(block_, &BlockView::nodeClicked, this, [this](int node) {
    probe(node);
    chooseAreaOf(node);
  });
  connect(increments_, &QSlider::valueChanged, this, [this](int k) {
    workbench_.touch().showIncrement(k);
    if (workbench_.touch().scrubbingTo() == k) return;
    const QSignalBlocker quiet(increments_); // a solve runs: its result comes first
    increments_->setValue(workbench_.touch().increment());
  });
  connect(estimate_, &QPushButton::clicked, this, [this] { workbench_.touch().estimateError(); });
  connect(heatmap_, &HeatmapView::cellClicked, this, [this](int rowWire, int columnWire) {
    const std::array cell{rowWire, columnWire};
    options_.litCell = options_.litCell == cell ? std::nullopt : std::optional(cell);
    drawHeatmap();
    drawBlock(false);
  });
  connect(&workbench_, &Workbench::projectChanged, this, &DeformationPage::displayProject);
  connect(&workbench_.touch(), &TouchSession::changed, this, &DeformationPage::displayTouch);
  connect(&workbench_.touch(), &TouchSession::newtonStepped, this, &DeformationPage::drawNewton);
  connect(&workbench_.touch(), &TouchSession::errorEstimated, this, [this](double relative, const QString& method) {
    errorText_ = tr("%1 % (%2)").arg(number(100 * relative, 3), method);
    tellResult();
  });
  displayProject();
  tellResult();
}

QWidget* DeformationPage::buildPanels() {
  auto* panels = new QWidget;
  auto* column = new QVBoxLayout(panels);
  column->setContentsMargins(0, 0, 6, 0);
  load_ = new LoadPanel;
  column->addWidget(group(tr("Load"), load_));
  view_ = new ViewPanel;
  column->addWidget(group(tr("View"), view_));
  result_ = new QLabel;
  result_->setObjectName("result");
  result_->setWordWrap(true);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* results = new QWidget;
  auto* lines = new QVBoxLayout(results);
  lines->setContentsMargins(0, 0, 0, 0);
  lines->addWidget(result_);
  estimate_ = new QPushButton(tr("Estimate the discretisation error"));
  estimate_->setObjectName("estimate");
  estimate_->setToolTip(tr("Solves again on a finer mesh and compares the electrodes' displacements"));
  lines->addWidget(estimate_);
  probe_ = new QLabel(tr("Click on the block to probe a point."));
  probe_->setObjectName("probe");
  probe_->setWordWrap(true);
  lines->addWidget(probe_);
  column->addWidget(group(tr("Result"), results));
  column->addStretch(1);
  auto* scroll = new QScrollArea;
  scroll->setWidget(panels);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFixedWidth(kPanelWidth_px);
  return scroll;
}

QWidget* DeformationPage::buildViews() {
  auto* upper = new QWidget;
  auto* column = new QVBoxLayout(upper);
  column->setContentsMargins(0, 0, 0, 0);
  block_ = new BlockView;
  block_->setObjectName("block");
  block_->setToolTip(
      tr("Drag: turn; Shift or middle button: move; wheel: zoom; double click: all of it; click: probe"));
  column->addWidget(block_, 1);
  auto* scrub = new QHBoxLayout;
  incrementLabel_ = new QLabel;
  increments_ = new QSlider(Qt::Horizontal);
  increments_->setObjectName("increments");
  increments_->setToolTip(tr("Equilibria on the way from rest to the full load"));
  scrub->addWidget(incrementLabel_);
  scrub->addWidget(increments_, 1);
  column->addLayout(scrub);
  heatmap_ = new HeatmapView;
  heatmap_->setObjectName("heatmap");
  newton_ = new ChartView;
  newton_->setObjectName("newton");
  auto* touch = new QSplitter(Qt::Horizontal);
  touch->addWidget(heatmap_);
  touch->addWidget(newton_);
  touch->setStretchFactor(0, 3);
  touch->setStretchFactor(1, 2);
  auto* lower = new QTabWidget;
  lower->setObjectName("deformationTabs");
  lower->addTab(touch, tr("Resistances"));
  lower->addTab(buildElectrodes(), tr("Row-wire"));
  table_ = new QTableWidget;
  table_->setObjectName("electrodeTable");
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  lower->addTab(table_, tr("Electrodes"));
  connect(lower, &QTabWidget::currentChanged, this, [this] {
    drawRowWire();
    fillTable();
  });
  auto* views = new QSplitter(Qt::Vertical);
  views->setObjectName("deformationSplitter");
  views->addWidget(upper);
  views->addWidget(lower);
  views->setStretchFactor(0, 5);
  views->setStretchFactor(1, 2);
  views->setSizes({560, 240});
  return views;
}

QWidget* DeformationPage::buildElectrodes() {
  auto* page = new QWidget;
  auto* row = new QHBoxLayout(page);
  row->setContentsMargins(4, 4, 4, 4);
  auto* side = new QVBoxLayout;
  side->addWidget(new QLabel(tr("Row-wire")));
  rowWireNumber_ = new QSpinBox;
  rowWireNumber_->setObjectName("rowWireNumber");
  rowWireNumber_->setValue(4);
  side->addWidget(rowWireNumber_);
  side->addStretch(1);
  row->addLayout(side);
  rowWire_ = new ChartView;
  rowWire_->setObjectName("rowWire");
  row->addWidget(rowWire_, 1);
  connect(rowWireNumber_, &QSpinBox::valueChanged, this, &DeformationPage::drawRowWire);
  return page;
}

void DeformationPage::setTheme(Theme theme) {
  options_.theme = theme;
  heatmap_->setTheme(theme);
  block_->setTheme(theme);
  newton_->setTheme(theme);
  rowWire_->setTheme(theme);
  drawBlock(false);
}

bool DeformationPage::complete() const {
  return workbench_.touch().fields() != nullptr && workbench_.touch().upToDate();
}

void DeformationPage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  displayTouch(!meshDrawn_);
}

void DeformationPage::displayProject() {
  load_->display(workbench_.project().design, workbench_.project().load);
  view_->displayBlock(workbench_.project().design.block_mm);
  errorText_.clear();
  tellResult();
}

void DeformationPage::displayTouch(bool meshChanged) {
  meshDrawn_ = meshDrawn_ && !meshChanged;
  if (!isVisible()) return;
  const TouchSession& touch = workbench_.touch();
  drawBlock(meshChanged);
  drawHeatmap();
  drawNewton();
  drawRowWire();
  fillTable();
  const QSignalBlocker quiet(increments_);
  increments_->setRange(0, std::max(0, touch.incrementCount() - 1));
  increments_->setEnabled(touch.incrementCount() > 1);
  increments_->setValue(touch.increment());
  incrementLabel_->setText(tr("Load fraction %1").arg(number(touch.loadFraction(), 3)));
  tellResult();
  probe(probedNode_);
}

void DeformationPage::drawBlock(bool meshChanged) {
  const TouchSession& touch = workbench_.touch();
  if (touch.touch().mesh() == nullptr || !isVisible()) return;
  options_ = view_->options(options_);
  options_.scale = devicePixelRatioF();
  options_.selectedAreas.clear();
  for (const AreaLoad& load : touch.touch().load().areas) options_.selectedAreas.push_back(load.area);
  if (options_.litCell && ((*options_.litCell)[0] >= touch.touch().design().rowWires() ||
                           (*options_.litCell)[1] >= touch.touch().design().columnWires()))
    options_.litCell.reset();
  const DeformationState state{&touch.touch().design(), touch.touch().mesh(),  touch.fields(),
                               touch.electrodes(),      &touch.touch().load(), touch.loadFraction()};
  if (meshChanged) probedNode_ = -1;
  block_->show(state, options_, meshChanged || !meshDrawn_);
  meshDrawn_ = true;
  view_->displayWarp(block_->warpFactor());
}

void DeformationPage::drawHeatmap() {
  const TouchSession& touch = workbench_.touch();
  if (touch.electrodes() == nullptr || !isVisible()) return;
  HeatmapSpec spec = resistanceHeatmap(touch.touch(), rowColumnResistances(touch.touch().design(), *touch.electrodes()),
                                       ResistanceKind::RelativeChange);
  spec.selected = options_.litCell;
  heatmap_->setHeatmap(std::move(spec));
}

void DeformationPage::drawNewton() {
  if (!isVisible()) return;
  std::vector<NewtonStep> steps = workbench_.touch().newton();
  if (sameSteps(steps, drawnSteps_)) return;
  drawnSteps_ = std::move(steps);
  newton_->setChart(newtonChart(drawnSteps_));
}

void DeformationPage::drawRowWire() {
  const TouchSession& touch = workbench_.touch();
  if (touch.electrodes() == nullptr || !rowWire_->isVisible()) return;
  const SensorDesign& design = touch.touch().design();
  const QSignalBlocker quiet(rowWireNumber_);
  rowWireNumber_->setRange(0, design.rowWires() - 1);
  rowWire_->setChart(rowWireChart(design, *touch.electrodes(), rowWireNumber_->value()));
}

void DeformationPage::fillTable() {
  const TouchSession& touch = workbench_.touch();
  if (touch.electrodes() == nullptr || !table_->isVisible()) return;
  const SensorDesign& design = touch.touch().design();
  const Eigen::Matrix3Xd places = design.upperElectrodes_mm();
  table_->setColumnCount(8);
  table_->setRowCount(static_cast<int>(places.cols()));
  table_->setHorizontalHeaderLabels({tr("row-wire"), tr("electrode"), tr("x [mm]"), tr("y [mm]"), tr("z [mm]"),
                                     tr("ux [mm]"), tr("uy [mm]"), tr("uz [mm]")});
  table_->verticalHeader()->hide();
  for (int k = 0; k < places.cols(); ++k) {
    QStringList cells{QString::number(k / design.electrodesPerRowWire()),
                      QString::number(k % design.electrodesPerRowWire())};
    for (const double value : places.col(k)) cells << number(value);
    for (const double value : touch.electrodes()->upper_mm.col(k)) cells << number(value, 6);
    for (int column = 0; column < cells.size(); ++column) {
      auto* cell = new QTableWidgetItem(cells[column]);
      cell->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(k, column, cell);
    }
  }
}

void DeformationPage::tellResult() {
  const TouchSession& session = workbench_.touch();
  const Solution* solution = session.touch().solution();
  estimate_->setEnabled(solution != nullptr && solution->converged && session.upToDate());
  if (solution == nullptr) {
    result_->setText(tr("Not computed yet."));
    return;
  }
  const Touch& touch = session.touch();
  QStringList lines;
  lines << (solution->converged
                ? tr("Converged in %1 iterations.").arg(solution->newton.size())
                : tr("Stopped at load fraction %1: %2")
                      .arg(number(solution->reachedLoadFraction, 3), QString::fromStdString(solution->stopReason)));
  lines << tr("%1 elements (%2), %3 unknowns.")
               .arg(touch.mesh()->elementCount())
               .arg(QString::fromStdString(touch.problem()->elementType()))
               .arg(touch.problem()->dof());
  if (session.fields() != nullptr)
    lines
        << tr("Largest displacement %1 mm.").arg(number(session.fields()->displacement_mm.colwise().norm().maxCoeff()));
  lines << tr("Largest volume error |J - 1|: %1.").arg(number(solution->maxVolumeError, 3));
  lines << tr("Discretisation error: %1").arg(errorText_.isEmpty() ? tr("not estimated yet.") : errorText_ + ".");
  if (!session.upToDate()) lines << tr("<i>The load has changed; this is the result before.</i>");
  result_->setText(lines.join("<br>"));
  fitHeight(*result_);
}

void DeformationPage::chooseAreaOf(int node) {
  const Touch& touch = workbench_.touch().touch();
  const Eigen::Vector3d place = touch.mesh()->nodes_mm.col(node);
  if (place.z() < touch.design().block_mm.z() * (1 - 1e-9)) return;
  for (const AreaLoad& load : workbench_.project().load.areas) {
    const Rectangle box = touch.design().areaRectangle(load.area);
    if ((place.head<2>().array() >= box.low_mm.array()).all() &&
        (place.head<2>().array() <= box.high_mm.array()).all()) {
      load_->chooseArea(load.area);
      return;
    }
  }
}

void DeformationPage::probe(int node) {
  const TouchSession& session = workbench_.touch();
  const bool known = node >= 0 && session.fields() != nullptr && node < session.touch().mesh()->nodeCount();
  probedNode_ = known ? node : -1;
  block_->markNode(probedNode_);
  if (!known) {
    probe_->setText(tr("Click on the block to probe a point."));
    return;
  }
  const Eigen::Vector3d place = session.touch().mesh()->nodes_mm.col(node);
  const NodalFields& fields = *session.fields();
  const Eigen::Vector3d u = fields.displacement_mm.col(node);
  probe_->setText(tr("<b>Point (%1, %2, %3) mm</b><br>u = (%4, %5, %6) mm<br>pressure %7 MPa, von Mises %8 MPa, "
                     "J - 1 = %9")
                      .arg(number(place.x()), number(place.y()), number(place.z()), number(u.x()), number(u.y()),
                           number(u.z()), number(fields.pressure_MPa[node]), number(fields.vonMises_MPa[node]),
                           number(fields.volumeRatio[node] - 1, 3)));
  fitHeight(*probe_);
}

} // namespace palp
