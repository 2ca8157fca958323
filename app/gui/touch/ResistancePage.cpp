#include "app/gui/touch/ResistancePage.h"

#include "app/gui/project/Command.h"
#include "app/gui/touch/LawBar.h"
#include "app/gui/touch/ResistanceWords.h"
#include "app/gui/touch/StaleNote.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapSpecs.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/views/ViewBar.h"
#include "app/gui/widgets/FoldingRow.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSplitter>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

ResistancePage::ResistancePage(Workbench& workbench, QWidget* parent)
    : Scene(parent), workbench_(workbench), current_(workbench.field()) {
  options_.meshEdges = false;
  options_.forceArrows = true;
  options_.opacity = 0.4; // for the lit electrodes
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(buildBar());
  heatmap_ = new HeatmapView;
  heatmap_->setObjectName("resistanceHeatmap");
  new StaleNote(*heatmap_, workbench_);
  pairs_ = new HeatmapView;
  pairs_->setObjectName("pairsHeatmap");
  pairs_->hide();
  laws_ = textLabel("lawsCompared");
  laws_->hide();
  law_ = new LawBar;
  law_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  column->addLayout(inRow({law_, {laws_, 1}, Part::stretch()}));
  row_ = new ChartView;
  row_->setObjectName("rowCurve");
  column_ = new ChartView;
  column_->setObjectName("columnCurve");
  block_ = new BlockView;
  block_->setObjectName("resistanceBlock");
  auto* lower = new QSplitter(Qt::Horizontal);
  lower->setObjectName("resistanceLower");
  lower->addWidget(row_);
  lower->addWidget(column_);
  auto* third = new QWidget;
  auto* around = new QVBoxLayout(third);
  around->setContentsMargins(0, 0, 0, 0);
  currentPaths_ = checkBox(tr("Current paths"), "currentWay");
  paths_ = textLabel("currentPaths");
  paths_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  addTo(*around, {new FoldingRow(currentPaths_, new ViewBar(*block_)), paths_, {block_, 1}});
  lower->addWidget(third);
  lower->setSizes({420, 420, 520});
  auto* views = new QSplitter(Qt::Vertical);
  views->setObjectName("resistanceSplitter");
  auto* maps = new QSplitter(Qt::Horizontal);
  maps->setObjectName("resistanceMaps");
  maps->addWidget(heatmap_);
  maps->addWidget(pairs_);
  maps->setSizes({500, 500});
  views->addWidget(maps);
  views->addWidget(lower);
  views->setSizes({440, 400});
  column->addWidget(views, 1);

  connect(kind_, &QComboBox::currentIndexChanged, this, [this](int kind) {
    ViewSettings view = workbench_.project().view;
    view.resistance = static_cast<ResistanceKind>(kind);
    view.resistanceRange.reset();
    edit(tr("Choose what the heatmap shows"), view);
  });
  connect(fixed_, &QCheckBox::toggled, this, [this](bool on) {
    ViewSettings view = workbench_.project().view;
    const ColorScale& colors = heatmap_->heatmap().colors;
    view.resistanceRange =
        on && heatmap_->heatmap().values.size() > 0 ? std::optional(std::array{colors.low, colors.high}) : std::nullopt;
    edit(tr("Fix the colour scale"), view);
  });
  for (HeatmapView* map : {heatmap_, pairs_}) {
    connect(map, &HeatmapView::cellHovered, this, [this](const std::optional<std::array<int, 2>>& cell) {
      if (workbench_.touch().electrodes() != nullptr) displayWords(cell.value_or(this->cell()));
    });
    connect(map, &HeatmapView::cellClicked, this, [this](int rowWire, int columnWire) {
      ViewSettings view = workbench_.project().view;
      view.cell = {rowWire, columnWire};
      edit(tr("Choose a cell"), view);
    });
  }
  connect(currentPaths_, &QCheckBox::toggled, this, [this](bool on) {
    ViewSettings view = workbench_.project().view;
    view.currentPaths = on;
    edit(tr("Show the current paths"), view);
  });
  connect(law_, &LawBar::edited, this, [this](const QString& what, const SensorDesign& design) {
    workbench_.edit(what, [&](Project& next) { next.design = design; });
  });
  connect(law_, &LawBar::refused, reading_, &QLabel::setText);
  for (FieldTouch* field : {&workbench_.field(), &workbench_.referenceField()})
    connect(field, &FieldTouch::changed, this, [this] { draw(false); });
  connect(&current_, &CurrentPathsJob::changed, this, [this] {
    drawBlock(false);
    if (isVisible() && workbench_.touch().electrodes() != nullptr) displayWords(cell());
  });
  connect(&workbench_, &Workbench::projectChanged, this, &ResistancePage::displayProject);
  connect(&workbench_.touch(), &TouchSession::changed, this, &ResistancePage::draw);
  connect(&workbench_.kept(), &ReferenceTouch::changed, this, [this] { draw(false); });
  displayProject();
}

void ResistancePage::edit(const QString& what, const ViewSettings& view) {
  workbench_.edit(what, [&](Project& next) { next.view = view; });
}

