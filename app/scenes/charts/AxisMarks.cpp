#include "app/scenes/charts/AxisMarks.h"

#include "app/scenes/ColorScale.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace palp {

namespace {

constexpr int kMost = 8; ///< marks of a linear axis, and decades of a logarithmic one before some are left out

/// As short as it stays exact enough for a label.
std::string shortText(double value) {
  return withDigits(value, 6);
}

AxisMarks linearMarks(double low, double high, int most) {
  const std::vector<double> ticks = roundTicks(low, high, most);
  const std::vector<std::string> texts = tickTexts(ticks);
  AxisMarks marks;
  for (std::size_t k = 0; k < ticks.size(); ++k) marks.emplace_back(ticks[k], texts[k]);
  return marks;
}

/// Factors times every `stride`-th power of ten.
AxisMarks logMarks(double low, double high, std::span<const double> factors, int stride) {
  AxisMarks marks;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  for (int power = first; power <= static_cast<int>(std::ceil(std::log10(high))); power += stride)
    for (const double factor : factors) {
      const double tick = factor * std::pow(10, power);
      if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) marks.emplace_back(tick, shortText(tick));
    }
  return marks;
}

} // namespace

bool labelsFit(const AxisMarks& marks, double low, double high, bool logarithmic, const AxisRoom& room) {
  const auto at_px = [&](double value) {
    const double share =
        logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / std::max(high - low, 1e-300);
    return share * room.length_px;
  };
  for (std::size_t k = 1; k < marks.size(); ++k) {
    const auto letters = static_cast<double>(marks[k - 1].second.size() + marks[k].second.size());
    if (at_px(marks[k].first) - at_px(marks[k - 1].first) < room.letter_px * letters / 2 + room.gap_px) return false;
  }
  return true;
}

AxisMarks axisMarks(double low, double high, bool logarithmic, const AxisRoom& room) {
  const double decades = logarithmic ? std::log10(high / low) : 0;
  AxisMarks marks;
  if (logarithmic && decades >= 0.8) {
    constexpr std::array kFactors{1.0, 2.0, 5.0};
    if (decades <= 3) {
      marks = logMarks(low, high, kFactors, 1);
      if (labelsFit(marks, low, high, true, room)) return marks;
    }
    const int most = static_cast<int>(std::ceil(decades));
    for (int stride = std::max(1, static_cast<int>(std::ceil(decades / kMost))); stride <= most; ++stride) {
      marks = logMarks(low, high, std::span(kFactors).first(1), stride);
      if (labelsFit(marks, low, high, true, room)) return marks;
    }
    return marks;
  }
  for (int most = kMost; most > 0; --most) {
    marks = linearMarks(low, high, most);
    if (logarithmic)
      std::transform(marks.begin(), marks.end(), marks.begin(),
                     [](const auto& mark) { return std::pair(mark.first, shortText(mark.first)); });
    if (labelsFit(marks, low, high, logarithmic, room)) break;
  }
  return marks;
}

} // namespace palp
