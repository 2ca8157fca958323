#include "app/scenes/Palette.h"

namespace palp {

namespace {

constexpr Palette kLight{{1, 1, 1},         {0.13, 0.15, 0.18}, {0.86, 0.87, 0.89}, {0.80, 0.36, 0.05},
                         {0.0, 0.36, 0.62}, {0.78, 0.08, 0.22}, {0.86, 0.15, 0.50}};
constexpr Palette kDark{{0.11, 0.12, 0.14}, {0.90, 0.91, 0.93}, {0.24, 0.26, 0.29}, {0.95, 0.60, 0.25},
                        {0.38, 0.70, 0.95}, {1.0, 0.36, 0.42},  {1.0, 0.45, 0.72}};
constexpr Palette kContrast{{0, 0, 0},         {1, 1, 1},         {0.45, 0.45, 0.45}, {1.0, 0.70, 0.30},
                            {0.50, 0.80, 1.0}, {1.0, 0.45, 0.50}, {1.0, 0.83, 0.0}};

constexpr std::array<Color, 7> kSeriesOnLight{{{0.0, 0.45, 0.70},
                                               {0.84, 0.37, 0.0},
                                               {0.0, 0.56, 0.42},
                                               {0.70, 0.36, 0.56},
                                               {0.80, 0.56, 0.0},
                                               {0.20, 0.60, 0.85},
                                               {0.25, 0.25, 0.25}}};
constexpr std::array<Color, 7> kSeriesOnDark{{{0.34, 0.71, 0.91},
                                              {0.95, 0.53, 0.20},
                                              {0.20, 0.78, 0.60},
                                              {0.88, 0.58, 0.76},
                                              {0.94, 0.89, 0.26},
                                              {0.55, 0.65, 1.0},
                                              {0.85, 0.85, 0.85}}};
constexpr std::array<Color, 7> kSeriesOnBlack{{{0.40, 0.80, 1.0},
                                               {1.0, 0.62, 0.25},
                                               {0.25, 0.95, 0.70},
                                               {1.0, 0.66, 0.88},
                                               {1.0, 0.95, 0.25},
                                               {0.70, 0.76, 1.0},
                                               {1.0, 1.0, 1.0}}};

} // namespace

const Palette& palette(Theme theme) {
  if (theme == Theme::Contrast) return kContrast;
  return theme == Theme::Light ? kLight : kDark;
}

Color seriesColor(int k, Theme theme) {
  if (theme == Theme::Contrast) return kSeriesOnBlack[static_cast<std::size_t>(k) % kSeriesOnBlack.size()];
  const auto& colors = theme == Theme::Light ? kSeriesOnLight : kSeriesOnDark;
  return colors[static_cast<std::size_t>(k) % colors.size()];
}

} // namespace palp
