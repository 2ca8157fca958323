#pragma once

#include "app/scenes/Palette.h"

class QApplication;

namespace palp {

/// Gives the program's widgets the colours of a theme.
void applyTheme(QApplication& application, Theme theme);

} // namespace palp
