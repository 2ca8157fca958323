#include "app/gui/live/panels/SimulationPanel.h"

#include "app/gui/widgets/MakeWidgets.h"

#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

constexpr double kMostTouch_N = 100;
constexpr int kFirstLoss = 10; // the arrow up from none loses every 10th report

/// The lowest value is shown as "none", which can also be typed.
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

/// The arrows skip 1, which loses every report.
class LossBox : public NoneBox {
public:
  void stepBy(int steps) override {
    const int next = value() + steps;
    setValue(value() == 0 && steps > 0 ? kFirstLoss : next < 2 ? 0 : next);
  }
};

/// A member of the simulation's settings.
template <class Value> auto of(Value SimulationSettings::*member) {
  return [member](LiveSettings& settings) -> Value& { return settings.simulation.*member; };
}

} // namespace

SimulationPanel::SimulationPanel(QWidget* parent)
    : QWidget(parent), fields_([this](const QString& what, const LiveSettings& next) { emit edited(what, next); }) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* box = new QGroupBox(tr("Simulated board"));
  auto* form = form_ = new QFormLayout(box);
  plug_ = pushButton(tr("Unplug"), "plug", tr("Unplugs the simulated board, or plugs it in again"));
  form->addRow(plug_);
  buildDesign(*form);
  buildTouch(*form);
  buildDisturbances(*form);
  buildFaults(*form);
  column->addWidget(box);
  connect(plug_, &QPushButton::clicked, this, [this] { emit plugRequested(plug_->text() != tr("Unplug")); });
}

void SimulationPanel::buildDesign(QFormLayout& form) {
  design_ = textLabel("simulatedDesign");
  simulate_ = pushButton(tr("Simulate the project's design"), "simulateDesign",
                         tr("Solves 24 loads per area of the project's design, and trains a network on them if none is "
                            "selected; this takes a while, Esc cancels"));
  form.addRow(design_);
  form.addRow(simulate_);
  connect(simulate_, &QPushButton::clicked, this, &SimulationPanel::designRequested);
}

/// A touch by hand, instead of the touch that moves over the areas automatically.
void SimulationPanel::buildTouch(QFormLayout& form) {
  const QString what = tr("Change the simulated touch");
  auto* moving = fields_.bind(
      checkBox(tr("Moving indenter"), "movingIndenter",
               tr("<qt>A sphere moves over the face and presses, instead of a finger on the load areas; its true "
                  "position is drawn next to the decoded one. This is solved once per design and takes a while.</qt>")),
      tr("Change the moving indenter"), of(&SimulationSettings::moving));
  form.addRow(moving);
  connect(moving, &QCheckBox::toggled, this, [this](bool on) {
    if (on) emit designRequested();
  });
  form.addRow(fields_.bind(
      checkBox(tr("Touch by hand"), "touchHeld",
               tr("<qt>Applies the touch below. Press an area in the picture to move the touch there, and drag for "
                  "shear. With the keyboard: Return takes or releases it, arrows move it, + and - press, Shift with "
                  "arrows shears.</qt>")),
      what, of(&SimulationSettings::held)));
  area_ = fields_.bind(wholeBox("touchArea", {.whileTyping = true}, tr("Pressed load area; areas count from 0")), what,
                       of(&SimulationSettings::heldArea));
  form.addRow(tr("Area"), area_);
  places_ = new QHBoxLayout;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    place_[axis] = fields_.bind(
        numberBox(axis == 0 ? "touch_x" : "touch_y", {.high = 1e4, .step = 0.5, .whileTyping = true},
                  tr("Position of the indenter; it can also be dragged in the picture, or moved with the arrow keys"),
                  axis == 0 ? tr("x of the simulated touch") : tr("y of the simulated touch")),
        what, [axis](LiveSettings& s) -> double& { return s.simulation.heldPlace_mm[axis]; });
    place_[axis]->setButtonSymbols(QAbstractSpinBox::NoButtons);
    places_->addWidget(place_[axis]);
  }
  form.addRow(tr("Position [mm]"), places_);
  auto* row = new QHBoxLayout;
  constexpr std::array<const char*, 3> kNames{"Fx", "Fy", "Fz"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    force_[axis] =
        fields_.bind(numberBox(QString("touch_%1").arg(kNames[axis]),
                               {.low = -kMostTouch_N, .high = kMostTouch_N, .step = 0.1, .whileTyping = true},
                               tr("%1 of the touch [N]; a push is negative in z").arg(kNames[axis]),
                               tr("%1 of the simulated touch").arg(kNames[axis])),
                     what, [axis](LiveSettings& s) -> double& { return s.simulation.heldForce_N[axis]; });
    force_[axis]->setButtonSymbols(QAbstractSpinBox::NoButtons); // three in a line
    force_[axis]->setMinimumWidth(48);
    row->addWidget(force_[axis]);
  }
  form.addRow(tr("Force [N]"), row);
}

