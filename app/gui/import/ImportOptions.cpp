#include "app/gui/import/ImportOptions.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QScopedValueRollback>
#include <QStackedWidget>

#include <algorithm>

namespace palp {

namespace {

constexpr double kLargestOhm = 1e12;
constexpr int kMostImportedAreas = 2500, kMostImportedWires = 255;

/// The pages of the fields of each kind, in the order of ReadingKind.
constexpr std::array kLawPage{0, 1, 2, 3, 3};

/// The units of a quantity below that of the table, which is empty.
QComboBox* unitBox(const QString& id, const std::vector<std::string>& units, const QString& tip) {
  QComboBox* box = choiceBox(id, {QObject::tr("as the table states")}, tip);
  for (const std::string& unit : units) box->addItem(QString::fromStdString(unit), QString::fromStdString(unit));
  return box;
}

void showUnit(QComboBox& box, const std::string& unit) {
  box.setCurrentIndex(std::max(0, box.findData(QString::fromStdString(unit))));
}

std::string unitIn(const QComboBox& box) {
  return box.currentData().toString().toStdString();
}

QWidget* page(std::initializer_list<Part> parts) {
  auto* page = new QWidget;
  auto* row = new QHBoxLayout(page);
  row->setContentsMargins(0, 0, 0, 0);
  addTo(*row, parts);
  row->addStretch(1);
  return page;
}

QLabel* labelled(const QString& words, QWidget* box) {
  auto* label = new QLabel(words);
  label->setBuddy(box);
  return label;
}

} // namespace

ImportOptions::ImportOptions(QWidget* parent) : QWidget(parent) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  form->addRow(tr("Readings"), readingsRow());
  form->addRow(tr("Forces"), forcesRow());
  form->addRow(tr("Others"), othersRow());
  const auto changed = [this] { read(); };
  for (auto* box : findChildren<QComboBox*>()) connect(box, &QComboBox::currentIndexChanged, this, changed);
  for (auto* box : findChildren<QDoubleSpinBox*>()) connect(box, &QDoubleSpinBox::valueChanged, this, changed);
  for (auto* box : findChildren<QSpinBox*>()) connect(box, &QSpinBox::valueChanged, this, changed);
  for (auto* box : findChildren<QCheckBox*>()) connect(box, &QCheckBox::toggled, this, changed);
  connect(signalUnit_, &QLineEdit::editingFinished, this, changed);
}

QLayout* ImportOptions::readingsRow() {
  kind_ = choiceBox("readingKind",
                    {tr("Signals"), tr("Resistances or conductances"), tr("Codes proportional to ohm"),
                     tr("Divider, voltage across the sensor"), tr("Divider, voltage across the resistor")},
                    tr("Signals (volts, codes, microtesla) may have any sign: the network uses their differences from "
                       "rest. Of resistances it uses ratios."));
  signalUnit_ = lineEdit("signalUnit", tr("Unit of the signals, any text; for labels only"), tr("Unit of the signals"));
  signalUnit_->setMaximumWidth(90);
  resistanceUnit_ = unitBox("resistanceUnit", resistanceUnits(), tr("Unit of the resistances or conductances"));
  const auto number = [](const char* id, double low, const QString& unit, const QString& tip) {
    return numberBox(id, {.low = low, .high = kLargestOhm, .decimals = 6, .unit = unit}, tip);
  };
  ohmPerCode_ = number("ohmPerCode", -kLargestOhm, tr(" ohm"), tr("Resistance of one step of the code"));
  zero_ = number("zeroOhm", -kLargestOhm, tr(" ohm"), tr("Resistance at code 0"));
  fullScale_ = number("fullScale", 1e-6, {}, tr("The reading that the supply voltage would have, as 1023 or 5"));
  resistor_ = number("resistorOhm", 1e-6, tr(" ohm"), tr("Resistance of the divider's fixed resistor"));
  law_ = new QStackedWidget; // of one size, whatever the kind
  law_->addWidget(page({labelled(tr("in"), signalUnit_), signalUnit_}));
  law_->addWidget(page({labelled(tr("in"), resistanceUnit_), resistanceUnit_}));
  law_->addWidget(page({labelled(tr("per step"), ohmPerCode_), ohmPerCode_, labelled(tr("at 0"), zero_), zero_}));
  law_->addWidget(
      page({labelled(tr("full scale"), fullScale_), fullScale_, labelled(tr("resistor"), resistor_), resistor_}));
  rowWires_ = wholeBox("importRowWires", {.low = 1, .high = kMostImportedWires},
                       tr("Row-wires of the sensor; the readings are in the order row-wire by row-wire. 1: channels "
                          "without rows and columns"));
  return inRow({kind_, law_, labelled(tr("row-wires"), rowWires_), rowWires_, Part::stretch()});
}

QLayout* ImportOptions::forcesRow() {
  forceUnit_ = unitBox("forceUnit", forceUnits(), tr("Unit of the forces"));
  constexpr std::array names{"Fx", "Fy", "Fz"};
  for (std::size_t axis = 0; axis < 3; ++axis)
    inverted_[axis] = checkBox(names[axis], QString("invert%1").arg(names[axis]),
                               tr("Turns the sign of this force. Fz must be below 0 when the sensor is pressed."));
  degrees_ = checkBox(tr("Rotation in degrees"), "rotationDegrees",
                      tr("Unit of the rotation vector of the force sensor; otherwise radians"));
  return inRow({labelled(tr("in"), forceUnit_), forceUnit_, new QLabel(tr("turn the sign of")), inverted_[0],
                inverted_[1], inverted_[2], degrees_, Part::stretch()});
}

