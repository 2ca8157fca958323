#include "app/scenes/ColorScale.h"

#include "model/base/NumberText.h"

#include <vtkLookupTable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace palp {

namespace {

constexpr Color hex(unsigned rgb) {
  return {static_cast<double>(rgb >> 16 & 255) / 255, static_cast<double>(rgb >> 8 & 255) / 255,
          static_cast<double>(rgb & 255) / 255};
}

// Equally spaced stops of matplotlib's viridis and cividis and of ColorBrewer's RdBu, blue end first.
constexpr std::array kViridis{hex(0x440154), hex(0x482878), hex(0x3e4989), hex(0x31688e), hex(0x26828e),
                              hex(0x1f9e89), hex(0x35b779), hex(0x6ece58), hex(0xb5de2b), hex(0xfde725)};
constexpr std::array kCividis{hex(0x00224e), hex(0x123570), hex(0x3b496c), hex(0x575d6d), hex(0x707173),
                              hex(0x8a8678), hex(0xa59c74), hex(0xc3b369), hex(0xe1cc55), hex(0xfee838)};
// Ten equal steps of viridisLite's inferno.
constexpr std::array kInferno{hex(0x000004), hex(0x1b0c42), hex(0x4b0c6b), hex(0x781c6d), hex(0xa52c60),
                              hex(0xcf4446), hex(0xed6925), hex(0xfb9a06), hex(0xf7d03c), hex(0xfcffa4)};
constexpr std::array kDiverging{hex(0x053061), hex(0x2166ac), hex(0x4393c3), hex(0x92c5de),
                                hex(0xd1e5f0), hex(0xf7f7f7), hex(0xfddbc7), hex(0xf4a582),
                                hex(0xd6604d), hex(0xb2182b), hex(0x67001f)};
constexpr Color kNotANumber{0.5, 0.5, 0.5};

std::span<const Color> stops(ColorMap map) {
  switch (map) {
  case ColorMap::Cividis:
    return kCividis;
  case ColorMap::Diverging:
    return kDiverging;
  case ColorMap::Inferno:
    return kInferno;
  case ColorMap::Viridis:
    break;
  }
  return kViridis;
}

/// Position of a value in the map, 0 to 1.
double shareOf(double value, const ColorScale& scale) {
  const double way = std::clamp(scale.share(value), 0.0, 1.0);
  if (scale.map != ColorMap::Diverging) return way;
  if (scale.low >= 0) return 0.5 + 0.5 * way;
  if (scale.high <= 0) return 0.5 * way;
  // Equal steps of the value look equally large on both sides of 0.
  return 0.5 + 0.5 * std::clamp(value, scale.low, scale.high) / std::max(-scale.low, scale.high);
}

} // namespace

double ColorScale::share(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

double ColorScale::at(double share) const {
  return logarithmic ? low * std::pow(high / low, share) : low + (high - low) * share;
}

Color ColorScale::color(double value) const {
  if (!std::isfinite(value)) return kNotANumber;
  const std::span<const Color> all = stops(map);
  const double place = shareOf(value, *this) * static_cast<double>(all.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), all.size() - 2);
  const double t = place - static_cast<double>(k);
  Color mixed{};
  for (std::size_t c = 0; c < 3; ++c) mixed[c] = (1 - t) * all[k][c] + t * all[k + 1][c];
  return mixed;
}

Color ColorScale::shown(double value) const {
  Color mixed = color(value);
  for (std::size_t c = 0; c < 3; ++c) mixed[c] = opacity * mixed[c] + (1 - opacity) * ground[c];
  return mixed;
}

std::string ColorScale::title() const {
  return unit.empty() ? quantity : quantity + " [" + unit + "]";
}

ColorScale fittingScale(ColorMap map, const std::vector<double>& values, std::string quantity, std::string unit) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = high = 0;
  if (map == ColorMap::Diverging) {
    high = std::max(std::abs(low), std::abs(high));
    low = -high;
  }
  // A constant field still needs a range; a share of its size keeps the legend's numbers apart.
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(high - low > 1e-12 * size)) {
    const double margin = size > 0 ? 0.05 * size : 1;
    low -= margin;
    high += margin;
  }
  return {map, low, high, std::move(quantity), std::move(unit), 1, {1, 1, 1}, false};
}

vtkSmartPointer<vtkLookupTable> lookupTable(const ColorScale& scale) {
  constexpr int kColors = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kColors);
  table->SetRange(scale.low, scale.high);
  table->SetNanColor(kNotANumber[0], kNotANumber[1], kNotANumber[2], 1);
  for (int k = 0; k < kColors; ++k) {
    const Color c = scale.color(scale.low + (scale.high - scale.low) * k / (kColors - 1));
    table->SetTableValue(k, c[0], c[1], c[2]);
  }
  return table;
}

std::vector<double> roundTicks(double low, double high, int most) {
  const double coarse = (high - low) / std::max(most, 1);
  if (!(coarse > 0) || !std::isfinite(coarse)) return {low};
  const double power = std::pow(10, std::floor(std::log10(coarse)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= coarse * (1 - 1e-9)) {
      step = factor * power;
      break;
    }
  std::vector<double> ticks;
  const double first = std::ceil(low / step - 1e-9);
  for (int k = 0; first + k <= high / step + 1e-9; ++k) ticks.push_back((first + k) * step + 0.0); // no -0
  return ticks;
}

std::vector<double> decadeTicks(double low, double high, int most) {
  std::vector<double> ticks;
  for (const auto& factors : {std::vector<double>{1, 2, 5}, {1, 3}, {1}}) {
    ticks.clear();
    for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10, power) <= high; ++power)
      for (const double factor : factors)
        if (const double tick = factor * std::pow(10, power); tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9))
          ticks.push_back(tick);
    if (static_cast<int>(ticks.size()) <= most) break;
  }
  return ticks;
}

std::vector<std::string> tickTexts(const std::vector<double>& ticks) {
  double largest = 0;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    largest = std::max(largest, std::abs(ticks[k]));
    if (k > 0) step = std::min(step, ticks[k] - ticks[k - 1]);
  }
  const bool scientific = largest >= 1e5 || (largest > 0 && largest < 1e-3);
  const double unit = scientific && largest > 0 ? std::pow(10, std::floor(std::log10(largest) + 1e-9)) : 1;
  const double fine = std::isfinite(step) ? step / unit : 1;
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(fine) - 1e-6)), 0, 12);
  std::vector<std::string> texts;
  for (const double tick : ticks)
    texts.push_back(scientific && tick != 0
                        ? withDecimals(tick / unit, decimals) + "e" + std::to_string(std::lround(std::log10(unit)))
                        : withDecimals(tick, scientific ? 0 : decimals));
  return texts;
}

} // namespace palp
