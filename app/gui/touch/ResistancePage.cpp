#include "app/gui/touch/ResistancePage.h"

#include "app/gui/project/Command.h"
#include "app/gui/touch/LawBar.h"
#include "app/gui/touch/StaleNote.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapSpecs.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/views/ViewBar.h"

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

namespace {

constexpr int kMarkColor = 3;

QString signedText(double value) {
  return (value > 0 ? "+" : "") + QString::number(value, 'g', 4);
}

/// One row or column of the matrix against its index, and one of its cells.
ChartSpec curveChart(const HeatmapSpec& heatmap, const std::string& title, const std::string& xLabel,
                     const Eigen::VectorXd& values, int color, int cell) {
  ChartSpec spec;
  spec.title = title;
  spec.xLabel = xLabel;
  spec.yLabel = heatmap.colors.title();
  ChartSeries curve;
  curve.style = ChartSeries::Style::LineAndPoints;
  curve.color = color;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    curve.x.push_back(static_cast<double>(k));
    curve.y.push_back(values[k]);
  }
  ChartSeries mark;
  mark.style = ChartSeries::Style::Points;
  mark.color = kMarkColor;
  mark.x = {static_cast<double>(cell)};
  mark.y = {values[cell]};
  spec.series = {curve, mark};
  return spec;
}

/// d ln R of all readings.
Eigen::VectorXd logChanges(const TouchResistances& resistances) {
  return (resistances.now_ohm.array() / resistances.rest_ohm.array()).log().matrix().reshaped();
}

/// How the changes by the field compare with those by Eq. (1), over all readings.
QString lawsWords(const TouchResistances& field, const TouchResistances& pairs) {
  const Eigen::VectorXd a = logChanges(field), b = logChanges(pairs);
  if (!(a.norm() > 0 && b.norm() > 0)) return QObject::tr("Nothing changes.");
  return QObject::tr("Against Eq. (1), over all readings: changes of ln R are %1 times as large, correlation %2. The "
                     "rubber conducts alike in all directions, also where it is deformed.")
      .arg(QString::number(a.norm() / b.norm(), 'g', 3), QString::number(a.dot(b) / (a.norm() * b.norm()), 'f', 2));
}

} // namespace

ResistancePage::ResistancePage(Workbench& workbench, QWidget* parent) : Scene(parent), workbench_(workbench) {
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
  laws_ = new QLabel;
  laws_->setObjectName("lawsCompared");
  laws_->setWordWrap(true);
  laws_->hide();
  law_ = new LawBar;
  law_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  auto* laws = new QHBoxLayout;
  laws->addWidget(law_);
  laws->addWidget(laws_, 1);
  laws->addStretch();
  column->addLayout(laws);
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
  auto* looks = new QHBoxLayout;
  looks->addStretch(1);
  looks->addWidget(new ViewBar(*block_));
  around->addLayout(looks);
  around->addWidget(block_, 1);
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
    edit(tr("Keep the colour scale"), view);
  });
  for (HeatmapView* map : {heatmap_, pairs_}) {
    connect(map, &HeatmapView::cellHovered, this, [this](const std::optional<std::array<int, 2>>& cell) {
      if (workbench_.touch().electrodes() != nullptr) reading_->setText(cellWords(cell.value_or(this->cell())));
    });
    connect(map, &HeatmapView::cellClicked, this, [this](int rowWire, int columnWire) {
      ViewSettings view = workbench_.project().view;
      view.cell = {rowWire, columnWire};
      edit(tr("Choose a cell"), view);
    });
  }
  connect(law_, &LawBar::edited, this, [this](const QString& what, const SensorDesign& design) {
    Project next = workbench_.project();
    next.design = design;
    workbench_.edit(what, next);
  });
  connect(law_, &LawBar::refused, reading_, &QLabel::setText);
  connect(&field_, &FieldTouch::changed, this, [this] {
    if (!isVisible()) field_.rest();
    draw(false);
  });
  connect(&workbench_, &Workbench::projectChanged, this, &ResistancePage::displayProject);
  connect(&workbench_.touch(), &TouchSession::changed, this, &ResistancePage::draw);
  connect(&workbench_.kept(), &KeptTouch::changed, this, [this] { draw(false); });
  displayProject();
}

void ResistancePage::edit(const QString& what, const ViewSettings& view) {
  Project next = workbench_.project();
  next.view = view;
  workbench_.edit(what, next);
}

void ResistancePage::displayProject() {
  const ViewSettings& view = workbench_.project().view;
  law_->display(workbench_.project().design);
  const QSignalBlocker quietKind(kind_);
  const QSignalBlocker quietFixed(fixed_);
  auto* less = static_cast<QStandardItemModel*>(kind_->model())->item(static_cast<int>(ResistanceKind::LessKept));
  less->setEnabled(comparable());
  less->setToolTip(comparable() ? tr("Under the same load, in percent of the resistance at rest")
                                : tr("Nothing with as many wires is kept: Design, Compare, \"Keep this design\""));
  kind_->setCurrentIndex(static_cast<int>(kind()));
  fixed_->setChecked(view.resistanceRange.has_value());
  if (!(view == drawn_) || view.resistance == ResistanceKind::LessKept) draw(false);
}

bool ResistancePage::comparable() const {
  const Project& project = workbench_.project();
  return project.kept && project.kept->rowWires() == project.design.rowWires() &&
         project.kept->columnWires() == project.design.columnWires();
}

