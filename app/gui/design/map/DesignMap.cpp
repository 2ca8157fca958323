#include "app/gui/design/map/DesignMap.h"

#include "app/gui/design/DesignFields.h"
#include "app/gui/design/ProgressWords.h"
#include "app/gui/design/map/MapWork.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/study/Median.h"
#include "app/study/reports/map/MapQuantities.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <cmath>

namespace palp {

namespace {

constexpr int kMapSideWidth_px = 360;
constexpr int kLeastMap_px = 140;

/// Those that have a place along x and y.
constexpr std::array kMappedShapes{IndenterShape::Sphere, IndenterShape::Pin, IndenterShape::Flat};

QString mapNumber(double value) {
  return QString::number(value, 'g', 3);
}

/// Median, and the worst with its place.
QString mapWords(const MappedResolution& map, std::size_t quantity) {
  const Eigen::MatrixXd values = valuesOf(map, quantity);
  std::vector<double> all;
  double worst = 0;
  Eigen::Vector2d at = map.low_mm;
  const Eigen::Vector2d step =
      (map.high_mm - map.low_mm).cwiseQuotient(Eigen::Vector2d(map.places[0] - 1, map.places[1] - 1));
  for (Eigen::Index x = 0; x < values.rows(); ++x)
    for (Eigen::Index y = 0; y < values.cols(); ++y)
      if (std::isfinite(values(x, y))) {
        all.push_back(values(x, y));
        if (values(x, y) < worst) continue;
        worst = values(x, y);
        at = map.low_mm + Eigen::Vector2d(static_cast<double>(x), static_cast<double>(y)).cwiseProduct(step);
      }
  const MapQuantity& its = mapQuantities()[quantity];
  const QString name = QString::fromStdString(its.name), unit = QString::fromStdString(its.unit);
  if (all.empty()) return QObject::tr("<b>%1</b>: not available at any of these positions.").arg(name);
  return QObject::tr("<b>%1</b>: median <b>%2 %3</b>, worst <b>%4 %3</b> at (%5, %6) mm. Contact radius %7 mm.")
      .arg(name, mapNumber(median(all)), unit, mapNumber(worst), mapNumber(at.x()), mapNumber(at.y()),
           mapNumber(map.contactRadius_mm));
}

QString mapIntention() {
  return QObject::tr(
      "Cramer-Rao bounds at rest, all row-wires read: no unbiased estimate has smaller deviations. Smallest detectable "
      "force: three deviations of a force straight down at a known position. Without friction, the normal force and "
      "the position are estimated; with a sticking contact, all three forces and the position.");
}

} // namespace

DesignMap::DesignMap(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  build();
  connect(start_, &QPushButton::clicked, this, &DesignMap::run);
  for (QComboBox* box : {shape_, law_}) connect(box, &QComboBox::activated, this, &DesignMap::readSettings);
  for (QDoubleSpinBox* box : {radius_, force_})
    connect(box, &QDoubleSpinBox::valueChanged, this, &DesignMap::readSettings);
  connect(places_, &QSpinBox::valueChanged, this, &DesignMap::readSettings);
  connect(noise_, &QDoubleSpinBox::valueChanged, this, [this](double percent) {
    workbench_.edit(tr("Change the noise of the resistances"),
                    [&](Project& next) { next.view.resistanceNoise = percent / 100; });
  });
  connect(quantity_, &QComboBox::activated, this, &DesignMap::chooseQuantity);
  connect(onBlock_, &QCheckBox::toggled, this, [this](bool on) {
    workbench_.edit(tr("Draw the map on the block"), [&](Project& next) { next.view.mapOnBlock = on; });
  });
  showProgress(runner_, *words_);
  connect(&runner_, &JobRunner::failed, this, [this](const QString& sentence) { showWords(*words_, sentence); });
  connect(&runner_, &JobRunner::started, this, &DesignMap::displayProject);
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (cancelled) shown_.reset(); // what was mapped before is shown again
    displayProject();
    if (cancelled) words_->setText(tr("Cancelled; nothing was changed. ") + (shown_ ? words_->text() : QString()));
  });
  connect(&workbench_, &Workbench::projectReplaced, this, [this] {
    if (runner_.running()) runner_.cancel(); // of the other project
    basis_.reset();
  });
  displayProject();
}

