#include "app/gui/window/Style.h"

#include <QApplication>
#include <QFile>
#include <QPalette>
#include <QStyleFactory>

namespace palp {

namespace {

QPalette widgetColors(Theme theme) {
  const bool light = theme == Theme::Light;
  QPalette colors;
  const QColor window = light ? QColor(0xf3f4f6) : QColor(0x25282d);
  const QColor base = light ? QColor(0xffffff) : QColor(0x343a42);
  const QColor text = light ? QColor(0x20242a) : QColor(0xe6e8eb);
  const QColor accent = light ? QColor(0x0a6ebd) : QColor(0x3d9be0);
  for (const auto group : {QPalette::Active, QPalette::Inactive, QPalette::Disabled}) {
    const bool disabled = group == QPalette::Disabled;
    const QColor ink = disabled ? (light ? QColor(0x9aa0a8) : QColor(0x757b84)) : text;
    colors.setColor(group, QPalette::Window, window);
    colors.setColor(group, QPalette::Base, base);
    colors.setColor(group, QPalette::AlternateBase, light ? QColor(0xf7f8fa) : QColor(0x22252a));
    colors.setColor(group, QPalette::Button, light ? QColor(0xe9ebee) : QColor(0x32363c));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
      colors.setColor(group, role, ink);
    colors.setColor(group, QPalette::Light, light ? QColor(0xffffff) : QColor(0x4a515b));
    colors.setColor(group, QPalette::Mid, light ? QColor(0xb9bec6) : QColor(0x4a515b));
    colors.setColor(group, QPalette::Dark, light ? QColor(0x9aa0a8) : QColor(0x15171a));
    colors.setColor(group, QPalette::PlaceholderText, light ? QColor(0x8a9099) : QColor(0x858b94));
    colors.setColor(group, QPalette::Highlight, disabled ? QColor(0x808890) : accent);
    colors.setColor(group, QPalette::HighlightedText, Qt::white);
    colors.setColor(group, QPalette::ToolTipBase, light ? QColor(0xfffff0) : QColor(0x3a3f47));
    colors.setColor(group, QPalette::ToolTipText, text);
    colors.setColor(group, QPalette::Link, accent);
  }
  return colors;
}

} // namespace

void applyTheme(QApplication& application, Theme theme) {
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  QApplication::setPalette(widgetColors(theme));
  QFile sheet(":/style/palp.qss");
  if (sheet.open(QIODevice::ReadOnly)) application.setStyleSheet(QString::fromUtf8(sheet.readAll()));
}

} // namespace palp
