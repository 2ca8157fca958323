#include "app/gui/design/DesignPage.h"

#include "app/gui/design/DesignComparison.h"
#include "app/gui/design/DesignPanel.h"
#include "app/gui/design/DesignSweep.h"
#include "app/gui/design/LayoutFinder.h"
#include "app/gui/design/NoiseFloor.h"
#include "app/gui/design/map/DesignMap.h"
#include "app/gui/project/Command.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/ViewBar.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/window/SidePanel.h"
#include "app/scenes/block/map/FaceMap.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTabWidget>
#include <QVBoxLayout>

#include <numeric>
#include <utility>

namespace palp {

namespace {

constexpr int kPanelWidth_px = 340;

/// The block as one element, to draw a design without meshing it.
Mesh blockAlone(const SensorDesign& design) {
  Mesh mesh;
  mesh.shape = ElementShape::Hexahedron8;
  mesh.nodes_mm.resize(3, 8);
  mesh.nodes_mm << 0, 1, 1, 0, 0, 1, 1, 0, // x
      0, 0, 1, 1, 0, 0, 1, 1,              // y
      0, 0, 0, 0, 1, 1, 1, 1;              // z
  mesh.nodes_mm = design.block_mm.asDiagonal() * mesh.nodes_mm;
  mesh.elements.resize(8, 1);
  std::iota(mesh.elements.data(), mesh.elements.data() + 8, 0);
  mesh.topFaces.resize(4, 1);
  mesh.topFaces << 4, 5, 6, 7;
  mesh.topFaceAreas = Eigen::VectorXi::Zero(1);
  return mesh;
}

ChartSpec qualityChart(const MeshQuality& quality) {
  ChartSpec spec;
  spec.title = "Shape of the elements";
  spec.xLabel = "smallest dihedral angle [degrees]";
  spec.yLabel = "elements";
  ChartSeries bars;
  // The outline of a histogram of 10 degrees a bin.
  for (std::size_t bin = 0; bin < quality.minDihedralHistogram.size() && bin < 10; ++bin)
    for (const double edge : {0.0, 10.0}) {
      bars.x.push_back(10.0 * static_cast<double>(bin) + edge);
      bars.y.push_back(quality.minDihedralHistogram[bin]);
    }
  spec.series = {bars};
  return spec;
}

/// As wide and high as its place, and scrolled where that is too little.
QScrollArea* scrolled(QWidget* content) {
  auto* area = new QScrollArea;
  area->setWidget(content);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  return area;
}

} // namespace

DesignPage::DesignPage(Workbench& workbench, NetworkSession& network, QWidget* parent)
    : Scene(parent), workbench_(workbench), network_(network) {
  options_.forceArrows = false;
  options_.meshEdges = false;
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 8, 8, 8);
  row->addWidget(buildSide());
  row->addWidget(buildViews(), 1);
  connect(panel_, &DesignPanel::edited, this, [this](const QString& what, const SensorDesign& design) {
    workbench_.edit(what, [&](Project& next) { setDesign(next, design); });
  });
  connect(panel_, &DesignPanel::scalingChosen, this, [this](bool on) {
    workbench_.edit(tr("Scale the wires with the block"), [&](Project& next) { next.studies.scaleWires = on; });
  });
  connect(showMesh_, &QCheckBox::toggled, this, [this](bool on) {
    workbench_.edit(tr("Show the mesh"), [&](Project& next) { next.view.mesh = on; });
    emit stageChanged();
  });
  connect(automaticSize_, &QCheckBox::toggled, this, &DesignPage::editMesh);
  connect(size_, &QDoubleSpinBox::valueChanged, this, &DesignPage::editMesh);
  connect(&workbench_, &Workbench::projectChanged, this, &DesignPage::displayProject);
  connect(&workbench_.touch(), &TouchSession::changed, this, [this](bool meshChanged) {
    if (!meshChanged) return;
    ++mesh_;
    measured_.reset();
    measureRequested_ = false;
    draw();
    displayMesh();
  });
  connect(comparison_, &DesignComparison::fieldsRequested, this, [this] { emit sceneRequested("deformation"); });
  connect(map_, &DesignMap::overBlockChanged, this, &DesignPage::draw);
  // What was cancelled is requested again when the page is next updated.
  connect(&measuring_, &JobRunner::finished, this, [this](bool cancelled) { measureRequested_ &= !cancelled; });
  displayProject();
}

