#pragma once

#include "app/scenes/charts/Canvas.h"

#include <sstream>

namespace palp {

/// The same picture as lines of an SVG file: rectangles and letters, no pixels.
class SvgCanvas : public Canvas {
public:
  SvgCanvas(int width, int height, WrittenWords& written) : Canvas(nullptr, 0, width, height, written) {}

  void fill(double left, double bottom, double right, double top, const Color& color) override;
  void words(double x, double y, const std::string& text) override;
  /// The file's text.
  [[nodiscard]] std::string svg() const;

private:
  std::ostringstream drawn_;
};

} // namespace palp
