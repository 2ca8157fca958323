#include "app/gui/widgets/EscapeKey.h"

#include <QApplication>
#include <QKeyEvent>
#include <QShortcut>
#include <QWidget>

namespace palp {

EscapeKey::EscapeKey(QWidget* window) : QObject(window) {
  connect(new QShortcut(Qt::Key_Escape, window), &QShortcut::activated, this, &EscapeKey::pressed);
  qApp->installEventFilter(this);
}

bool EscapeKey::eventFilter(QObject* watched, QEvent* event) {
  const bool asked = event->type() == QEvent::ShortcutOverride &&
                     static_cast<const QKeyEvent&>(*event).key() == Qt::Key_Escape &&
                     QApplication::activePopupWidget() != nullptr;
  if (!asked) return QObject::eventFilter(watched, event);
  event->accept(); // the key goes to what is open
  return true;
}

} // namespace palp
