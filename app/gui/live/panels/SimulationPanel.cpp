#include "app/gui/live/panels/SimulationPanel.h"

#include "app/gui/widgets/SpinBoxes.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

constexpr double kMostTouch_N = 100;
constexpr int kFirstLoss = 10; // of so many reports one is lost

QComboBox* numberBox(const QString& name, const QStringList& values, const QString& tip) {
  auto* box = new QComboBox;
  box->setObjectName(name);
  box->setEditable(true);
  box->setInsertPolicy(QComboBox::NoInsert);
  box->addItems(values);
  box->setToolTip(tip);
  return box;
}

/// None stands at the least value: the word can be typed as well as read.
class NoneBox : public WholeBox {
public:
  NoneBox() { setSpecialValueText(QObject::tr("none")); }

  QValidator::State validate(QString& text, int& place) const override {
    const QString typed = text.trimmed();
    if (typed.compare(specialValueText(), Qt::CaseInsensitive) == 0) return QValidator::Acceptable;
    if (specialValueText().startsWith(typed, Qt::CaseInsensitive)) return QValidator::Intermediate;
    return WholeBox::validate(text, place);
  }

protected:
  [[nodiscard]] int valueFromText(const QString& text) const override {
    const bool none = text.trimmed().compare(specialValueText(), Qt::CaseInsensitive) == 0;
    return none ? minimum() : WholeBox::valueFromText(text);
  }
};

/// An arrow leads from none past 1, where nothing would come at all.
class LossBox : public NoneBox {
public:
  void stepBy(int steps) override {
    const int next = value() + steps;
    setValue(value() == 0 && steps > 0 ? kFirstLoss : next < 2 ? 0 : next);
  }
};

QSpinBox* wireBox(const QString& name, const QString& tip) {
  auto* box = new NoneBox;
  box->setObjectName(name);
  box->setRange(-1, -1); // until it is known which wires there are
  box->setToolTip(tip);
  return box;
}

} // namespace

SimulationPanel::SimulationPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* box = new QGroupBox(tr("Simulated board"));
  auto* form = form_ = new QFormLayout(box);
  plug_ = new QPushButton(tr("Unplug"));
  plug_->setObjectName("plug");
  plug_->setToolTip(tr("Unplugs the simulated board, or plugs it in again"));
  form->addRow(plug_);
  buildDesign(*form);
  buildTouch(*form);
  buildDisturbances(*form);
  buildFaults(*form);
  column->addWidget(box);
  connect(plug_, &QPushButton::clicked, this, [this] { emit plugAsked(plug_->text() != tr("Unplug")); });
}

void SimulationPanel::buildDesign(QFormLayout& form) {
  design_ = new QLabel;
  design_->setObjectName("simulatedDesign");
  design_->setWordWrap(true);
  simulate_ = new QPushButton(tr("Simulate the project's design"));
  simulate_->setObjectName("simulateDesign");
  simulate_->setToolTip(tr("Solves 24 loads per area of the project's design, and trains a network on them if none is "
                           "selected; this takes a while, Esc cancels"));
  form.addRow(design_);
  form.addRow(simulate_);
  connect(simulate_, &QPushButton::clicked, this, &SimulationPanel::designAsked);
}

