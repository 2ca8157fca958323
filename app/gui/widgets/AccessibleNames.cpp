#include "app/gui/widgets/AccessibleNames.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QComboBox>
#include <QLineEdit>
#include <QRegularExpression>

namespace palp {

namespace {

bool isControl(const QWidget& widget) {
  return qobject_cast<const QAbstractButton*>(&widget) != nullptr ||
         qobject_cast<const QAbstractSpinBox*>(&widget) != nullptr ||
         qobject_cast<const QComboBox*>(&widget) != nullptr || qobject_cast<const QLineEdit*>(&widget) != nullptr ||
         qobject_cast<const QAbstractSlider*>(&widget) != nullptr ||
         qobject_cast<const QAbstractItemView*>(&widget) != nullptr;
}

/// "sweepFrom": "sweep from".
QString words(QString name) {
  static const QRegularExpression capital("([A-Z])");
  return name.replace(capital, " \\1").toLower();
}

} // namespace

void nameControls(const QWidget& root) {
  for (auto* widget : root.findChildren<QWidget*>()) {
    if (!isControl(*widget) || !widget->accessibleName().isEmpty()) continue;
    const QAccessibleInterface* seen = QAccessible::queryAccessibleInterface(widget);
    if (seen != nullptr && !seen->text(QAccessible::Name).isEmpty()) continue; // its text, or its label's
    widget->setAccessibleName(widget->toolTip().isEmpty() ? words(widget->objectName()) : widget->toolTip());
  }
}

} // namespace palp
