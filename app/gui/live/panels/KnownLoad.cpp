#include "app/gui/live/panels/KnownLoad.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr std::array<const char*, 3> kAxes{"Fx", "Fy", "Fz"};
constexpr double kMostForce_N = 500;
constexpr double kNewtonPerGram = 9.80665e-3; ///< standard gravity, CGPM 1901
constexpr double kMostMass_g = 50000;
constexpr int kNumber_px = 56; ///< that "-9.8067" takes

/// Where a mass pulls: the item's text, and the axis and sign of its force.
struct Pull {
  const char* text;
  std::size_t axis;
  double sign;
};
constexpr std::array<Pull, 5> kPulls{{{QT_TR_NOOP("down (-z)"), 2, -1},
                                      {QT_TR_NOOP("along +x"), 0, 1},
                                      {QT_TR_NOOP("along -x"), 0, -1},
                                      {QT_TR_NOOP("along +y"), 1, 1},
                                      {QT_TR_NOOP("along -y"), 1, -1}}};

} // namespace

std::array<double, 3> suggestedMasses_g(double most_N) {
  std::array<double, 3> masses_g{};
  for (double decade = 1; decade <= kMostMass_g; decade *= 10)
    for (const double digit : {1.0, 2.0, 5.0})
      if (decade * digit * kNewtonPerGram <= most_N) masses_g = {decade * digit, masses_g[0], masses_g[1]};
  return masses_g;
}

KnownLoad::KnownLoad(QWidget* parent) : QWidget(parent) {
  auto* form = form_ = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  area_ = wholeBox("labelArea", {.whileTyping = true}, tr("Pressed load area; areas count from 0"));
  form->addRow(tr("Area"), area_);
  placeRow_ = buildPlace();
  form->addRow(tr("Position"), placeRow_);
  form->setRowVisible(placeRow_, false);
  form->addRow(tr("Mass"), buildMass());
  form->addRow(tr("Suggested"), buildSuggestions());
  form->addRow(buildForces());
}

QHBoxLayout* KnownLoad::buildPlace() {
  auto* row = new QHBoxLayout;
  for (std::size_t axis = 0; axis < place_mm_.size(); ++axis) {
    const QString name = axis == 0 ? "x" : "y";
    place_mm_[axis] = numberBox("label_" + name, {.unit = tr(" mm"), .whileTyping = true},
                                tr("%1 of the touch, measured from the block's corner [mm]").arg(name),
                                tr("%1 of the known touch").arg(name));
    place_mm_[axis]->setMinimumWidth(kNumber_px);
    row->addWidget(place_mm_[axis], 1);
  }
  return row;
}

QHBoxLayout* KnownLoad::buildMass() {
  mass_g_ = numberBox(
      "labelMass", {.high = kMostMass_g, .step = 10, .unit = tr(" g"), .special = tr("none"), .whileTyping = true},
      tr("<qt>Mass that rests on the area or hangs on a thread that pulls it along x or y [g]; its weight "
         "(9.80665 N/kg) is the force below</qt>"),
      tr("Mass of the known load"));
  direction_ = choiceBox("labelDirection", {}, {}, tr("Direction of the mass"));
  for (const Pull& pull : kPulls) direction_->addItem(tr(pull.text));
  direction_->setToolTip(tr("Direction of the weight: down where it rests on the area, otherwise along the thread"));
  connect(mass_g_, &QDoubleSpinBox::valueChanged, this, &KnownLoad::takeMass);
  connect(direction_, &QComboBox::currentIndexChanged, this, &KnownLoad::takeMass);
  mass_g_->setMinimumWidth(kNumber_px);
  return inRow({{mass_g_, 1}, direction_});
}

QHBoxLayout* KnownLoad::buildSuggestions() {
  auto* row = new QHBoxLayout;
  for (std::size_t k = 0; k < suggested_.size(); ++k) {
    suggested_[k] = pushButton(QString(), QString("suggestedMass%1").arg(k));
    suggested_[k]->setMinimumWidth(kNumber_px);
    suggested_[k]->hide();
    row->addWidget(suggested_[k]);
    connect(suggested_[k], &QPushButton::clicked, this,
            [this, k] { mass_g_->setValue(suggested_[k]->property("mass_g").toDouble()); });
  }
  return row;
}

