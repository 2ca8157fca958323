#pragma once

#include <Eigen/Core>

namespace palp {

/// As many as it takes: a mesh makes of the surface something quadratic with a kink at each edge, and a contact is a
/// few elements wide. 5 rings of 24 are 0.2 % of the readings off in the median and 1.3 % at worst
/// (resources/docs/numerics/touch-decoder.md).
inline constexpr int contactDiscRings = 16, contactDiscAngles = 48;
inline constexpr int contactDiscPoints = contactDiscRings * contactDiscAngles;

/// Points of a disc of radius 1 and their shares of a force on it, as Hertz's pressure or that under a flat end spreads
/// it (K. L. Johnson, Contact Mechanics, 1985, sections 3.4, 3.7, 4.2).
struct ContactDisc {
  Eigen::Matrix2Xd points{2, contactDiscPoints};
  Eigen::VectorXd flat{contactDiscPoints}, hertz{contactDiscPoints};
};
const ContactDisc& contactDisc();

/// Of the block's height: half the width of the central difference over a touch's place.
inline constexpr double placeShiftShare = 0.05;

} // namespace palp