/// A touch of one's own, in place of the one that goes over the areas by itself.
void SimulationPanel::buildTouch(QFormLayout& form) {
  moving_ = new QCheckBox(tr("Moving indenter"));
  moving_->setObjectName("movingIndenter");
  moving_->setToolTip(
      tr("<qt>A sphere moves over the face and presses, instead of a finger on the load areas; its true position is "
         "drawn next to the decoded one. This is solved once per design and takes a while.</qt>"));
  form.addRow(moving_);
  connect(moving_, &QCheckBox::toggled, this, [this](bool on) {
    edit(tr("moving indenter"), [&](LiveSettings& s) { s.simulation.moving = on; });
    if (on) emit designAsked();
  });
  held_ = new QCheckBox(tr("Touch by hand"));
  held_->setObjectName("touchHeld");
  held_->setToolTip(
      tr("<qt>Applies the touch below. Press an area in the picture to move the touch there, and drag for shear. With "
         "the keyboard: Return takes or releases it, arrows move it, + and - press, Shift with arrows shears.</qt>"));
  form.addRow(held_);
  area_ = new WholeBox;
  area_->setObjectName("touchArea");
  area_->setToolTip(tr("Pressed load area; areas count from 0"));
  form.addRow(tr("Area"), area_);
  auto* at = places_ = new QHBoxLayout;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    QDoubleSpinBox* box = place_[axis] = new NumberBox;
    box->setObjectName(axis == 0 ? "touch_x" : "touch_y");
    box->setAccessibleName(axis == 0 ? tr("x of the simulated touch") : tr("y of the simulated touch"));
    box->setRange(0, 1e4);
    box->setDecimals(2);
    box->setSingleStep(0.5);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setToolTip(
        tr("Position of the indenter; it can also be dragged in the picture, or moved with the arrow keys"));
    at->addWidget(box);
    connect(box, &QDoubleSpinBox::valueChanged, this, [this, axis](double value) {
      edit(tr("simulated touch"), [&](LiveSettings& s) { s.simulation.heldPlace_mm[axis] = value; });
    });
  }
  form.addRow(tr("Position [mm]"), at);
  auto* row = new QHBoxLayout;
  constexpr std::array<const char*, 3> kNames{"Fx", "Fy", "Fz"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    force_[axis] = new NumberBox;
    force_[axis]->setObjectName(QString("touch_%1").arg(kNames[axis]));
    force_[axis]->setAccessibleName(tr("%1 of the simulated touch").arg(kNames[axis]));
    force_[axis]->setRange(-kMostTouch_N, kMostTouch_N);
    force_[axis]->setDecimals(2);
    force_[axis]->setSingleStep(0.1);
    force_[axis]->setButtonSymbols(QAbstractSpinBox::NoButtons); // three in a line
    force_[axis]->setMinimumWidth(48);
    force_[axis]->setToolTip(tr("%1 of the touch [N]; a push is negative in z").arg(kNames[axis]));
    row->addWidget(force_[axis]);
    connect(force_[axis], &QDoubleSpinBox::valueChanged, this, [this, axis](double value) {
      edit(tr("simulated touch"), [&](LiveSettings& s) { s.simulation.heldForce_N[axis] = value; });
    });
  }
  form.addRow(tr("Force [N]"), row);
  connect(held_, &QCheckBox::toggled, this,
          [this](bool on) { edit(tr("simulated touch"), [&](LiveSettings& s) { s.simulation.held = on; }); });
  follow(area_, &QSpinBox::valueChanged, tr("simulated touch"),
         [](SimulationSettings& s, int value) { s.heldArea = value; });
}

/// What `signal` of `box` gives goes into the simulation's settings.
template <class Box, class Signal, class Change>
void SimulationPanel::follow(Box* box, Signal signal, const QString& what, Change change) {
  connect(box, signal, this,
          [this, what, change](auto value) { edit(what, [&](LiveSettings& s) { change(s.simulation, value); }); });
}

/// What makes the readings of a board that works differ from those of a perfect one.
void SimulationPanel::buildDisturbances(QFormLayout& form) {
  noise_ = numberBox("noise", {"5e-6", "1e-5", "1e-4"},
                     tr("Relative noise of a reading (rms): 5e-6 (5 ppm) is a good board, 1e-4 a plain one"));
  warming_ = new NumberBox;
  warming_->setObjectName("warming");
  warming_->setRange(0, 100);
  warming_->setSuffix(tr(" K"));
  warming_->setToolTip(tr("Warming of the board [K], with a time constant of 5 min; R drifts by 0.1 %/K"));
  hysteresis_ = new NumberBox;
  hysteresis_->setObjectName("hysteresis");
  hysteresis_->setRange(0, 100);
  hysteresis_->setSuffix(tr(" %"));
  hysteresis_->setToolTip(tr("Share of dR that is subject to backlash hysteresis of width 1e-4 R [%]"));
  form.addRow(tr("Noise"), noise_);
  form.addRow(tr("Warming"), warming_);
  form.addRow(tr("Hysteresis"), hysteresis_);
  connect(noise_, &QComboBox::currentTextChanged, this, [this](const QString& text) {
    const auto value = typedNumber(text);
    if (value && *value >= 0 && *value <= 1)
      edit(tr("noise"), [&](LiveSettings& settings) { settings.simulation.noise = *value; });
  });
  connect(noise_->lineEdit(), &QLineEdit::editingFinished, this, [this] {
    const auto value = typedNumber(noise_->currentText());
    if (value && *value >= 0 && *value <= 1) return;
    sayNotApplied(*noise_, tr("Not applied: \"%1\" is not a number from 0 to 1").arg(noise_->currentText()));
    display(settings_);
  });
  follow(warming_, &QDoubleSpinBox::valueChanged, tr("warming"),
         [](SimulationSettings& s, double value) { s.warming_degC = value; });
  follow(hysteresis_, &QDoubleSpinBox::valueChanged, tr("hysteresis"),
         [](SimulationSettings& s, double value) { s.hysteresisShare = value / 100; });
}