void ResistancePage::displayProject() {
  const ViewSettings& view = workbench_.project().view;
  law_->display(workbench_.project().design);
  const QSignalBlocker quietKind(kind_);
  const QSignalBlocker quietFixed(fixed_);
  auto* less = static_cast<QStandardItemModel*>(kind_->model())->item(static_cast<int>(ResistanceKind::LessReference));
  less->setEnabled(comparable());
  less->setText(workbench_.project().view.uniform ? tr("dR/R minus uniform load [%]")
                                                  : tr("dR/R minus reference design [%]"));
  less->setToolTip(comparable()
                       ? tr("Difference under the same load, in percent of the resistance at rest")
                       : tr("There is no reference design with as many wires: Design, Compare, \"Set as reference\""));
  kind_->setCurrentIndex(static_cast<int>(kind()));
  fixed_->setChecked(view.resistanceRange.has_value());
  const QSignalBlocker quietWay(currentPaths_);
  const bool field = workbench_.project().design.field() != nullptr;
  currentPaths_->setEnabled(field);
  currentPaths_->setChecked(field && view.currentPaths);
  currentPaths_->setToolTip(
      field ? tr("Follows the current through the block while the selected cell is read: each line carries the same "
                 "current, and colours show the current density for 1 A driven into the row-wire")
            : tr("By Eq. (1) every pair of electrodes is an independent resistor, so there is no current field in the "
                 "rubber. Select the conduction field to see current paths."));
  if (!(view == drawn_) || view.resistance == ResistanceKind::LessReference) draw(false);
}

bool ResistancePage::comparable() const {
  const Project& project = workbench_.project();
  if (project.view.uniform) return workbench_.comparable();
  return project.kept && project.kept->rowWires() == project.design.rowWires() &&
         project.kept->columnWires() == project.design.columnWires();
}

ResistanceKind ResistancePage::kind() const {
  const ResistanceKind chosen = workbench_.project().view.resistance;
  return chosen == ResistanceKind::LessReference && !comparable() ? ResistanceKind::RelativeChange : chosen;
}

std::array<int, 2> ResistancePage::cell() const {
  const SensorDesign& design = workbench_.touch().touch().design();
  const std::array<int, 2>& wanted = workbench_.project().view.cell;
  return {std::min(wanted[0], design.rowWires() - 1), std::min(wanted[1], design.columnWires() - 1)};
}

QString ResistancePage::commands(const Project& project, const QString& designFile) const {
  return solveCommands(project, designFile);
}

QWidget* ResistancePage::buildBar() {
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  kind_ = choiceBox(
      "resistanceKind",
      {tr("R [ohm]"), tr("Change dR [ohm]"), tr("Relative change dR/R [%]"), tr("dR/R minus reference design [%]")},
      tr("Resistance between a row-wire and a column-wire by the law of the design; changes are relative to rest"));
  fixed_ = checkBox(tr("Fix colour scale"), "fixedScale", tr("Keeps the range of the colours when the load changes"));
  reading_ = new QLabel;
  reading_->setToolTip(
      tr("Resistance of the cell under the pointer, otherwise of the selected cell; click on a cell to select it"));
  reading_->setObjectName("reading");
  addTo(*row, {new QLabel(tr("Show")), kind_, fixed_});
  row->addSpacing(20);
  row->addWidget(reading_, 1);
  return bar;
}

void ResistancePage::setTheme(Theme theme) {
  options_.theme = theme;
  heatmap_->setTheme(theme);
  pairs_->setTheme(theme);
  block_->setTheme(theme);
  row_->setTheme(theme);
  column_->setTheme(theme);
  drawBlock(false);
}

bool ResistancePage::complete() const {
  const bool compared =
      kind() != ResistanceKind::LessReference || workbench_.referenceResistances() || !referenceProblem().isEmpty();
  const bool resistances = resistances_ || !workbench_.field().problem().isEmpty();
  const bool followed = !wayShown() || current_.lines() != nullptr || !current_.problem().isEmpty();
  return workbench_.touch().electrodes() != nullptr && workbench_.touch().upToDate() && compared && resistances &&
         followed;
}

void ResistancePage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  workbench_.field().retry();
  workbench_.referenceField().retry();
  draw(!meshDrawn_);
}

void ResistancePage::hideEvent(QHideEvent* event) {
  Scene::hideEvent(event);
  current_.leave();
}

void ResistancePage::draw(bool meshChanged) {
  meshDrawn_ = meshDrawn_ && !meshChanged;
  if (!isVisible() || workbench_.touch().electrodes() == nullptr) return;
  drawn_ = workbench_.project().view;
  findResistances();
  if (kind() == ResistanceKind::LessReference) workbench_.needReferenceResistances();
  drawHeatmap();
  drawBeside();
  drawCurves();
  drawBlock(meshChanged);
  displayWords(cell());
}

