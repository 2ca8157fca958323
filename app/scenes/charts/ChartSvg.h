#pragma once

#include "app/scenes/charts/Chart.h"

#include <string>

namespace palp {

/// The chart as the text of an SVG file, `width` x `height` pixels of which words and lines take `scale` times their
/// size: lines and letters as paths, so that it looks the same everywhere and at any size. Throws Error where nothing
/// can be drawn, or the folder for temporary files cannot be written to.
std::string chartSvg(const ChartSpec& spec, int width = 900, int height = 560, Theme theme = Theme::Light,
                     double scale = 1);

} // namespace palp
