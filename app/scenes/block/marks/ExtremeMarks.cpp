#include "app/scenes/block/marks/ExtremeMarks.h"

#include "model/base/NumberText.h"

namespace palp {

namespace {

std::string valueText(double value) {
  return withDigits(value, 4);
}

} // namespace

std::vector<PlacedText> extremeMarks(const std::vector<double>& values, const Eigen::Matrix3Xd& drawn_mm,
                                     const DeformationOptions& options) {
  if (values.empty() || !options.extremes) return {};
  std::ptrdiff_t low = -1, high = -1;
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(values.size()); ++k) {
    if (options.cut && !options.cut->keeps(drawn_mm.col(k))) continue;
    const double value = values[static_cast<std::size_t>(k)];
    if (low < 0 || value < values[static_cast<std::size_t>(low)]) low = k;
    if (high < 0 || value > values[static_cast<std::size_t>(high)]) high = k;
  }
  if (low < 0) return {};                                                                         // all is cut away
  if (values[static_cast<std::size_t>(low)] == values[static_cast<std::size_t>(high)]) return {}; // as at rest: nowhere
  std::vector<PlacedText> marks;
  const std::string unit = quantityUnit(options.quantity);
  const std::string of = options.cut ? "shown " : "";
  for (const auto& [node, name] : {std::pair{high, "largest "}, std::pair{low, "smallest "}})
    marks.push_back({drawn_mm.col(node),
                     name + of + valueText(values[static_cast<std::size_t>(node)]) + (unit.empty() ? "" : " " + unit),
                     palette(options.theme).text});
  return marks;
}

} // namespace palp
