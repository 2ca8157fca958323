#include "app/gui/touch/TouchTabs.h"

#include "app/gui/project/Workbench.h"
#include "app/gui/touch/ElectrodeTable.h"
#include "app/gui/touch/LoadCurves.h"
#include "app/gui/touch/ResistanceWords.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapSpecs.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/widgets/UnclearComma.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <optional>

namespace palp {

namespace {

bool sameSteps(const std::vector<NewtonStep>& a, const std::vector<NewtonStep>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const NewtonStep& one, const NewtonStep& other) {
    return one.loadFraction == other.loadFraction && one.relativeResidual == other.relativeResidual;
  });
}

ChartView* chart(const char* name) {
  auto* view = new ChartView;
  view->setObjectName(name);
  return view;
}

QString lineEndText(const std::array<double, 3>& place) {
  QStringList numbers;
  for (const double value : place) numbers << QString::number(value, 'g', 6);
  return numbers.join(", ");
}

/// Three numbers with commas and blanks between them.
std::optional<std::array<double, 3>> placeOf(const QString& words) {
  const QStringList parts = words.split(',');
  if (parts.size() != 3 || !unclearComma(words).isEmpty()) return {};
  std::array<double, 3> place{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = typedNumber(parts[static_cast<int>(k)]);
    if (!number) return {};
    place[k] = *number;
  }
  return place;
}

} // namespace

TouchTabs::TouchTabs(Workbench& workbench, QWidget* parent)
    : QTabWidget(parent), workbench_(workbench), session_(workbench.touch()) {
  setObjectName("deformationTabs");
  addTab(buildTouch(), tr("Resistances"));
  addTab(buildRowWire(), tr("Row-wire"));
  table_ = new ElectrodeTable;
  addTab(table_, tr("Electrodes"));
  linePage_ = buildLine();
  addTab(linePage_, tr("Along a line"));
  addTab(buildLoad(), tr("Along the load"));
  setTabToolTip(count() - 1, tr("Reaction at the bottom and force against displacement, at every equilibrium computed "
                                "along the load and its path"));
  connect(this, &QTabWidget::currentChanged, this, [this] {
    draw();
    emit lineShownChanged();
  });
  connect(&workbench_.field(), &FieldTouch::changed, this, &TouchTabs::drawHeatmap);
}

QWidget* TouchTabs::buildTouch() {
  heatmap_ = new HeatmapView;
  heatmap_->setObjectName("heatmap");
  newton_ = chart("newton");
  auto* touch = new QSplitter(Qt::Horizontal);
  touch->setObjectName("touchSplitter");
  touch->addWidget(heatmap_);
  touch->addWidget(newton_);
  touch->setSizes({600, 400});
  heatmap_->setCellWords([this](const std::array<int, 2>& cell) {
    const auto resistances = workbench_.resistances();
    return resistances ? cellNumbers(*resistances, cell) : QString();
  });
  connect(heatmap_, &HeatmapView::cellClicked, this, &TouchTabs::cellClicked);
  return touch;
}

QWidget* TouchTabs::buildRowWire() {
  auto* page = new QWidget;
  auto* row = new QHBoxLayout(page);
  row->setContentsMargins(4, 4, 4, 4);
  auto* side = new QVBoxLayout;
  side->addWidget(new QLabel(tr("Row-wire")));
  rowWireNumber_ = wholeBox("rowWireNumber", {.whileTyping = true}, tr("Row-wires count from 0, along y"));
  side->addWidget(rowWireNumber_);
  side->addStretch(1);
  row->addLayout(side);
  rowWire_ = chart("rowWire");
  rowShape_ = chart("rowWireShape");
  auto* charts = new QSplitter(Qt::Horizontal);
  charts->setObjectName("rowWireSplitter");
  charts->addWidget(rowWire_);
  charts->addWidget(rowShape_);
  row->addWidget(charts, 1);
  connect(rowWireNumber_, &QSpinBox::valueChanged, this, [this](int rowWire) {
    view_.rowWire = rowWire;
    emit edited(tr("Choose a row-wire"), view_);
  });
  return page;
}

QWidget* TouchTabs::buildLine() {
  auto* page = new QWidget;
  auto* row = new QHBoxLayout(page);
  row->setContentsMargins(4, 4, 4, 4);
  auto* side = new QVBoxLayout;
  constexpr std::array<const char*, 2> kNames{"lineFrom", "lineTo"};
  for (std::size_t k = 0; k < 2; ++k) {
    side->addWidget(new QLabel(k == 0 ? tr("From x, y, z [mm]") : tr("To x, y, z [mm]")));
    ends_[k] = lineEdit(kNames[k], tr("End of the line at rest; the tool Line sets both ends by clicks on the block"));
    ends_[k]->setMaximumWidth(150);
    side->addWidget(ends_[k]);
    connect(ends_[k], &QLineEdit::editingFinished, this, &TouchTabs::readLine);
  }
  side->addStretch(1);
  row->addLayout(side);
  line_ = chart("linePlot");
  row->addWidget(line_, 1);
  return page;
}

