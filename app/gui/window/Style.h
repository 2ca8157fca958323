#pragma once

#include "app/scenes/Palette.h"

class QApplication;

namespace palp {

constexpr int kSmallestText_percent = 70;
constexpr int kLargestText_percent = 200;

/// Gives the program's widgets the colours of a theme, and all text the size that the user's settings have.
void applyTheme(QApplication& application, Theme theme);

/// Of the desktop's own size of text, in the user's settings.
int textPercent();
void setTextPercent(int percent);

} // namespace palp