QWidget* DesignPage::buildSide() {
  panel_ = new DesignPanel;
  panel_->setObjectName("designPanel");
  return sidePanel(panel_, kPanelWidth_px);
}

QWidget* DesignPage::buildViews() {
  block_ = new BlockView;
  block_->setObjectName("designBlock");
  quality_ = new ChartView;
  quality_->setObjectName("quality");
  auto* views = new QSplitter(Qt::Vertical);
  views->setObjectName("designSplitter");
  auto* upper = new QWidget;
  auto* column = new QVBoxLayout(upper);
  column->setContentsMargins(0, 0, 0, 0);
  column->addLayout(inRow({Part::stretch(), new ViewBar(*block_)}));
  column->addWidget(block_, 1);
  views->addWidget(upper);
  views->addWidget(buildStudies());
  views->setSizes({560, 280});
  return views;
}

QWidget* DesignPage::buildStudies() {
  auto* first = new QWidget;
  auto* row = new QHBoxLayout(first);
  row->setContentsMargins(4, 4, 4, 4);
  row->addWidget(buildMesh(), 2);
  row->addWidget(quality_, 3);
  floor_ = new NoiseFloor(workbench_, network_);
  row->addWidget(floor_, 3);
  finder_ = new LayoutFinder(workbench_);
  sweep_ = new DesignSweep(workbench_);
  comparison_ = new DesignComparison(workbench_);
  map_ = new DesignMap(workbench_);
  auto* tabs = new QTabWidget;
  tabs->setObjectName("designTabs");
  tabs->addTab(first, tr("Mesh and noise floor"));
  tabs->addTab(scrolled(finder_), tr("Better layout"));
  tabs->addTab(scrolled(sweep_), tr("Sweep"));
  tabs->addTab(scrolled(comparison_), tr("Compare"));
  tabs->addTab(scrolled(map_), tr("Resolution map"));
  return tabs;
}

std::vector<JobRunner*> DesignPage::runners() {
  return {&measuring_,       &floor_->runner(),      &finder_->runner(),
          &sweep_->runner(), &comparison_->runner(), &map_->runner()};
}

QGroupBox* DesignPage::buildMesh() {
  auto* box = new QGroupBox(tr("Mesh"));
  auto* column = new QVBoxLayout(box);
  showMesh_ = checkBox(tr("Make and show the mesh"), "showMesh");
  column->addWidget(showMesh_);
  auto* sizeRow = new QHBoxLayout;
  automaticSize_ = checkBox(tr("Standard size"), "automaticSize",
                            tr("Graded mesh for an error of about 1 % in the electrode displacements"));
  size_ = numberBox("meshSize", {.low = 0.5, .high = 100, .unit = tr(" mm")},
                    tr("Size of the tetrahedra in the bulk; the graded region scales with it"));
  size_->setValue(3);
  sizeRow->addWidget(automaticSize_);
  sizeRow->addWidget(size_);
  column->addLayout(sizeRow);
  meshWords_ = textLabel("meshWords");
  meshWords_->setMinimumHeight(2 * meshWords_->fontMetrics().lineSpacing()); // also where the window is low
  column->addWidget(meshWords_);
  column->addStretch(1);
  return box;
}

Stage DesignPage::stage() const {
  return showMesh_->isChecked() ? Stage::Mesh : Stage::Design;
}

bool DesignPage::complete() const {
  return !showMesh_->isChecked() || workbench_.touch().upToDate();
}

QString DesignPage::commands(const Project& project, const QString& designFile) const {
  return meshCommands(project, designFile);
}

