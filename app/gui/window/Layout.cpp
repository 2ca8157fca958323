#include "app/gui/window/Layout.h"

#include "app/gui/window/Scene.h"
#include "app/gui/window/SidePanel.h"

#include <QSettings>
#include <QSplitter>
#include <QTabWidget>

#include <algorithm>

namespace palp {

namespace {

// Of a usual window's frame: the true one is unknown before the window is shown.
constexpr int kBorder_px = 4;
constexpr int kTitle_px = 32;

QString key(const QObject& widget) {
  return "layout/" + widget.objectName();
}

/// By the scene that the panel belongs to.
QString key(const SidePanel& panel) {
  const QWidget* place = panel.parentWidget();
  while (place != nullptr && dynamic_cast<const Scene*>(place) == nullptr) place = place->parentWidget();
  return "layout/folded-" + (place == nullptr ? panel.objectName() : place->objectName());
}

} // namespace

void saveLayout(const QWidget& root) {
  QSettings settings;
  for (const auto* splitter : root.findChildren<QSplitter*>())
    if (!splitter->objectName().isEmpty()) settings.setValue(key(*splitter), splitter->saveState());
  for (const auto* tabs : root.findChildren<QTabWidget*>())
    if (!tabs->objectName().isEmpty()) settings.setValue(key(*tabs), tabs->currentIndex());
  for (const auto* panel : root.findChildren<SidePanel*>()) settings.setValue(key(*panel), panel->foldedByHand());
}

void restoreLayout(QWidget& root) {
  const QSettings settings;
  for (auto* splitter : root.findChildren<QSplitter*>())
    if (settings.contains(key(*splitter))) splitter->restoreState(settings.value(key(*splitter)).toByteArray());
  for (auto* tabs : root.findChildren<QTabWidget*>())
    if (settings.contains(key(*tabs))) tabs->setCurrentIndex(settings.value(key(*tabs)).toInt());
  for (auto* panel : root.findChildren<SidePanel*>()) panel->setFolded(settings.value(key(*panel)).toBool());
}

void fitToScreen(QWidget& window, const QRect& room) {
  const QRect inner = room.adjusted(kBorder_px, kTitle_px, -kBorder_px, -kBorder_px);
  window.resize(window.size().boundedTo(inner.size()));
  const QSize size = window.size();
  const auto between = [](int low, int value, int high) { return std::max(low, std::min(value, high)); };
  window.setGeometry(between(inner.left(), window.geometry().left(), inner.right() + 1 - size.width()),
                     between(inner.top(), window.geometry().top(), inner.bottom() + 1 - size.height()), size.width(),
                     size.height());
}

} // namespace palp
