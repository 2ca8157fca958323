#include "app/gui/design/WireScaling.h"

#include <cmath>

namespace palp {

namespace {

double rounded(double value) {
  return std::round(value * 1e9) / 1e9;
}

bool evenlySpaced(const std::vector<double>& places) {
  const double step = places[1] - places[0];
  for (std::size_t k = 2; k < places.size(); ++k)
    if (std::abs(places[k] - places[k - 1] - step) > 1e-9 * std::abs(step)) return false;
  return true;
}

void scale(std::vector<double>& places, double factor) {
  const bool even = places.size() > 2 && evenlySpaced(places);
  for (double& place : places) place = rounded(factor * place);
  if (!even) return;
  // Rounded separately, their spacing would differ by a digit: counted from the second, as a list with "..." is read.
  const double start = places[1], step = places[1] - places[0];
  for (std::size_t k = 2; k + 1 < places.size(); ++k) places[k] = rounded(start + static_cast<double>(k - 1) * step);
}

void scale(std::vector<std::vector<double>>& lists, double factor) {
  for (std::vector<double>& list : lists) scale(list, factor);
}

} // namespace

SensorDesign scaledTo(const SensorDesign& design, const Eigen::Vector3d& block_mm) {
  SensorDesign next = design;
  const Eigen::Vector3d factor = block_mm.cwiseQuotient(design.block_mm);
  next.block_mm = block_mm;
  scale(next.upper.wire_mm, factor.y());
  scale(next.upper.along_mm, factor.x());
  scale(next.lower.wire_mm, factor.x());
  scale(next.lower.along_mm, factor.y());
  for (ElectrodeLayer* layer : {&next.upper, &next.lower}) scale(layer->z_mm, factor.z());
  return next;
}

} // namespace palp