/// How the readings of a working board differ from those of a perfect one.
void SimulationPanel::buildDisturbances(QFormLayout& form) {
  auto* noise = new RatioBox(1e6, "ppm");
  noise->setObjectName("simulatedNoise");
  noise->setRange(0, 1e6);
  noise->setDecimals(3);
  noise->setKeyboardTracking(false);
  noise->setToolTip(tr("Relative noise of a reading (rms): 5 ppm is a good board, 100 ppm a plain one"));
  form.addRow(tr("Noise"), fields_.bind(noise, tr("Change the noise"), of(&SimulationSettings::noise), 1e6));
  form.addRow(
      tr("Warming"),
      fields_.bind(numberBox("warming", {.high = 100, .unit = tr(" K"), .whileTyping = true},
                             tr("Warming of the board [K], with a time constant of 5 min; R drifts by 0.1 %/K")),
                   tr("Change the warming"), of(&SimulationSettings::warming_degC)));
  form.addRow(tr("Hysteresis"),
              fields_.bind(numberBox("hysteresis", {.high = 100, .unit = tr(" %"), .whileTyping = true},
                                     tr("Share of dR that is subject to backlash hysteresis of width 1e-4 R [%]")),
                           tr("Change the hysteresis"), of(&SimulationSettings::hysteresisShare), 100));
}

void SimulationPanel::buildFaults(QFormLayout& form) {
  openRow_ = addWire("openRow", tr("Change the broken row-wire"), &SimulationSettings::openRow,
                     tr("Breaks this row-wire: a network that reads it gives no forces, a network of other row-wires "
                        "does"));
  openColumn_ = addWire("openColumn", tr("Change the broken column-wire"), &SimulationSettings::openColumn,
                        tr("Breaks this column-wire: every network reads it, so there are no forces until it is "
                           "repaired"));
  auto* dropEvery = new LossBox;
  dropEvery->setObjectName("dropEvery");
  dropEvery->setRange(0, 100000);
  dropEvery->setToolTip(tr("Loses every n-th report on its way; 1 loses all"));
  form.addRow(tr("Broken row-wire"), openRow_);
  form.addRow(tr("Broken column-wire"), openColumn_);
  form.addRow(tr("Drop every n-th report"),
              fields_.bind(dropEvery, tr("Change the lost reports"), of(&SimulationSettings::dropEvery)));
}

QSpinBox* SimulationPanel::addWire(const QString& name, const QString& what, int SimulationSettings::*wire,
                                   const QString& tip) {
  auto* box = new NoneBox;
  box->setObjectName(name);
  box->setRange(-1, -1); // until the number of wires is known
  box->setToolTip(tip);
  return fields_.add(
      box, &QSpinBox::valueChanged, what,
      [this, box, wire] { // a wire that the simulated design does not have breaks nothing
        const int broken = fields_.settings().simulation.*wire;
        box->setValue(broken <= box->maximum() ? broken : -1);
      },
      [wire](LiveSettings& settings, int value) { settings.simulation.*wire = value; });
}

void SimulationPanel::display(const LiveSettings& settings) {
  fields_.display(settings);
  const SimulationSettings& simulation = settings.simulation;
  for (std::size_t axis = 0; axis < 3; ++axis) // a moving indenter is pressed straight down
    force_[axis]->setEnabled(simulation.held && (axis == 2 || !simulation.moving));
  for (QDoubleSpinBox* box : place_) box->setEnabled(simulation.held);
  form_->setRowVisible(area_, !simulation.moving);
  form_->setRowVisible(places_, simulation.moving);
  area_->setEnabled(simulation.held);
}

void SimulationPanel::displayState(const SimulationState& state) {
  plug_->setText(state.pluggedIn ? tr("Unplug") : tr("Plug in"));
  for (const auto& [box, last] : {std::pair{area_, std::max(0, state.areas - 1)},
                                  {openRow_, state.rowWires - 1},
                                  {openColumn_, state.columnWires - 1}}) {
    const QSignalBlocker quiet(box);
    box->setMaximum(last);
  }
  fields_.display(fields_.settings());
  const bool moving = fields_.settings().simulation.moving;
  const QString words = state.solving               ? tr("Solving the project's design...")
                        : state.ownDesign && moving ? tr("Simulates a sphere that moves over the project's design.")
                        : state.ownDesign           ? tr("Simulates the project's design.")
                        : moving                    ? tr("The moving indenter is not solved yet.")
                                                    : tr("Simulates the paper's design, not the project's.");
  if (design_->text() != words) design_->setText(words);
  simulate_->setEnabled(!state.ownDesign && !state.solving);
}

} // namespace palp