ResistanceKind ResistancePage::kind() const {
  const ResistanceKind chosen = workbench_.project().view.resistance;
  return chosen == ResistanceKind::LessKept && !comparable() ? ResistanceKind::RelativeChange : chosen;
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
  kind_ = new QComboBox;
  kind_->setObjectName("resistanceKind");
  kind_->addItems(
      {tr("R [ohm]"), tr("change dR [ohm]"), tr("relative change dR/R [%]"), tr("dR/R less the kept design's [%]")});
  kind_->setToolTip(tr("R of a row-wire and a column-wire by the law of the design; changes against rest"));
  fixed_ = new QCheckBox(tr("keep this colour scale"));
  fixed_->setObjectName("fixedScale");
  fixed_->setToolTip(tr("The colours keep their range when the load changes"));
  reading_ = new QLabel;
  reading_->setToolTip(tr("Of the cell under the pointer, else of the chosen one; click on a cell to choose it"));
  reading_->setObjectName("reading");
  row->addWidget(new QLabel(tr("Show")));
  row->addWidget(kind_);
  row->addWidget(fixed_);
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
      kind() != ResistanceKind::LessKept || workbench_.keptPath() || !workbench_.kept().problem().isEmpty();
  const bool resistances = resistances_ || !field_.problem().isEmpty();
  return workbench_.touch().electrodes() != nullptr && workbench_.touch().upToDate() && compared && resistances;
}

void ResistancePage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  field_.retry();
  draw(!meshDrawn_);
}

void ResistancePage::hideEvent(QHideEvent* event) {
  Scene::hideEvent(event);
  field_.rest();
}

void ResistancePage::draw(bool meshChanged) {
  meshDrawn_ = meshDrawn_ && !meshChanged;
  if (!isVisible() || workbench_.touch().electrodes() == nullptr) return;
  drawn_ = workbench_.project().view;
  findResistances();
  if (kind() == ResistanceKind::LessKept) workbench_.needKept();
  drawHeatmap();
  drawBeside();
  drawCurves();
  drawBlock(meshChanged);
  reading_->setText(cellWords(cell()));
}

void ResistancePage::findResistances() {
  const TouchSession& touch = workbench_.touch();
  if (touch.touch().design().field() == nullptr) {
    resistances_ = resistancesOf(touch.touch().design(), *touch.electrodes());
    field_.forget();
    return;
  }
  if (touch.upToDate()) field_.want(touch.touch(), touch.loadFraction());
  resistances_ = field_.of(touch.touch(), touch.loadFraction());
}

void ResistancePage::drawBeside() {
  SensorDesign design = workbench_.touch().touch().design();
  const bool beside = design.field() != nullptr && resistances_ && kind() != ResistanceKind::LessKept;
  pairs_->setVisible(beside);
  laws_->setVisible(beside);
  if (!beside) return;
  design.resistance = PairsLaw{};
  const TouchResistances pairs = *resistancesOf(design, *workbench_.touch().electrodes());
  laws_->setText(lawsWords(*resistances_, pairs));
  HeatmapSpec spec = resistanceHeatmap(pairs, kind());
  spec.title = tr("The same by Eq. (1), rate 1000 ohm/mm").toStdString();
  spec.selected = cell();
  pairs_->setHeatmap(std::move(spec));
}

QString ResistancePage::cellWords(const std::array<int, 2>& cell) const {
  const SensorDesign& design = workbench_.touch().touch().design();
  const auto [row, column] = cell;
  if (row >= design.rowWires() || column >= design.columnWires()) return {};
  if (!resistances_) return field_.problem();
  const double rest = resistances_->rest_ohm(row, column), now = resistances_->now_ohm(row, column);
  return tr("Row-wire %1, column-wire %2: R = %3 ohm at rest, %4 ohm under the load (%5 ohm, %6 %)")
      .arg(row)
      .arg(column)
      .arg(QString::number(rest, 'g', 6), QString::number(now, 'g', 6), signedText(now - rest),
           signedText(100 * (now - rest) / rest));
}

HeatmapSpec ResistancePage::heatmap() const {
  const TouchSession& touch = workbench_.touch();
  HeatmapSpec none;
  if (!resistances_) {
    none.title = field_.problem().isEmpty() ? tr("The conduction field is being computed...").toStdString()
                                            : field_.problem().toStdString();
    return none;
  }
  HeatmapSpec shown = resistanceHeatmap(*resistances_, kind());
  if (kind() != ResistanceKind::LessKept) {
    const SensorDesign& design = touch.touch().design();
    const auto* end = touch.touch().displacements();
    if (design.field() == nullptr && end != nullptr && shown.values.size() > 0)
      shown.colors = resistanceHeatmap(design, *end, kind()).colors; // one scale on the whole load path
    return shown;
  }
  const auto kept = workbench_.keptPath();
  const QString& problem = workbench_.kept().problem();
  none.title = (problem.isEmpty() ? tr("The kept design is being computed...") : problem).toStdString();
  if (!kept) return none;
  if (kept->design.field() != nullptr) {
    none.title = tr("Not under the conduction field: changes less those of a kept design under it.").toStdString();
    return none;
  }
  const HeatmapSpec less = resistanceHeatmap(kept->design, kept->at(touch.loadFraction()).electrodes, kind());
  const bool alike = less.values.rows() == shown.values.rows() && less.values.cols() == shown.values.cols();
  return alike ? heatmapLess(shown.values - less.values, "the kept design's")
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
  const DeformationState state{&touch.touch().design(), touch.touch().mesh(),  touch.fields(),
                               touch.electrodes(),      &touch.touch().load(), touch.loadFraction()};
  block_->show(state, options_, meshChanged || !meshDrawn_);
  meshDrawn_ = true;
}

} // namespace palp