void DesignPage::setTheme(Theme theme) {
  options_.theme = theme;
  quality_->setTheme(theme);
  sweep_->setTheme(theme);
  comparison_->setTheme(theme);
  map_->setTheme(theme);
  block_->setTheme(theme);
  draw();
}

void DesignPage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  draw();
  displayMesh();
}

void DesignPage::displayProject() {
  const Project& project = workbench_.project();
  panel_->display(project.design);
  panel_->displayScaling(project.studies.scaleWires);
  finder_->displayProject();
  comparison_->displayProject();
  map_->displayProject();
  const QSignalBlocker quietCheck(automaticSize_);
  const bool automatic = !project.mesh.meshSize_mm && !project.mesh.mapped;
  automaticSize_->setChecked(automatic);
  size_->setEnabled(project.mesh.meshSize_mm.has_value());
  if (project.mesh.meshSize_mm) showExactly(*size_, *project.mesh.meshSize_mm);
  const QSignalBlocker quietMesh(showMesh_);
  const bool otherStage = showMesh_->isChecked() != project.view.mesh;
  showMesh_->setChecked(project.view.mesh);
  if (otherStage && isVisible()) emit stageChanged();
  draw();
  displayMesh();
  floor_->display();
}

void DesignPage::draw() {
  if (!isVisible()) return;
  const TouchSession& touch = workbench_.touch();
  const SensorDesign& design = workbench_.project().design;
  const bool meshed = showMesh_->isChecked() && touch.touch().mesh() != nullptr && touch.touch().design() == design;
  const Mesh alone = meshed ? Mesh{} : blockAlone(design);
  options_.meshEdges = meshed;
  options_.scale = devicePixelRatioF();
  DeformationState state;
  state.design = &design;
  state.mesh = meshed ? touch.touch().mesh() : &alone;
  const auto map = map_->overBlock();
  state.map = map.get();
  block_->show(state, options_, true);
}

void DesignPage::displayMesh() {
  if (!isVisible()) return;
  const TouchSession& touch = workbench_.touch();
  const bool meshed = showMesh_->isChecked() && touch.touch().mesh() != nullptr;
  quality_->setVisible(meshed && measured_);
  if (!meshed) {
    meshWords_->setText(tr("No mesh yet."));
    return;
  }
  const Mesh& mesh = *touch.touch().mesh();
  QString words = tr("%1 nodes, %2 elements").arg(mesh.nodeCount()).arg(mesh.elementCount());
  if (const auto& mapped = touch.touch().meshOptions().mapped)
    words += tr(" (mapped, %1 x %2 x %3)").arg((*mapped)[0]).arg((*mapped)[1]).arg((*mapped)[2]);
  if (!measured_) {
    meshWords_->setText(words + ".");
    measureMesh();
    return;
  }
  words += tr("; dihedral angles %1 to %2 degrees.")
               .arg(measured_->minDihedral_deg, 0, 'f', 1)
               .arg(measured_->maxDihedral_deg, 0, 'f', 1);
  if (meshWords_->text() == words) return;
  meshWords_->setText(words);
  quality_->setChart(qualityChart(*measured_));
}

void DesignPage::measureMesh() {
  if (std::exchange(measureRequested_, true)) return;
  measuring_.start(tr("Measuring the mesh"),
                   [this, number = mesh_, touch = workbench_.touch().touch()](const std::stop_token&,
                                                                              JobProgress&) -> JobRunner::Taking {
                     const MeshQuality quality = meshQuality(*touch.mesh());
                     return [this, number, quality] {
                       if (number != mesh_) return;
                       measured_ = quality;
                       displayMesh();
                     };
                   });
}

void DesignPage::editMesh() {
  Project next = workbench_.project();
  next.mesh.mapped.reset();
  next.mesh.meshSize_mm.reset();
  if (!automaticSize_->isChecked()) next.mesh.meshSize_mm = size_->value();
  workbench_.edit(tr("Change the mesh size"), next);
}

} // namespace palp
