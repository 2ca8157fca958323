#pragma once

#include <Eigen/Core>

namespace palp {

inline constexpr int contactDiscPoints = 120;

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
