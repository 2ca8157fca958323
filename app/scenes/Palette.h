#pragma once

#include "model/base/NamedEnum.h"

#include <array>

namespace palp {

/// The ground; everything drawn is readable on each. Contrast: bright on black, for weak eyes and bad screens.
enum class Theme { Light, Dark, Contrast };
inline constexpr NamedEnum kThemes("theme", std::array{std::pair{Theme::Light, "light"}, std::pair{Theme::Dark, "dark"},
                                                       std::pair{Theme::Contrast, "contrast"}});

using Color = std::array<double, 3>; ///< red, green, blue in 0..1

/// The colours of a theme that represent no value.
struct Palette {
  Color ground;    ///< background
  Color text;      ///< axes, titles, legends
  Color grid;      ///< faint lines
  Color upper;     ///< row-wires and their electrodes
  Color lower;     ///< column-wires and their electrodes
  Color force;     ///< force arrows
  Color selection; ///< what was chosen or pointed at
};

const Palette& palette(Theme theme);

/// Colour of the k-th series of a chart: Okabe and Ito's set, distinct for the colour-blind, set for the ground.
Color seriesColor(int k, Theme theme);

} // namespace palp
