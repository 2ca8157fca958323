#include "app/study/touch/TouchLoad.h"

#include "model/TouchRange.h"

#include <algorithm>

namespace palp {

namespace {

constexpr double kDiscsOfWidth = 30; // radii of the shown disc in the block's narrower side
constexpr double kHeldBy = 1.2;      // friction over what the tangential force needs
constexpr double kMostFriction = 2;

LoadCase touchAt(const Eigen::Vector2d& place_mm, const Eigen::Vector3d& force_N, const DecodedForces& forces,
                 const Decoder& decoder, const SensorDesign& design) {
  LoadCase load;
  if (std::optional<Indenter> indenter = indenterInWords(decoder.touches)) {
    if (forces.indenterSize_mm) indenter->radius_mm = std::max(*forces.indenterSize_mm, indenter->rim_mm);
    indenter->place_mm = place_mm.cwiseMax(0).cwiseMin(design.block_mm.head<2>());
    indenter->control = Press{force_N};
    const double tangential_N = force_N.head<2>().norm();
    if (tangential_N > 0) indenter->friction = std::min(kMostFriction, kHeldBy * tangential_N / std::abs(force_N.z()));
    if (!whyInvalid(*indenter, design)) {
      load.indenters.push_back(*indenter);
      return load;
    }
  }
  PatchLoad disc;
  disc.radius_mm = design.block_mm.head<2>().minCoeff() / kDiscsOfWidth;
  disc.centre_mm =
      place_mm.cwiseMax(disc.radius_mm).cwiseMin((design.block_mm.head<2>().array() - disc.radius_mm).matrix());
  disc.force_N = force_N;
  load.patches.push_back(disc);
  return load;
}

} // namespace

LoadCase loadOf(const DecodedForces& forces, const Decoder& decoder, const SensorDesign& design) {
  LoadCase load;
  if (!forces.valid) return load;
  for (Eigen::Index column = 0; column < forces.forces_N.cols(); ++column) {
    if (!forces.shown[static_cast<std::size_t>(column)]) continue;
    const Eigen::Vector3d force_N = forces.forces_N.col(column);
    if (forces.place_mm) return touchAt(*forces.place_mm, force_N, forces, decoder, design);
    const int area = forces.forces_N.cols() > 1 ? static_cast<int>(column) : forces.area.value_or(0);
    load.areas.push_back({area, force_N});
  }
  return load;
}

} // namespace palp