QLayout* KnownLoad::buildForces() {
  auto* grid = new QGridLayout;
  auto* known = new QLabel(tr("Force"));
  auto* reads = new QLabel(tr("Decoded"));
  reads->setToolTip(tr("Present force decoded by the network in use [N]"));
  grid->addWidget(known, 1, 0);
  grid->addWidget(reads, 2, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int column = static_cast<int>(axis) + 1;
    auto* name = new QLabel(kAxes[axis]);
    force_N_[axis] =
        numberBox(QString("label_%1").arg(kAxes[axis]),
                  {.low = -kMostForce_N, .high = kMostForce_N, .decimals = 4, .step = 0.1, .whileTyping = true}, {},
                  tr("%1 of the known load").arg(kAxes[axis]));
    force_N_[axis]->setButtonSymbols(QAbstractSpinBox::NoButtons); // three in a line
    force_N_[axis]->setMinimumWidth(kNumber_px);
    force_N_[axis]->setToolTip(tr("%1 of the known load [N]; a push is negative in z").arg(kAxes[axis]));
    name->setBuddy(force_N_[axis]);
    reads_[axis] = new QLabel;
    reads_[axis]->setObjectName(QString("reads_%1").arg(kAxes[axis]));
    reads_[axis]->setToolTip(reads->toolTip());
    grid->addWidget(name, 0, column);
    grid->addWidget(force_N_[axis], 1, column);
    grid->addWidget(reads_[axis], 2, column);
    grid->setColumnStretch(column, 1);
    connect(force_N_[axis], &QDoubleSpinBox::valueChanged, this, [this] { // typed: not a mass any more
      const QSignalBlocker quiet(mass_g_);
      mass_g_->setValue(0);
    });
  }
  return grid;
}

void KnownLoad::takeMass() {
  if (mass_g_->value() == 0) return; // the present force stays
  const Pull& pull = kPulls[static_cast<std::size_t>(direction_->currentIndex())];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const QSignalBlocker quiet(force_N_[axis]);
    force_N_[axis]->setValue(axis == pull.axis ? pull.sign * mass_g_->value() * kNewtonPerGram : 0);
  }
}

void KnownLoad::setSensor(const SensorDesign& sensor, const Decoder* decoder) {
  sensor_ = sensor;
  area_->setRange(0, std::max(0, sensor.areas.count() - 1));
  placed_ = decoder != nullptr && decoder->place.has_value();
  form_->setRowVisible(area_, !placed_);
  form_->setRowVisible(placeRow_, placed_);
  for (std::size_t axis = 0; axis < place_mm_.size(); ++axis) // the middle stays the middle of another block
    if (const double side_mm = sensor.block_mm(static_cast<Eigen::Index>(axis));
        place_mm_[axis]->maximum() != side_mm) {
      place_mm_[axis]->setRange(0, side_mm);
      place_mm_[axis]->setValue(side_mm / 2);
    }
  const std::array<double, 3> masses_g = suggestedMasses_g(decoder != nullptr ? -decoder->low_N(2) : 0);
  for (std::size_t k = 0; k < suggested_.size(); ++k) {
    const double mass_g = masses_g[k];
    suggested_[k]->setVisible(mass_g > 0);
    if (mass_g == 0) continue;
    suggested_[k]->setProperty("mass_g", mass_g);
    suggested_[k]->setText(mass_g < 1000 ? tr("%1 g").arg(mass_g) : tr("%1 kg").arg(mass_g / 1000));
    suggested_[k]->setToolTip(tr("<qt>%1 N, within the %2 N of push that the network was trained for. One frame under "
                                 "each of three weights, on each area in turn, separates gain from offset.</qt>")
                                  .arg(mass_g * kNewtonPerGram, 0, 'g', 3)
                                  .arg(-decoder->low_N(2), 0, 'g', 3));
  }
}

KnownTouch KnownLoad::load() const {
  const Eigen::Vector3d force_N(force_N_[0]->value(), force_N_[1]->value(), force_N_[2]->value());
  if (placed_) return knownTouch(sensor_, {place_mm_[0]->value(), place_mm_[1]->value()}, force_N);
  return {{area_->value(), force_N}};
}

void KnownLoad::displayReading(const std::optional<Eigen::Vector3d>& force_N) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double value_N = force_N ? (*force_N)(static_cast<Eigen::Index>(axis)) : 0;
    const QString text = force_N && std::isnan(value_N) ? tr("not measured")
                         : force_N                      ? QString::number(std::round(1e3 * value_N) / 1e3 + 0.0, 'f', 3)
                                                        : tr("none");
    if (reads_[axis]->text() != text) reads_[axis]->setText(text);
  }
}

} // namespace palp