QLayout* ImportOptions::othersRow() {
  positionUnit_ = unitBox("positionUnit", lengthUnits(), tr("Unit of the positions x and y"));
  timeUnit_ = unitBox("timeUnit", timeUnits(), tr("Unit of the times; dates need none"));
  areas_ = wholeBox("importAreas", {.low = 1, .high = kMostImportedAreas},
                    tr("Number of load areas that the column counts"));
  firstArea_ = wholeBox("importFirstArea", {.low = 0, .high = 1}, tr("Number of the first area: 0 or 1"));
  badRows_ = checkBox(tr("Leave out bad rows"), "leaveOutBadRows",
                      tr("Imports the other rows where some have words, missing values or other numbers of fields"));
  return inRow({labelled(tr("positions in"), positionUnit_), positionUnit_, labelled(tr("times in"), timeUnit_),
                timeUnit_, labelled(tr("areas"), areas_), areas_, labelled(tr("counted from"), firstArea_), firstArea_,
                badRows_, Part::stretch()});
}

bool ImportOptions::has(std::initializer_list<ColumnMeaning> meanings) const {
  return std::any_of(draft_.meanings.begin(), draft_.meanings.end(), [&](const auto& table) {
    return std::any_of(table.begin(), table.end(), [&](ColumnMeaning one) {
      return std::find(meanings.begin(), meanings.end(), one) != meanings.end();
    });
  });
}

void ImportOptions::display(const ImportDraft& draft) {
  const QScopedValueRollback quiet(displaying_, true);
  draft_ = draft;
  kind_->setCurrentIndex(static_cast<int>(draft.kind));
  law_->setCurrentIndex(kLawPage.at(static_cast<std::size_t>(draft.kind)));
  if (draft.kind == ReadingKind::Signal) signalUnit_->setText(QString::fromStdString(draft.readingUnit));
  showUnit(*resistanceUnit_, draft.kind == ReadingKind::Resistance ? draft.readingUnit : std::string());
  showExactly(*ohmPerCode_, draft.ohmPerCode);
  showExactly(*zero_, draft.zero_ohm);
  showExactly(*fullScale_, draft.fullScale);
  showExactly(*resistor_, draft.resistor_ohm);
  rowWires_->setValue(draft.rowWires);
  showUnit(*forceUnit_, draft.forceUnit);
  showUnit(*positionUnit_, draft.positionUnit);
  showUnit(*timeUnit_, draft.timeUnit);
  for (std::size_t axis = 0; axis < 3; ++axis) inverted_[axis]->setChecked(draft.inverted[axis]);
  degrees_->setChecked(draft.degrees);
  areas_->setValue(draft.areaCount);
  firstArea_->setValue(draft.firstArea);
  badRows_->setChecked(draft.leaveOutBadRows);
  const bool forces = has({ColumnMeaning::Fx, ColumnMeaning::Fy, ColumnMeaning::Fz});
  forceUnit_->setEnabled(forces);
  for (QCheckBox* box : inverted_) box->setEnabled(forces);
  degrees_->setEnabled(has({ColumnMeaning::RotationX, ColumnMeaning::RotationY, ColumnMeaning::RotationZ}));
  positionUnit_->setEnabled(has({ColumnMeaning::X, ColumnMeaning::Y}));
  timeUnit_->setEnabled(has({ColumnMeaning::Time, ColumnMeaning::ForceTime, ColumnMeaning::PositionTime}));
  for (QSpinBox* box : {areas_, firstArea_}) box->setEnabled(has({ColumnMeaning::Area}));
}

void ImportOptions::read() {
  if (displaying_) return;
  ImportDraft next = draft_;
  const auto kind = static_cast<ReadingKind>(kind_->currentIndex());
  if (kind == ReadingKind::Signal)
    next.readingUnit = kind == draft_.kind ? signalUnit_->text().toStdString() : std::string();
  else if (kind == ReadingKind::Resistance)
    next.readingUnit = unitIn(*resistanceUnit_);
  next.kind = kind;
  next.ohmPerCode = readExactly(*ohmPerCode_, draft_.ohmPerCode);
  next.zero_ohm = readExactly(*zero_, draft_.zero_ohm);
  next.fullScale = readExactly(*fullScale_, draft_.fullScale);
  next.resistor_ohm = readExactly(*resistor_, draft_.resistor_ohm);
  next.rowWires = rowWires_->value();
  next.forceUnit = unitIn(*forceUnit_);
  next.positionUnit = unitIn(*positionUnit_);
  next.timeUnit = unitIn(*timeUnit_);
  for (std::size_t axis = 0; axis < 3; ++axis) next.inverted[axis] = inverted_[axis]->isChecked();
  next.degrees = degrees_->isChecked();
  next.areaCount = areas_->value();
  next.firstArea = firstArea_->value();
  next.leaveOutBadRows = badRows_->isChecked();
  if (next != draft_) emit edited(next);
}

} // namespace palp