void ResistancePage::displayWords(const std::array<int, 2>& cell) {
  const TouchSession& touch = workbench_.touch();
  const SensorDesign& design = touch.touch().design();
  if (cell[0] >= design.rowWires() || cell[1] >= design.columnWires()) return;
  reading_->setText(resistances_ ? cellWords(*resistances_, cell) : workbench_.field().problem());
  const auto found = workbench_.field().found(touch.touch(), touch.loadFraction());
  paths_->setVisible(found != nullptr && resistances_);
  if (!paths_->isHidden())
    paths_->setText(pathWords(found->network, design.field()->readout, cell) +
                    (wayShown() && !current_.problem().isEmpty() ? " " + current_.problem() : QString()));
}

bool ResistancePage::wayShown() const {
  return workbench_.project().view.currentPaths && workbench_.touch().touch().design().field() != nullptr;
}

QString ResistancePage::referenceProblem() const {
  if (!workbench_.kept().problem().isEmpty()) return workbench_.kept().problem();
  return workbench_.referencePath() != nullptr ? workbench_.referenceField().problem() : QString();
}

void ResistancePage::findResistances() {
  workbench_.needResistances();
  resistances_ = workbench_.resistances();
}

void ResistancePage::drawBeside() {
  SensorDesign design = workbench_.touch().touch().design();
  const bool beside = design.field() != nullptr && resistances_ && kind() != ResistanceKind::LessReference;
  pairs_->setVisible(beside);
  laws_->setVisible(beside);
  if (!beside) return;
  design.resistance = PairsLaw{};
  const TouchResistances pairs = *resistancesOf(design, *workbench_.touch().electrodes());
  laws_->setText(lawsWords(*resistances_, pairs));
  HeatmapSpec spec = resistanceHeatmap(pairs, kind());
  spec.title = tr("The same by Eq. (1), rate 1000 ohm/mm, with its own colour scale").toStdString();
  spec.selected = cell();
  pairs_->setHeatmap(std::move(spec));
}

HeatmapSpec ResistancePage::heatmap() const {
  if (!resistances_) return noResistancesYet(workbench_.field().problem());
  HeatmapSpec shown = resistanceHeatmap(*resistances_, kind());
  if (kind() != ResistanceKind::LessReference) {
    if (const auto end = workbench_.resistancesAtEnd(); end && shown.values.size() > 0)
      shown.colors = resistanceHeatmap(*end, kind()).colors; // one scale on the complete load path
    return shown;
  }
  HeatmapSpec none;
  none.title =
      (referenceProblem().isEmpty() ? tr("The comparison is being computed...") : referenceProblem()).toStdString();
  const auto kept = workbench_.referenceResistances();
  if (!kept) return none;
  const HeatmapSpec less = resistanceHeatmap(*kept, kind());
  const bool alike = less.values.rows() == shown.values.rows() && less.values.cols() == shown.values.cols();
  return alike ? heatmapLess(shown.values - less.values,
                             workbench_.project().view.uniform ? "uniform load" : "reference design")
               : none; // else the touch is still of the design before
}

void ResistancePage::drawHeatmap() {
  const TouchSession& touch = workbench_.touch();
  if (touch.electrodes() == nullptr || !isVisible()) return;
  HeatmapSpec spec = heatmap();
  if (spec.values.size() > 0) spec.selected = cell();
  if (const auto& range = workbench_.project().view.resistanceRange) {
    spec.colors.low = (*range)[0];
    spec.colors.high = (*range)[1];
  }
  heatmap_->setHeatmap(std::move(spec));
}

void ResistancePage::drawCurves() {
  const HeatmapSpec& spec = heatmap_->heatmap();
  if (!isVisible()) return;
  if (spec.values.size() == 0) {
    for (ChartView* curve : {row_, column_}) curve->setChart({});
    return;
  }
  const auto [rowWire, columnWire] = cell();
  row_->setChart(curveChart(spec, "Row-wire " + std::to_string(rowWire), "column-wire",
                            spec.values.row(rowWire).transpose(), 1, columnWire));
  column_->setChart(curveChart(spec, "Column-wire " + std::to_string(columnWire), "row-wire",
                               spec.values.col(columnWire), 0, rowWire));
}

void ResistancePage::drawBlock(bool meshChanged) {
  const TouchSession& touch = workbench_.touch();
  if (touch.touch().mesh() == nullptr || !isVisible()) return;
  options_.litCell = cell();
  options_.scale = devicePixelRatioF();
  DeformationState state{&touch.touch().design(), touch.touch().mesh(), touch.fields(),   touch.electrodes(),
                         &touch.touch().load(),   touch.loadFraction(), touch.indenters()};
  const CurrentLines none;
  DeformationOptions options = options_;
  if (wayShown()) {
    options.forceArrows = options.areaOutlines = false; // before the lines
    if (touch.upToDate()) current_.want(touch.touch(), touch.loadFraction(), cell());
    state.current = current_.lines() != nullptr ? current_.lines() : &none;
  } else {
    current_.leave();
  }
  block_->show(state, options, meshChanged || !meshDrawn_);
  meshDrawn_ = true;
}

} // namespace palp
