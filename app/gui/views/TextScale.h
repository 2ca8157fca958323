#pragma once

#include <QFontDatabase>
#include <QFontInfo>
#include <QWidget>

namespace palp {

/// How much larger a widget's text is than the desktop's own, for what is not drawn by Qt.
inline double textScale(const QWidget& widget) {
  const QFontInfo own(widget.font()), desktop(QFontDatabase::systemFont(QFontDatabase::GeneralFont));
  return own.pointSizeF() / desktop.pointSizeF();
}

} // namespace palp
