#include "app/gui/design/DesignPage.h"

#include "app/gui/design/DesignPanel.h"
#include "app/gui/project/Command.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/window/SidePanel.h"
#include "app/study/decoding/NoiseBound.h"
#include "solver/MeshQuality.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>

#include <cmath>
#include <numeric>

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

QString percents(const Eigen::VectorXd& values) {
  QStringList texts;
  for (const double value : values) texts << (std::isfinite(value) ? QString::number(value, 'f', 1) : QString("-"));
  return texts.join(" / ") + " %";
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
    Project next = workbench_.project();
    next.design = design;
    std::erase_if(next.load.areas, [&](const AreaLoad& load) { return load.area >= design.areas.count(); });
    if (whyInvalid(next.load, design)) next.load.patches.clear();
    workbench_.edit(what, next);
  });
  connect(showMesh_, &QCheckBox::toggled, this, [this](bool on) {
    Project next = workbench_.project();
    next.view.mesh = on;
    workbench_.edit(tr("Show the mesh"), next);
    emit stageChanged();
  });
  connect(automaticSize_, &QCheckBox::toggled, this, &DesignPage::editMesh);
  connect(size_, &QDoubleSpinBox::valueChanged, this, &DesignPage::editMesh);
  connect(noise_, &QDoubleSpinBox::valueChanged, this, [this](double percent) {
    Project next = workbench_.project();
    next.view.resistanceNoise = percent / 100;
    workbench_.edit(tr("Change the noise of the resistances"), next);
  });
  connect(floorSamples_, &QPushButton::clicked, this,
          [this] { network_.generate(workbench_.project().samples, workbench_.project().mesh); });
  connect(&workbench_, &Workbench::projectChanged, this, &DesignPage::displayProject);
  connect(&workbench_.touch(), &TouchSession::changed, this, [this](bool meshChanged) {
    if (!meshChanged) return;
    draw();
    displayMesh();
  });
  connect(&network_, &NetworkSession::samplesChanged, this, &DesignPage::displayNoiseFloor);
  displayProject();
}

QWidget* DesignPage::buildSide() {
  panel_ = new DesignPanel;
  return sidePanel(panel_, kPanelWidth_px);
}

QWidget* DesignPage::buildViews() {
  block_ = new BlockView;
  block_->setObjectName("designBlock");
  quality_ = new ChartView;
  quality_->setObjectName("quality");
  auto* lower = new QWidget;
  auto* row = new QHBoxLayout(lower);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(buildMesh(), 1);
  row->addWidget(quality_, 2);
  row->addWidget(buildNoiseFloor(), 1);
  auto* views = new QSplitter(Qt::Vertical);
  views->setObjectName("designSplitter");
  views->addWidget(block_);
  views->addWidget(lower);
  views->setSizes({620, 220});
  return views;
}

QGroupBox* DesignPage::buildMesh() {
  auto* box = new QGroupBox(tr("Mesh"));
  auto* column = new QVBoxLayout(box);
  showMesh_ = new QCheckBox(tr("make and show the mesh"));
  showMesh_->setObjectName("showMesh");
  column->addWidget(showMesh_);
  auto* sizeRow = new QHBoxLayout;
  automaticSize_ = new QCheckBox(tr("standard size"));
  automaticSize_->setObjectName("automaticSize");
  automaticSize_->setToolTip(tr("Graded for about 1 % in the electrode displacements"));
  size_ = new QDoubleSpinBox;
  size_->setObjectName("meshSize");
  size_->setRange(0.5, 100);
  size_->setValue(3);
  size_->setSuffix(tr(" mm"));
  size_->setKeyboardTracking(false);
  size_->setToolTip(tr("Size of the tetrahedra in the bulk; the grading scales with it"));
  sizeRow->addWidget(automaticSize_);
  sizeRow->addWidget(size_);
  column->addLayout(sizeRow);
  meshWords_ = new QLabel;
  meshWords_->setObjectName("meshWords");
  meshWords_->setWordWrap(true);
  column->addWidget(meshWords_);
  column->addStretch(1);
  return box;
}

