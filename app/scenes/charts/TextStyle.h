#pragma once

#include "app/scenes/Palette.h"

#include <string>

class vtkContext2D;
class vtkTextProperty;

namespace palp {

/// Sets the typeface (DejaVu Sans where it is installed, else VTK's own), colour and size in pixels.
void setTextStyle(vtkTextProperty& text, const Color& color, double size_px, bool bold = false);

/// Draws the text at a place of the view [px].
void drawText(vtkContext2D& painter, double x, double y, const std::string& text);
double textWidth_px(vtkContext2D& painter, const std::string& text);
/// The same where nothing is painted yet.
double textWidth_px(const std::string& text, double size_px, bool bold = false);

} // namespace palp