void DesignMap::build() {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(4, 4, 4, 4);
  auto* side = new QWidget;
  side->setFixedWidth(kMapSideWidth_px);
  auto* form = new QFormLayout(side);
  form->setContentsMargins(0, 0, 0, 0);
  form->setVerticalSpacing(3); // all of it is seen where the window is low
  start_ = pushButton(
      tr("Map the resolution"), "mapResolution",
      tr("Solves once per resistance; changing size, force or noise afterwards needs no new solve. Esc cancels."));
  form->addRow(start_);
  quantity_ = new QComboBox;
  quantity_->setObjectName("mapQuantity");
  for (const MapQuantity& each : mapQuantities())
    quantity_->addItem(QString::fromStdString(each.name + " [" + each.unit + "]"));
  quantity_->setToolTip(tr("Deviation of a touch's force or position, the smallest detectable force, or how far apart "
                           "two touches must be; all are computed together"));
  form->addRow(tr("Show"), quantity_);
  buildTouch(*form);
  row->addWidget(side, 0, Qt::AlignTop);
  auto* column = new QVBoxLayout;
  stale_ = new QLabel;
  stale_->setObjectName("mapState");
  stale_->setProperty("role", "hint");
  words_ = markupLabel();
  words_->setObjectName("mapWords");
  words_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  for (QLabel* label : {stale_, words_}) {
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(label);
  }
  map_ = new HeatmapView;
  map_->setObjectName("resolutionMap");
  map_->setMinimumHeight(kLeastMap_px);
  column->addWidget(map_, 1);
  column->addStretch(); // under the words alone
  row->addLayout(column, 1);
}

void DesignMap::buildTouch(QFormLayout& form) {
  shape_ = new QComboBox;
  shape_->setObjectName("mapShape");
  for (const IndenterShape shape : kMappedShapes) shape_->addItem(QString::fromStdString(shapeName(shape)));
  shape_->setToolTip(tr("Shape of the indenter that the map assumes"));
  const auto number = [](const char* name, const QString& unit, double low, double high, const QString& tip) {
    auto* box = numberBox(name, {.low = low, .high = high, .decimals = 3, .step = 0.5, .unit = unit}, tip);
    return box;
  };
  const auto pair = [&form](const QString& label, QWidget* first, QWidget* second) {
    form.addRow(label, inRow({{first, 1}, {second, 1}}));
  };
  radius_ = number("mapRadius", tr(" mm"), 0.05, 1e4, tr("Radius of the sphere, the pin or the punch"));
  force_ = number("mapForce", tr(" N"), 0.001, 1e4,
                  tr("Force of the touch; the deviation of the position is inversely proportional to it"));
  noise_ = new RatioBox(100, "%");
  noise_->setObjectName("mapNoise");
  noise_->setAccessibleName(tr("Noise of the resistances"));
  noise_->setRange(0.00001, 10);
  noise_->setDecimals(5);
  noise_->setPrefix(tr("Noise "));
  noise_->setKeyboardTracking(false);
  noise_->setToolTip(tr("Relative noise of each reading, as in \"Mesh and noise floor\""));
  places_ = wholeBox(
      "mapPlaces", {.low = 3, .high = kMostMapPlaces},
      tr("Number of positions along the shorter side of the face; a margin of a tenth of the side is left out"));
  onBlock_ = checkBox(tr("Also on the block"), "mapOnBlock");
  pair(tr("Touch"), shape_, radius_);
  pair(tr("Force"), force_, noise_);
  law_ = choiceBox("mapLaw", {}, tr("Law and read-out of the resistances, for this map only"));
  law_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  form.addRow(tr("Law, read-out"), law_);
  pair(tr("Positions"), places_, onBlock_);
}

void DesignMap::setTheme(Theme theme) {
  map_->setTheme(theme);
}

void DesignMap::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  displayProject();
  emit overBlockChanged();
}

/// Some 20 MB, found again in seconds.
void DesignMap::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  if (!runner_.running()) basis_.reset();
  emit overBlockChanged();
}

void DesignMap::listLaws(const SensorDesign& design) {
  const QSignalBlocker quiet(law_);
  law_->clear();
  const std::vector<DesignChoice>& readouts = designField("resistance.readout").choices;
  const FieldLaw* field = design.field();
  const QString own = field != nullptr ? readouts[static_cast<std::size_t>(field->readout)].words : QString("Eq. (1)");
  law_->addItem(tr("The design's (%1)").arg(own), QString());
  law_->addItem(tr("Eq. (1)"), "pairs");
  for (std::size_t k = 0; k < readouts.size(); ++k)
    law_->addItem(tr("Field, %1").arg(readouts[k].words), QString::fromStdString(kReadouts.all()[k].second));
}

std::size_t DesignMap::quantity() const {
  const auto& all = mapQuantities();
  const auto its = std::find_if(all.begin(), all.end(), [this](const MapQuantity& each) {
    return each.file == workbench_.project().view.mapQuantity;
  });
  return its == all.end() ? 0 : static_cast<std::size_t>(its - all.begin());
}