QWidget* TouchTabs::buildLoad() {
  reaction_ = chart("reactionCurve");
  forceWay_ = chart("forceDisplacement");
  auto* charts = new QSplitter(Qt::Horizontal);
  charts->setObjectName("loadSplitter");
  charts->addWidget(reaction_);
  charts->addWidget(forceWay_);
  return charts;
}

void TouchTabs::readLine() {
  ViewSettings next = view_;
  const auto from = placeOf(ends_[0]->text());
  const auto to = placeOf(ends_[1]->text());
  if (!from || !to) {
    ChartSpec refusal;
    refusal.title = tr("Enter three numbers separated by commas, for example 0, 15, 5").toStdString();
    line_->setChart(refusal);
    return;
  }
  if (std::array{*from, *to} == view_.lineIn(session_.touch().design().block_mm)) return;
  next.lineFrom_mm = *from;
  next.lineTo_mm = *to;
  if (!(next == view_)) emit edited(tr("Change the line"), next);
}

void TouchTabs::showLine() {
  setCurrentWidget(linePage_);
}

bool TouchTabs::lineShown() const {
  return currentWidget() == linePage_;
}

void TouchTabs::setTheme(Theme theme) {
  heatmap_->setTheme(theme);
  for (ChartView* view : {newton_, rowWire_, rowShape_, line_, reaction_, forceWay_}) view->setTheme(theme);
}

void TouchTabs::displayProject(const Project& project) {
  view_ = project.view;
  const QSignalBlocker quiet(rowWireNumber_);
  rowWireNumber_->setRange(0, project.design.rowWires() - 1);
  rowWireNumber_->setValue(view_.rowWire);
  const std::array places = view_.lineIn(project.design.block_mm);
  for (std::size_t k = 0; k < 2; ++k)
    if (placeOf(ends_[k]->text()) != places[k]) ends_[k]->setText(lineEndText(places[k]));
  draw();
}

void TouchTabs::displayTouch(bool meshChanged, std::shared_ptr<const ReferencePath> kept) {
  if (meshChanged) plot_.reset();
  kept_ = std::move(kept);
  draw();
}

bool TouchTabs::complete() const {
  return !heatmap_->isVisible() || workbench_.resistances() || !workbench_.field().problem().isEmpty();
}

void TouchTabs::drawHeatmap() {
  if (!heatmap_->isVisible() || session_.electrodes() == nullptr) return;
  workbench_.needResistances();
  const auto resistances = workbench_.resistances();
  if (!resistances) {
    heatmap_->setHeatmap(noResistancesYet(workbench_.field().problem()));
    return;
  }
  HeatmapSpec spec = resistanceHeatmap(*resistances, ResistanceKind::RelativeChange);
  if (const auto end = workbench_.resistancesAtEnd())
    spec.colors = resistanceHeatmap(*end, ResistanceKind::RelativeChange).colors;
  if (view_.litCell && (*view_.litCell)[0] < spec.values.rows() && (*view_.litCell)[1] < spec.values.cols())
    spec.selected = view_.litCell;
  heatmap_->setHeatmap(std::move(spec));
}

void TouchTabs::draw() {
  if (!isVisible()) return;
  drawHeatmap();
  drawNewton();
  drawRowWire();
  drawLine();
  drawLoad();
  fillTable();
}

void TouchTabs::drawNewton() {
  if (!newton_->isVisible()) return;
  std::vector<NewtonStep> steps = session_.newton();
  if (sameSteps(steps, drawnSteps_)) return;
  drawnSteps_ = std::move(steps);
  newton_->setChart(newtonChart(drawnSteps_));
}

void TouchTabs::drawRowWire() {
  if (session_.electrodes() == nullptr || !rowWire_->isVisible()) return;
  const SensorDesign& design = session_.touch().design();
  const int rowWire = std::min(view_.rowWire, design.rowWires() - 1);
  rowWire_->setChart(rowWireChart(design, *session_.electrodes(), rowWire));
  rowShape_->setChart(rowWireShapeChart(design, *session_.electrodes(), rowWire));
}

void TouchTabs::drawLine() {
  if (session_.fields() == nullptr || !line_->isVisible()) return;
  const auto less = kept_ ? std::optional(kept_->at(session_.loadFraction())) : std::nullopt;
  ViewSettings view = view_;
  const auto line = view.lineIn(session_.touch().design().block_mm);
  view.lineFrom_mm = line[0];
  view.lineTo_mm = line[1];
  line_->setChart(plot_.chart(*session_.touch().mesh(), *session_.fields(), view, less ? &less->fields : nullptr));
}

void TouchTabs::drawLoad() {
  if (session_.fields() == nullptr || !reaction_->isVisible()) return;
  reaction_->setChart(reactionChart(session_.touch()));
  forceWay_->setChart(forceDisplacementChart(session_.touch()));
}

void TouchTabs::fillTable() {
  if (session_.electrodes() == nullptr || !table_->isVisible()) return;
  table_->show(session_.touch().design(), *session_.electrodes());
}

} // namespace palp