QGroupBox* DesignPage::buildNoiseFloor() {
  auto* box = new QGroupBox(tr("Noise floor of the design"));
  auto* column = new QVBoxLayout(box);
  noise_ = new QDoubleSpinBox;
  noise_->setObjectName("resistanceNoise");
  noise_->setRange(0.00001, 10);
  noise_->setDecimals(5);
  noise_->setPrefix(tr("noise of R: "));
  noise_->setSuffix(tr(" %"));
  noise_->setKeyboardTracking(false);
  noise_->setToolTip(tr("Relative noise of each reading; a good board has 0.0005 %, a plain one 0.01 %"));
  column->addWidget(noise_);
  floorWords_ = new QLabel;
  floorWords_->setObjectName("noiseFloor");
  floorWords_->setWordWrap(true);
  column->addWidget(floorWords_);
  floorSamples_ = new QPushButton(tr("Generate samples"));
  floorSamples_->setObjectName("floorSamples");
  floorSamples_->setToolTip(tr("As on the Network scene; the bound follows from how the resistances change with the "
                               "force"));
  column->addWidget(floorSamples_);
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
  block_->setTheme(theme);
  draw();
}

void DesignPage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  draw();
  displayMesh();
  displayNoiseFloor();
}

void DesignPage::displayProject() {
  const Project& project = workbench_.project();
  panel_->display(project.design);
  const QSignalBlocker quietCheck(automaticSize_);
  const QSignalBlocker quietSize(size_);
  const bool automatic = !project.mesh.meshSize_mm;
  automaticSize_->setChecked(automatic);
  size_->setEnabled(!automatic);
  if (!automatic) size_->setValue(*project.mesh.meshSize_mm);
  const QSignalBlocker quietMesh(showMesh_);
  const QSignalBlocker quietNoise(noise_);
  const bool otherStage = showMesh_->isChecked() != project.view.mesh;
  showMesh_->setChecked(project.view.mesh);
  noise_->setValue(100 * project.view.resistanceNoise);
  if (otherStage && isVisible()) emit stageChanged();
  draw();
  displayMesh();
  displayNoiseFloor();
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
  block_->show(state, options_, true);
}

void DesignPage::displayMesh() {
  const TouchSession& touch = workbench_.touch();
  const bool meshed = showMesh_->isChecked() && touch.touch().mesh() != nullptr;
  quality_->setVisible(meshed);
  if (!meshed) {
    meshWords_->setText(tr("Looking at the design makes no mesh."));
    return;
  }
  const Mesh& mesh = *touch.touch().mesh();
  const MeshQuality quality = meshQuality(mesh);
  meshWords_->setText(tr("%1 nodes, %2 elements; dihedral angles %3 to %4 degrees.")
                          .arg(mesh.nodeCount())
                          .arg(mesh.elementCount())
                          .arg(quality.minDihedral_deg, 0, 'f', 1)
                          .arg(quality.maxDihedral_deg, 0, 'f', 1));
  quality_->setChart(qualityChart(quality));
}

void DesignPage::displayNoiseFloor() {
  if (!isVisible()) return;
  const NetworkSamples* samples = network_.samples();
  floorSamples_->setVisible(samples == nullptr);
  if (samples == nullptr) {
    floorWords_->setText(tr("Known once there are samples of this design."));
    return;
  }
  const double noise = workbench_.project().view.resistanceNoise;
  std::vector<int> all(static_cast<std::size_t>(samples->training.rowWires));
  std::iota(all.begin(), all.end(), 0);
  const int centre = std::min(4, samples->training.rowWires - 1);
  const NoiseBound one = noiseBound(samples->training, InputKind::Resistance, {centre}, noise);
  const NoiseBound every = noiseBound(samples->training, InputKind::Resistance, all, noise);
  floorWords_->setText(
      tr("Cramer-Rao bound of Fx / Fy / Fz, area known, with prior (forces uniform over their range), in % of range:"
         "<br>row-wire %1 alone: <b>%2</b><br>all row-wires: <b>%3</b><br>without prior: %4 and %5"
         "<br><i>Knowing nothing at all is 28.9 %. Real rubber adds hysteresis, creep and temperature.</i>")
          .arg(centre)
          .arg(percents(one.withPriorPercent), percents(every.withPriorPercent), percents(one.withoutPriorPercent),
               percents(every.withoutPriorPercent)));
}

void DesignPage::editMesh() {
  Project next = workbench_.project();
  next.mesh.mapped.reset();
  next.mesh.meshSize_mm.reset();
  if (!automaticSize_->isChecked()) next.mesh.meshSize_mm = size_->value();
  workbench_.edit(tr("Change the mesh size"), next);
}

} // namespace palp
