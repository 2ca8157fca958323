#include "app/scenes/charts/SvgCanvas.h"

#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace palp {

namespace {

std::string hexOf(const double* color) {
  std::array<char, 8> text{};
  const auto part = [&](int k) { return static_cast<unsigned>(std::lround(255 * std::clamp(color[k], 0.0, 1.0))); };
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", part(0), part(1), part(2));
  return text.data();
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return safe;
}

bool isBold(const vtkTextProperty& text) {
  auto& style = const_cast<vtkTextProperty&>(text); // VTK has no const; it is only read
  const char* file = style.GetFontFile();
  return style.GetBold() != 0 || (file != nullptr && std::string(file).find("Bold") != std::string::npos);
}

} // namespace

void SvgCanvas::fill(double left, double bottom, double right, double top, const Color& color) {
  const double x = std::round(std::max(left, 0.0)), y = std::round(std::max(bottom, 0.0));
  const double width = std::round(std::min<double>(right, this->width())) - x;
  const double high = std::round(std::min<double>(top, height())) - y;
  if (!(width > 0) || !(high > 0)) return;
  drawn_ << "<rect x=\"" << x << "\" y=\"" << height() - y - high << "\" width=\"" << width << "\" height=\"" << high
         << "\" fill=\"" << hexOf(color.data()) << "\"/>\n";
}

/// Text drawn by the viewer at about the same position: SVG's baseline replaces VTK's three heights.
void SvgCanvas::words(double x, double y, const std::string& text) {
  vtkTextProperty& style = textStyle();
  constexpr std::array<const char*, 3> kAnchors{"start", "middle", "end"};
  constexpr std::array<double, 3> kBaselines{0, 0.36, 0.76}; // of the letters' size: bottom, centre, top
  const double down = kBaselines[static_cast<std::size_t>(std::clamp(style.GetVerticalJustification(), 0, 2))];
  const double size = style.GetFontSize();
  drawn_ << "<text transform=\"translate(" << x << ' ' << height() - y << ")";
  if (style.GetOrientation() != 0) drawn_ << " rotate(" << -style.GetOrientation() << ")";
  drawn_ << "\" dy=\"" << down * size << "\" font-size=\"" << size << "\" text-anchor=\""
         << kAnchors[static_cast<std::size_t>(std::clamp(style.GetJustification(), 0, 2))] << "\" fill=\""
         << hexOf(style.GetColor()) << '"' << (isBold(style) ? " font-weight=\"bold\"" : "") << '>' << escaped(text)
         << "</text>\n";
}

std::string SvgCanvas::svg() const {
  std::ostringstream all;
  all << R"(<?xml version="1.0" encoding="UTF-8"?>)"
      << "\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width() << "\" height=\"" << height()
      << "\" viewBox=\"0 0 " << width() << ' ' << height()
      << "\" font-family=\"DejaVu Sans, sans-serif\" shape-rendering=\"crispEdges\">\n"
      << drawn_.str() << "</svg>\n";
  return all.str();
}

} // namespace palp
