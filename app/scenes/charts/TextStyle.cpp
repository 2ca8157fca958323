#include "app/scenes/charts/TextStyle.h"

#include <vtkContext2D.h>
#include <vtkFreeTypeTools.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace palp {

namespace {

constexpr const char* kPlain = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr const char* kBold = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";

/// VTK keeps 30 typefaces, one a style (colour and size count), and loads one that it gave up as the style that was
/// handed to it has become by then: charts hand over one that changes from word to word. So none is given up. To be
/// called before the first text is drawn.
void keepTypefaces() {
  vtkFreeTypeTools::GetInstance()->SetMaximumNumberOfFaces(1000);
}

} // namespace

void setTextStyle(vtkTextProperty& text, const Color& color, double size_px, bool bold) {
  static const bool kept = (keepTypefaces(), true);
  static_cast<void>(kept);
  // VTK's own face draws square brackets as round ones and has no Greek.
  static const bool installed = std::filesystem::exists(kPlain) && std::filesystem::exists(kBold);
  if (installed) {
    text.SetFontFamily(VTK_FONT_FILE);
    text.SetFontFile(bold ? kBold : kPlain);
  }
  text.SetBold(!installed && bold ? 1 : 0);
  text.SetItalic(0);
  text.SetShadow(0);
  text.SetColor(color[0], color[1], color[2]);
  text.SetFontSize(static_cast<int>(std::lround(size_px)));
}

void drawText(vtkContext2D& painter, double x, double y, const std::string& text) {
  painter.DrawString(static_cast<float>(x), static_cast<float>(y), text.c_str());
}

double textWidth_px(vtkContext2D& painter, const std::string& text) {
  std::array<float, 4> bounds{}; // x, y, width, height
  painter.ComputeStringBounds(text.c_str(), bounds.data());
  return bounds[2];
}

double textWidth_px(const std::string& text, double size_px, bool bold) {
  constexpr int kDotsPerInch = 72; // of a view: a point is a pixel
  vtkNew<vtkTextProperty> style;
  setTextStyle(*style, {}, size_px, bold);
  std::array<int, 4> bounds{}; // xmin, xmax, ymin, ymax
  vtkFreeTypeTools::GetInstance()->GetBoundingBox(style, text, kDotsPerInch, bounds.data());
  return std::max(0, bounds[1] - bounds[0] + 1);
}

} // namespace palp
