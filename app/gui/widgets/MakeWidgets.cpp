#include "app/gui/widgets/MakeWidgets.h"

#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/widgets/WrappedLabel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QPushButton>

namespace palp {

namespace {

template <class Widget>
Widget* named(Widget* widget, const QString& id, const QString& tip = {}, const QString& spoken = {}) {
  widget->setObjectName(id);
  if (!tip.isEmpty()) widget->setToolTip(tip);
  if (!spoken.isEmpty()) widget->setAccessibleName(spoken);
  return widget;
}

template <class Box, class Form> Box* formed(Box* box, const Form& form) {
  box->setRange(form.low, form.high);
  box->setSuffix(form.unit);
  box->setSpecialValueText(form.special);
  box->setKeyboardTracking(form.whileTyping);
  return box;
}

template <class Label> Label* styled(Label* label, const QString& id, const char* role) {
  if (role != nullptr) label->setProperty("role", role);
  label->setWordWrap(true);
  return named(label, id);
}

} // namespace

NumberBox* numberBox(const QString& id, const NumberForm& form, const QString& tip, const QString& spoken) {
  auto* box = named(new NumberBox, id, tip, spoken);
  box->setDecimals(form.decimals);
  box->setSingleStep(form.step);
  return formed(box, form);
}

RatioBox* percentBox(const QString& id, double high, const QString& tip) {
  auto* box = named(new RatioBox(100, "%"), id, tip);
  box->setDecimals(8);
  box->setRange(0, high);
  box->setKeyboardTracking(false);
  return box;
}

WholeBox* wholeBox(const QString& id, const WholeForm& form, const QString& tip, const QString& spoken) {
  return formed(named(new WholeBox, id, tip, spoken), form);
}

QComboBox* choiceBox(const QString& id, const QStringList& choices, const QString& tip, const QString& spoken) {
  auto* box = named(new QComboBox, id, tip, spoken);
  box->addItems(choices);
  return box;
}

QCheckBox* checkBox(const QString& text, const QString& id, const QString& tip) {
  return named(new QCheckBox(text), id, tip);
}

QPushButton* pushButton(const QString& text, const QString& id, const QString& tip) {
  return named(new QPushButton(text), id, tip);
}

QLineEdit* lineEdit(const QString& id, const QString& tip, const QString& spoken) {
  return named(new QLineEdit, id, tip, spoken);
}

QLabel* textLabel(const QString& id, const char* role, const QString& text) {
  return styled(new QLabel(text), id, role);
}

WrappedLabel* wrappedLabel(const QString& id, const char* role, const QString& text) {
  return styled(new WrappedLabel(text), id, role);
}

void addTo(QBoxLayout& layout, std::initializer_list<Part> parts) {
  for (const Part& part : parts)
    if (part.widget != nullptr)
      layout.addWidget(part.widget, part.stretchFactor);
    else if (part.layout != nullptr)
      layout.addLayout(part.layout, part.stretchFactor);
    else
      layout.addStretch(part.stretchFactor);
}

QHBoxLayout* inRow(std::initializer_list<Part> parts) {
  auto* row = new QHBoxLayout;
  addTo(*row, parts);
  return row;
}

QVBoxLayout* inColumn(std::initializer_list<Part> parts) {
  auto* column = new QVBoxLayout;
  addTo(*column, parts);
  return column;
}

} // namespace palp
