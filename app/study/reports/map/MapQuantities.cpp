#include "app/study/reports/map/MapQuantities.h"

namespace palp {

namespace {

const Eigen::MatrixXd& smallestForce(const TouchMap& map) {
  return map.smallestForce_N;
}
const Eigen::MatrixXd& slipperyForce(const TouchMap& map) {
  return map.slipperyForce_N;
}
const Eigen::MatrixXd& slipperyPlace(const TouchMap& map) {
  return map.slipperyPlace_mm;
}
template <std::size_t axis> const Eigen::MatrixXd& heldForce(const TouchMap& map) {
  return map.heldForce_N[axis];
}
const Eigen::MatrixXd& heldPlace(const TouchMap& map) {
  return map.heldPlace_mm;
}
const Eigen::MatrixXd& twoPoint(const TouchMap& map) {
  return map.twoPoint_mm;
}

} // namespace

const std::array<MapQuantity, 8>& mapQuantities() {
  static const std::array all{MapQuantity{"smallest force seen", "N", "force", smallestForce, true},
                              MapQuantity{"Fz, no friction", "N", "fz", slipperyForce},
                              MapQuantity{"place, no friction", "mm", "place-free", slipperyPlace},
                              MapQuantity{"Fx, held", "N", "fx-held", heldForce<0>},
                              MapQuantity{"Fy, held", "N", "fy-held", heldForce<1>},
                              MapQuantity{"Fz, held", "N", "fz-held", heldForce<2>},
                              MapQuantity{"place, held", "mm", "place", heldPlace, true},
                              MapQuantity{"two-point distance", "mm", "two-point", twoPoint, true}};
  return all;
}

} // namespace palp
