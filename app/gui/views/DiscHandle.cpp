#include "app/gui/views/DiscHandle.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

double tenth(double value) {
  return std::round(10 * value) / 10;
}

} // namespace

PatchLoad insideFace(PatchLoad disc, const Eigen::Vector3d& block_mm) {
  const double largest = 0.5 * block_mm.head<2>().minCoeff();
  disc.radius_mm = std::clamp(disc.radius_mm, std::min(kSmallestDisc_mm, largest), largest);
  for (int d = 0; d < 2; ++d) {
    disc.centre_mm[d] = std::clamp(disc.centre_mm[d], disc.radius_mm, block_mm[d] - disc.radius_mm);
    while (disc.centre_mm[d] + disc.radius_mm > block_mm[d]) // rounding
      disc.radius_mm = std::nextafter(disc.radius_mm, 0.0);
  }
  return disc;
}

PatchLoad overFace(PatchLoad disc, const Eigen::Vector3d& block_mm) {
  disc.radius_mm = std::max(disc.radius_mm, kSmallestDisc_mm);
  disc.centre_mm = disc.centre_mm.cwiseMax(0).cwiseMin(block_mm.head<2>());
  return disc;
}

bool DiscHandle::take(const std::vector<PatchLoad>& discs, const Eigen::Vector2d& at_mm, double tolerance_mm) {
  disc_ = -1;
  for (std::size_t k = discs.size(); k-- > 0 && disc_ < 0;) {
    const double off = (at_mm - discs[k].centre_mm).norm() - discs[k].radius_mm;
    if (off > tolerance_mm) continue;
    disc_ = static_cast<int>(k);
    // The middle of a small disc moves it all the same.
    rim_ = std::abs(off) <= std::min(tolerance_mm, 0.5 * discs[k].radius_mm);
    held_ = discs[k];
    from_mm_ = at_mm;
  }
  return disc_ >= 0;
}

PatchLoad DiscHandle::draggedTo(const Eigen::Vector2d& at_mm, const Eigen::Vector3d& block_mm, bool inside) const {
  if (at_mm == from_mm_) return held_;
  PatchLoad next = held_;
  if (rim_) {
    const double change = (at_mm - held_.centre_mm).norm() - (from_mm_ - held_.centre_mm).norm();
    // A rim grows no further than to the nearest edge: the centre stays.
    const double room = std::min(held_.centre_mm.minCoeff(), (block_mm.head<2>() - held_.centre_mm).minCoeff());
    next.radius_mm = tenth(held_.radius_mm + change);
    if (inside) next.radius_mm = std::min(next.radius_mm, room);
  } else {
    next.centre_mm += at_mm - from_mm_;
    next.centre_mm = {tenth(next.centre_mm.x()), tenth(next.centre_mm.y())};
  }
  return inside ? insideFace(next, block_mm) : overFace(next, block_mm);
}

} // namespace palp