void SimulationPanel::buildFaults(QFormLayout& form) {
  openRow_ =
      wireBox("openRow",
              tr("Breaks this row-wire: a network that reads it gives no forces, a network of other row-wires does"));
  openColumn_ = wireBox(
      "openColumn", tr("Breaks this column-wire: every network reads it, so there are no forces until it is repaired"));
  dropEvery_ = new LossBox;
  dropEvery_->setObjectName("dropEvery");
  dropEvery_->setRange(0, 100000);
  dropEvery_->setToolTip(tr("Loses every n-th report on its way; 1 loses all"));
  form.addRow(tr("Broken row-wire"), openRow_);
  form.addRow(tr("Broken column-wire"), openColumn_);
  form.addRow(tr("Drop every n-th report"), dropEvery_);
  follow(openRow_, &QSpinBox::valueChanged, tr("broken row-wire"),
         [](SimulationSettings& s, int value) { s.openRow = value; });
  follow(openColumn_, &QSpinBox::valueChanged, tr("broken column-wire"),
         [](SimulationSettings& s, int value) { s.openColumn = value; });
  follow(dropEvery_, &QSpinBox::valueChanged, tr("lost reports"),
         [](SimulationSettings& s, int value) { s.dropEvery = value; });
}

void SimulationPanel::edit(const QString& what, const std::function<void(LiveSettings&)>& change) {
  LiveSettings next = settings_;
  change(next);
  if (next == settings_) return;
  settings_ = next;
  emit edited(what, next);
}

void SimulationPanel::display(const LiveSettings& settings) {
  settings_ = settings;
  const SimulationSettings& simulation = settings.simulation;
  const auto put = [](auto* box, auto value) {
    if (box->value() == value) return; // what is being typed stays as it is
    const QSignalBlocker quiet(box);
    box->setValue(value);
  };
  put(warming_, simulation.warming_degC);
  put(hysteresis_, 100 * simulation.hysteresisShare);
  showBrokenWires();
  put(dropEvery_, simulation.dropEvery);
  put(area_, simulation.heldArea);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(force_[axis], simulation.heldForce_N[axis]);
    force_[axis]->setEnabled(simulation.held && (axis == 2 || !simulation.moving)); // nothing holds it sideways
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    put(place_[axis], simulation.heldPlace_mm[axis]);
    place_[axis]->setEnabled(simulation.held);
  }
  form_->setRowVisible(area_, !simulation.moving);
  form_->setRowVisible(places_, simulation.moving);
  area_->setEnabled(simulation.held);
  const QSignalBlocker quietHeld(held_), quietNoise(noise_), quietMoving(moving_);
  moving_->setChecked(simulation.moving);
  held_->setChecked(simulation.held);
  if (typedNumber(noise_->currentText()) != simulation.noise)
    noise_->setEditText(QString::number(simulation.noise, 'g', 6));
}

/// A wire that the simulated design does not have breaks nothing: none is shown.
void SimulationPanel::showBrokenWires() {
  const SimulationSettings& simulation = settings_.simulation;
  for (const auto& [box, wire] : {std::pair{openRow_, simulation.openRow}, {openColumn_, simulation.openColumn}}) {
    const int shown = wire <= box->maximum() ? wire : -1;
    if (box->value() == shown) continue;
    const QSignalBlocker quiet(box);
    box->setValue(shown);
  }
}

void SimulationPanel::displayState(const SimulationState& state) {
  plug_->setText(state.pluggedIn ? tr("Unplug") : tr("Plug in"));
  const QSignalBlocker quiet(area_), quietRow(openRow_), quietColumn(openColumn_);
  area_->setMaximum(std::max(0, state.areas - 1));
  openRow_->setMaximum(state.rowWires - 1);
  openColumn_->setMaximum(state.columnWires - 1);
  showBrokenWires();
  const bool moving = settings_.simulation.moving;
  const QString words = state.solving               ? tr("Solving the project's design...")
                        : state.ownDesign && moving ? tr("Simulates a sphere that moves over the project's design.")
                        : state.ownDesign           ? tr("Simulates the project's design.")
                        : moving                    ? tr("The moving indenter is not solved yet.")
                                                    : tr("Simulates the paper's design, not the project's.");
  if (design_->text() != words) design_->setText(words);
  simulate_->setEnabled(!state.ownDesign && !state.solving);
}

} // namespace palp
