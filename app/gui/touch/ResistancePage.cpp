#include "app/gui/touch/ResistancePage.h"

#include "app/gui/project/Command.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapSpecs.h"
#include "app/gui/views/HeatmapView.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

/// One row or column of the matrix against its index.
ChartSpec curveChart(const HeatmapSpec& heatmap, const std::string& title, const std::string& xLabel,
                     const Eigen::VectorXd& values, int color) {
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
  spec.series = {curve};
  return spec;
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
  lower->addWidget(block_);
  lower->setSizes({420, 420, 520});
  auto* views = new QSplitter(Qt::Vertical);
  views->setObjectName("resistanceSplitter");
  views->addWidget(heatmap_);
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
    view.resistanceRange = on ? std::optional(std::array{colors.low, colors.high}) : std::nullopt;
    edit(tr("Keep the colour scale"), view);
  });
  connect(heatmap_, &HeatmapView::cellHovered, this, [this](const std::optional<std::array<int, 2>>& cell) {
    reading_->setText(cell ? heatmap_->toolTip() : tr("Point at a cell to read it; click to see its row and column."));
  });
  connect(heatmap_, &HeatmapView::cellClicked, this, [this](int rowWire, int columnWire) {
    ViewSettings view = workbench_.project().view;
    view.cell = {rowWire, columnWire};
    edit(tr("Choose a cell"), view);
  });
  connect(&workbench_, &Workbench::projectChanged, this, &ResistancePage::displayProject);
  connect(&workbench_.touch(), &TouchSession::changed, this, &ResistancePage::draw);
  displayProject();
}

void ResistancePage::edit(const QString& what, const ViewSettings& view) {
  Project next = workbench_.project();
  next.view = view;
  workbench_.edit(what, next);
}

void ResistancePage::displayProject() {
  const ViewSettings& view = workbench_.project().view;
  const QSignalBlocker quietKind(kind_);
  const QSignalBlocker quietFixed(fixed_);
  kind_->setCurrentIndex(static_cast<int>(view.resistance));
  fixed_->setChecked(view.resistanceRange.has_value());
  if (!(view == drawn_)) draw(false);
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
  kind_->addItems({tr("R [ohm]"), tr("change dR [ohm]"), tr("relative change dR/R [%]")});
  kind_->setToolTip(tr("R = g x distance of each pair of electrodes, added (Eq. 1); changes against rest"));
  fixed_ = new QCheckBox(tr("keep this colour scale"));
  fixed_->setObjectName("fixedScale");
  fixed_->setToolTip(tr("The colours keep their range when the load changes"));
  reading_ = new QLabel(tr("Point at a cell to read it; click to see its row and column."));
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
  block_->setTheme(theme);
  row_->setTheme(theme);
  column_->setTheme(theme);
  drawBlock(false);
}

bool ResistancePage::complete() const {
  return workbench_.touch().electrodes() != nullptr && workbench_.touch().upToDate();
}

void ResistancePage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  draw(!meshDrawn_);
}

void ResistancePage::draw(bool meshChanged) {
  meshDrawn_ = meshDrawn_ && !meshChanged;
  if (!isVisible() || workbench_.touch().electrodes() == nullptr) return;
  drawn_ = workbench_.project().view;
  drawHeatmap();
  drawCurves();
  drawBlock(meshChanged);
}

void ResistancePage::drawHeatmap() {
  const TouchSession& touch = workbench_.touch();
  if (touch.electrodes() == nullptr || !isVisible()) return;
  HeatmapSpec spec = resistanceHeatmap(touch.touch(), rowColumnResistances(touch.touch().design(), *touch.electrodes()),
                                       workbench_.project().view.resistance);
  spec.selected = cell();
  if (const auto& range = workbench_.project().view.resistanceRange) {
    spec.colors.low = (*range)[0];
    spec.colors.high = (*range)[1];
  }
  heatmap_->setHeatmap(std::move(spec));
}

void ResistancePage::drawCurves() {
  const HeatmapSpec& spec = heatmap_->heatmap();
  if (spec.values.size() == 0 || !isVisible()) return;
  const auto [rowWire, columnWire] = cell();
  row_->setChart(
      curveChart(spec, "Row-wire " + std::to_string(rowWire), "column-wire", spec.values.row(rowWire).transpose(), 1));
  column_->setChart(
      curveChart(spec, "Column-wire " + std::to_string(columnWire), "row-wire", spec.values.col(columnWire), 0));
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
