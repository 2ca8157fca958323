#pragma once

#include <QWidget>

namespace palp {

/// It moves nothing when it comes and goes.
inline void keepRoom(QWidget& widget) {
  QSizePolicy keeps = widget.sizePolicy();
  keeps.setRetainSizeWhenHidden(true);
  widget.setSizePolicy(keeps);
}

} // namespace palp
