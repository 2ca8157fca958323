#include "app/gui/widgets/WheelGuard.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QScrollBar>
#include <QWheelEvent>

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
  if (event->type() == QEvent::MouseButtonPress) scrolledAt_ = {-1, -1};
  const bool wheel = event->type() == QEvent::Wheel;
  if (!wheel && event->type() != QEvent::Polish) return false;
  const bool turns = turnsWithTheWheel(*watched);
  if (!wheel) {
    auto* box = turns ? static_cast<QWidget*>(watched) : nullptr;
    if (box != nullptr && box->focusPolicy() == Qt::WheelFocus)
      box->setFocusPolicy(Qt::StrongFocus); // turning it would focus it first
    return false;
  }
  if (!watched->isWidgetType()) return false; // the window of the system, before its widget
  const QPointF place = static_cast<QWheelEvent&>(*event).globalPosition();
  const QWidget* focused = QApplication::focusWidget();
  const auto* box = turns ? static_cast<QWidget*>(watched) : nullptr;
  const bool its = box != nullptr && focused != nullptr && (focused == box || box->isAncestorOf(focused));
  if (its && place != scrolledAt_) return false;
  scrolledAt_ = place;
  if (turns) event->ignore(); // passed on to the panel
  return turns;
}

} // namespace palp
