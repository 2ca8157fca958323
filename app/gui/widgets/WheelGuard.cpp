#include "app/gui/widgets/WheelGuard.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QScrollBar>

namespace palp {

namespace {

/// Its value would follow the wheel.
bool turnsWithTheWheel(const QObject& object) {
  if (qobject_cast<const QScrollBar*>(&object) != nullptr) return false;
  return qobject_cast<const QAbstractSpinBox*>(&object) != nullptr ||
         qobject_cast<const QComboBox*>(&object) != nullptr || qobject_cast<const QAbstractSlider*>(&object) != nullptr;
}

} // namespace

WheelGuard::WheelGuard(QObject* parent) : QObject(parent) {
  qApp->installEventFilter(this);
}

bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
  const bool wheel = event->type() == QEvent::Wheel;
  if ((!wheel && event->type() != QEvent::Polish) || !turnsWithTheWheel(*watched)) return false;
  auto& box = static_cast<QWidget&>(*watched);
  if (!wheel) {
    if (box.focusPolicy() == Qt::WheelFocus) box.setFocusPolicy(Qt::StrongFocus); // turning it would focus it first
    return false;
  }
  const QWidget* focused = QApplication::focusWidget();
  if (focused != nullptr && (focused == &box || box.isAncestorOf(focused))) return false;
  event->ignore(); // goes on to the panel
  return true;
}

} // namespace palp
