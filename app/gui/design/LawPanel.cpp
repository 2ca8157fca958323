#include "app/gui/design/LawPanel.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/widgets/WrappedLabel.h"

#include <QCheckBox>
#include <QFormLayout>
#include <QLineEdit>

namespace palp {

namespace {

/// What the circuit of a read-out does, as in the tip of its choice.
QString circuitWords(const SensorDesign& design) {
  const FieldLaw* field = design.field();
  if (field == nullptr) return {};
  return designField("resistance.readout").choices[static_cast<std::size_t>(field->readout)].tip + ".";
}

} // namespace

LawPanel::LawPanel(QWidget* parent) : QGroupBox(resistanceGroup(), parent) {
  auto* form = new QFormLayout(this);
  readoutWords_ = wrappedLabel("readoutWords", "hint");
  warning_ = wrappedLabel("lawWarning");
  warning_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  for (WrappedLabel* label : {readoutWords_, warning_}) label->hide();
  for (const DesignField& field : designFields()) {
    if (field.group != resistanceGroup()) continue;
    const QString what = tr("Change %1").arg((field.group + " " + field.label).toLower());
    rows_.add(field, *form, [this, what] {
      if (!displaying_) emit edited(what);
    });
    if (field.key == "resistance.electrode_radius_mm") form->addRow(warning_);
    if (field.key == "resistance.readout") form->addRow(readoutWords_);
  }
  buildPressureLaw(*form);
  SensorDesign standard = paperDesign();
  standard.resistance = FieldLaw{};
  display(standard); // what the rows begin with
  display(paperDesign());
}

void LawPanel::buildPressureLaw(QFormLayout& form) {
  pressureLaw_ =
      checkBox(tr("Resistivity falls with pressure (Fig. 1)"), "pressureLaw",
               tr("g(p) = g (1 + max(p, 0) / p0)^(-n). The initial values are assumed, as the figure prints none."));
  form.addRow(pressureLaw_);
  p0_ = new QLineEdit;
  p0_->setObjectName("p0");
  exponent_ = new QLineEdit;
  exponent_->setObjectName("exponent");
  form.addRow(tr("p0 [MPa]"), p0_);
  form.addRow(tr("n"), exponent_);
  pressureProblem_ = problemLabel();
  form.addRow(pressureProblem_);
  const auto changed = [this] {
    if (!displaying_) emit edited(tr("Change the pressure law"));
  };
  connect(pressureLaw_, &QCheckBox::toggled, this, changed);
  for (QLineEdit* edit : {p0_, exponent_}) connect(edit, &QLineEdit::textEdited, this, changed);
}

void LawPanel::display(const SensorDesign& design) {
  displaying_ = true;
  rows_.display(design);
  pressureLaw_->setChecked(design.pressureLaw.has_value());
  const PressureLaw law = design.pressureLaw.value_or(PressureLaw{});
  for (auto [edit, value] : {std::pair{p0_, law.p0_MPa}, std::pair{exponent_, law.exponent}}) {
    if (typedNumber(edit->text()) != value) edit->setText(QString::number(value));
    edit->setEnabled(design.pressureLaw.has_value());
  }
  pressureProblem_->say({});
  follow(design);
  warn(design);
  displaying_ = false;
}

bool LawPanel::read(SensorDesign& design) {
  bool good = rows_.read(design);
  follow(design); // also where it cannot be applied: the message is in one of these rows
  design.pressureLaw.reset();
  pressureWrong_.clear();
  if (!pressureLaw_->isChecked()) return good;
  if (!p0_->isEnabled()) { // just switched on
    design.pressureLaw = PressureLaw{};
    return good;
  }
  PressureLaw& law = design.pressureLaw.emplace();
  for (auto [edit, value] : {std::pair{p0_, &law.p0_MPa}, std::pair{exponent_, &law.exponent}}) {
    const auto number = typedNumber(edit->text());
    *value = number.value_or(0);
    if (!number) pressureWrong_ = tr("\"%1\" is not a number; use a decimal point, for example 0.5").arg(edit->text());
  }
  return good && pressureWrong_.isEmpty();
}

void LawPanel::say(const std::vector<DesignFault>& faults, const SensorDesign& inUse, bool applied) {
  rows_.say(faults, inUse, applied);
  QString sentence = pressureWrong_;
  for (const DesignFault& fault : faults)
    if (fault.key.starts_with("resistance.pressure_law")) sentence = QString::fromStdString(fault.sentence);
  pressureProblem_->say(sentence);
  if (applied)
    warn(inUse);
  else
    warning_->say({});
}

void LawPanel::follow(const SensorDesign& design) {
  rows_.showThoseOf(design);
  readoutWords_->say(circuitWords(design));
}

void LawPanel::warn(const SensorDesign& design) {
  if (warnedOf_ != design) { // of all pairs of electrodes: once a design
    const std::vector<std::string> warnings = designWarnings(design);
    // It is shown under its field, so the key is not needed.
    warned_ = warnings.empty() ? QString() : tr("Note: %1.").arg(QString::fromStdString(warnings[0]).section(": ", 1));
    warnedOf_ = design;
  }
  warning_->say(warned_);
}

} // namespace palp
