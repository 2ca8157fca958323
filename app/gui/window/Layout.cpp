#include "app/gui/window/Layout.h"

#include <QSettings>
#include <QSplitter>
#include <QTabWidget>

namespace palp {

namespace {

QString key(const QObject& widget) {
  return "layout/" + widget.objectName();
}

} // namespace

void saveLayout(const QWidget& root) {
  QSettings settings;
  for (const auto* splitter : root.findChildren<QSplitter*>())
    if (!splitter->objectName().isEmpty()) settings.setValue(key(*splitter), splitter->saveState());
  for (const auto* tabs : root.findChildren<QTabWidget*>())
    if (!tabs->objectName().isEmpty()) settings.setValue(key(*tabs), tabs->currentIndex());
}

void restoreLayout(QWidget& root) {
  const QSettings settings;
  for (auto* splitter : root.findChildren<QSplitter*>())
    if (settings.contains(key(*splitter))) splitter->restoreState(settings.value(key(*splitter)).toByteArray());
  for (auto* tabs : root.findChildren<QTabWidget*>())
    if (settings.contains(key(*tabs))) tabs->setCurrentIndex(settings.value(key(*tabs)).toInt());
}

} // namespace palp
