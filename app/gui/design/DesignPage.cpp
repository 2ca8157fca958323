#include "app/gui/design/DesignPage.h"

#include "app/gui/design/DesignComparison.h"
#include "app/gui/design/DesignPanel.h"
#include "app/gui/design/DesignSweep.h"
#include "app/gui/design/LayoutFinder.h"
#include "app/gui/project/Command.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/ViewBar.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/window/SidePanel.h"
#include "app/study/decoding/NoiseBound.h"
#include "model/base/Cancelled.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTabWidget>
#include <QVBoxLayout>

#include <cmath>
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

QString percents(const Eigen::VectorXd& values) {
  QStringList texts;
  for (const double value : values) texts << (std::isfinite(value) ? QString::number(value, 'f', 1) : QString("-"));
  return texts.join(" / ") + " %";
}

QString boundWords(int row, const NoiseBound& one, const NoiseBound& every) {
  return QObject::tr(
             "Cramer-Rao bound of Fx / Fy / Fz, area known, with prior (forces uniform over their range), in % of "
             "range:<br>row-wire %1 alone: <b>%2</b><br>all row-wires: <b>%3</b><br>without prior: %4 and %5"
             "<br><i>Knowing nothing at all is 28.9 %. Real rubber adds hysteresis, creep and temperature.</i>")
      .arg(row)
      .arg(percents(one.withPriorPercent), percents(every.withPriorPercent), percents(one.withoutPriorPercent),
           percents(every.withoutPriorPercent));
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
    std::erase_if(next.load.patches, [&](const PatchLoad& disc) { return whyInvalid({{}, {disc}}, design); });
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
    ++mesh_;
    measured_.reset();
    measureAsked_ = false;
    draw();
    displayMesh();
  });
  connect(comparison_, &DesignComparison::fieldsAsked, this, [this] { emit sceneAsked("deformation"); });
  connect(&network_, &NetworkSession::samplesChanged, this, [this] {
    boundedFor_.reset();
    displayNoiseFloor();
  });
  // What was cancelled is asked for again when the page is next brought up to date.
  connect(&measuring_, &JobRunner::finished, this, [this](bool cancelled) { measureAsked_ &= !cancelled; });
  connect(&bounding_, &JobRunner::finished, this, [this](bool cancelled) {
    if (cancelled) boundedFor_.reset();
  });
  connect(&bounding_, &JobRunner::failed, floorWords_, &QLabel::setText);
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
  auto* bar = new QHBoxLayout;
  bar->addStretch(1);
  bar->addWidget(new ViewBar(*block_));
  column->addLayout(bar);
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
  row->addWidget(buildMesh(), 1);
  row->addWidget(quality_, 2);
  row->addWidget(buildNoiseFloor(), 1);
  finder_ = new LayoutFinder(workbench_);
  sweep_ = new DesignSweep(workbench_);
  comparison_ = new DesignComparison(workbench_);
  auto* tabs = new QTabWidget;
  tabs->setObjectName("designTabs");
  tabs->addTab(first, tr("Mesh and noise floor"));
  tabs->addTab(scrolled(finder_), tr("Better layout"));
  tabs->addTab(scrolled(sweep_), tr("Sweep"));
  tabs->addTab(scrolled(comparison_), tr("Compare"));
  return tabs;
}

std::vector<JobRunner*> DesignPage::runners() {
  return {&measuring_, &bounding_, &finder_->runner(), &sweep_->runner(), &comparison_->runner()};
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
  meshWords_->setMinimumHeight(2 * meshWords_->fontMetrics().lineSpacing()); // also where the window is low
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
  floorWords_->setMinimumHeight(2 * floorWords_->fontMetrics().lineSpacing());
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
  sweep_->setTheme(theme);
  comparison_->setTheme(theme);
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
  finder_->displayProject();
  comparison_->displayProject();
  const QSignalBlocker quietCheck(automaticSize_);
  const bool automatic = !project.mesh.meshSize_mm && !project.mesh.mapped;
  automaticSize_->setChecked(automatic);
  size_->setEnabled(project.mesh.meshSize_mm.has_value());
  if (project.mesh.meshSize_mm) showExactly(*size_, *project.mesh.meshSize_mm);
  const QSignalBlocker quietMesh(showMesh_);
  const bool otherStage = showMesh_->isChecked() != project.view.mesh;
  showMesh_->setChecked(project.view.mesh);
  showExactly(*noise_, 100 * project.view.resistanceNoise);
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
  if (!isVisible()) return;
  const TouchSession& touch = workbench_.touch();
  const bool meshed = showMesh_->isChecked() && touch.touch().mesh() != nullptr;
  quality_->setVisible(meshed && measured_);
  if (!meshed) {
    meshWords_->setText(tr("Looking at the design makes no mesh."));
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
  if (std::exchange(measureAsked_, true)) return;
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

void DesignPage::displayNoiseFloor() {
  if (!isVisible()) return;
  const bool known = network_.upToDate();
  floorSamples_->setVisible(!known);
  if (!known) {
    floorWords_->setText(tr("Known once there are samples of this design."));
    return;
  }
  const double noise = workbench_.project().view.resistanceNoise;
  if (boundedFor_ == noise) return;
  boundedFor_ = noise;
  floorWords_->setText(tr("Being computed..."));
  boundErrors(noise);
}

void DesignPage::boundErrors(double noise) {
  bounding_.start(tr("Bounding the errors"),
                  [this, noise, samples = network_.sharedSamples()](const std::stop_token& stop,
                                                                    JobProgress&) -> JobRunner::Taking {
                    std::vector<int> all(static_cast<std::size_t>(samples->training.rowWires));
                    std::iota(all.begin(), all.end(), 0);
                    const int centre = centreRowWire(samples->training.rowWires);
                    const NoiseBound one = noiseBound(samples->training, InputKind::Resistance, {centre}, noise);
                    stopIfAsked(stop);
                    const NoiseBound every = noiseBound(samples->training, InputKind::Resistance, all, noise);
                    return [this, noise, samples, centre, one, every] {
                      if (samples == network_.sharedSamples() && boundedFor_ == noise)
                        floorWords_->setText(boundWords(centre, one, every));
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