void DesignMap::chooseQuantity(int quantity) {
  workbench_.edit(tr("Select the quantity of the map"), [&](Project& next) {
    next.view.mapQuantity = mapQuantities()[static_cast<std::size_t>(quantity)].file;
  });
}

void DesignMap::readSettings() {
  Project next = workbench_.project();
  const Indenter usual = mappedTouch(next.design, {});
  MapSettings& map = next.studies.map;
  map.shape = kMappedShapes[static_cast<std::size_t>(shape_->currentIndex())];
  map.radius_mm = radius_->value() == usual.radius_mm ? 0 : radius_->value(); // the usual one follows the design
  map.force_N = force_->value() == -usual.press()->force_N.z() ? 0 : force_->value();
  map.places = places_->value();
  map.law = law_->currentData().toString().toStdString();
  workbench_.edit(tr("Change the settings of the map"), next);
}

void DesignMap::displayProject() {
  const Project& project = workbench_.project();
  const MapSettings& settings = project.studies.map;
  const Indenter touch = mappedTouch(project.design, settings);
  const QSignalBlocker quietPlaces(places_), quietBlock(onBlock_);
  const auto shape = std::find(kMappedShapes.begin(), kMappedShapes.end(), settings.shape);
  shape_->setCurrentIndex(shape == kMappedShapes.end() ? 0 : static_cast<int>(shape - kMappedShapes.begin()));
  showExactly(*radius_, touch.radius_mm);
  showExactly(*force_, -touch.press()->force_N.z());
  showExactly(*noise_, 100 * project.view.resistanceNoise);
  places_->setValue(settings.places);
  listLaws(project.design);
  law_->setCurrentIndex(std::max(0, law_->findData(QString::fromStdString(settings.law))));
  quantity_->setCurrentIndex(static_cast<int>(quantity()));
  onBlock_->setChecked(project.view.mapOnBlock);
  start_->setEnabled(!runner_.running());
  if (!runner_.running()) showMap();
  const QString state = runner_.running() ? QString() : staleWords();
  stale_->setText(state);
  stale_->setVisible(!state.isEmpty());
}

QString DesignMap::staleWords() const {
  if (!shown_) return {};
  const Project& project = workbench_.project();
  const MapSettings& settings = project.studies.map;
  Indenter touch = mappedTouch(project.design, settings);
  touch.place_mm = shown_->touch.place_mm;
  if (shown_->design != mappedDesign(project.design, settings))
    return tr(
        "Outdated: this map belongs to another design, law or read-out. Press \"Map the resolution\" to update it.");
  if (shown_->touch != touch || shown_->noise != project.view.resistanceNoise)
    return tr("Outdated: this map belongs to another touch or noise. Press \"Map the resolution\" to update it.");
  return {};
}

void DesignMap::showMap() {
  const Project& project = workbench_.project();
  if (project.studies.mapped == shown_ && project.view.mapQuantity == shownQuantity_ && !words_->text().isEmpty())
    return;
  shown_ = project.studies.mapped;
  shownQuantity_ = project.view.mapQuantity;
  map_->setHeatmap(shown_ ? mapHeatmap(*shown_, quantity()) : HeatmapSpec{});
  map_->setVisible(shown_.has_value());
  words_->setText(shown_ ? mapWords(*shown_, quantity()) : mapIntention());
  words_->setToolTip(shown_ ? mapIntention() : QString());
}

std::shared_ptr<const FaceMap> DesignMap::overBlock() const {
  const Project& project = workbench_.project();
  const auto& mapped = project.studies.mapped;
  const bool ofThisBlock = mapped && mapped->design.block_mm == project.design.block_mm;
  if (!isVisible() || !ofThisBlock || !project.view.mapOnBlock) return {};
  return std::make_shared<const FaceMap>(faceMap(*mapped, quantity()));
}

void DesignMap::run() {
  const Project& project = workbench_.project();
  words_->setText(tr("Computing..."));
  runner_.start(
      tr("Mapping the resolution"),
      [this, design = project.design, mesh = project.mesh, settings = project.studies.map,
       noise = project.view.resistanceNoise,
       before = basis_](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        const auto report = [&](double share, const std::string& what) { progress.set(share, what); };
        const MapFound found = mapResolution(design, mesh, settings, noise, before, report, stop);
        if (!found.basis || stop.stop_requested()) return {};
        return [this, found] {
          if (isVisible()) basis_ = found.basis;
          shown_.reset(); // also where it is what was found before
          workbench_.edit(tr("Map the resolution"), [&](Project& next) { next.studies.mapped = found.map; });
        };
      },
      JobRunner::Loss::Work);
}

} // namespace palp
