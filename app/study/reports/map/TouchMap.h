#pragma once

#include "model/SensorDesign.h"
#include "model/TouchRange.h"
#include "solver/InfluenceSurfaces.h"

#include <Eigen/Core>

#include <array>
#include <stop_token>
#include <string>

namespace palp {

/// d ln R of all readings (row-wire + row-wires * column-wire) of the design at rest by small motions, by its law and
/// read-out. `fineness` as FieldSensitivity's. Throws DesignError where the design has a pressure law, which has a kink
/// at rest, and Cancelled.
LinearReadings readingsAtRest(const SensorDesign& design, int threads, const std::stop_token& stop = {},
                              double fineness = 1);

/// Touches of one indenter over a rectangle of the top face.
struct TouchMapRequest {
  Indenter touch; ///< presses down; its place does not matter
  Eigen::Vector2d low_mm, high_mm;
  std::array<int, 2> places{2, 2}; ///< along x and y, those at the rectangle's sides included
  double relativeNoise = 1e-4;     ///< of each resistance
};

/// What a sensor resolves of a touch at each place: Cramer-Rao bounds of the linear sensor at rest, all row-wires read
/// (S. M. Kay, Fundamentals of Statistical Signal Processing: Estimation Theory, 1993, chapter 3). No estimate without
/// a bias has smaller deviations. Matrices are places along x x places along y.
struct TouchMap {
  double contactRadius_mm = 0;
  /// Straight down whose signal is 3 deviations of the noise, at a known place.
  Eigen::MatrixXd smallestForce_N;
  /// Of the indenter without friction: Fz, x and y unknown.
  Eigen::MatrixXd slipperyForce_N, slipperyPlace_mm;
  /// Of one that friction holds: Fx, Fy, Fz, x and y unknown.
  std::array<Eigen::MatrixXd, 3> heldForce_N;
  Eigen::MatrixXd heldPlace_mm;
  /// Distance at which two touches of half the force differ from every single touch of the total force by 3 deviations,
  /// without friction, along x or y, whichever is worse; not a number where along one of them no such pair lies in the
  /// rectangle.
  Eigen::MatrixXd twoPoint_mm;
};
/// Of the middle of the range's sizes and forces, over its rectangle, on its grid or, where it has none, on `places`
/// along x and y. Throws DesignError, its words beginning with `what`, where no map can be made: a shape that has no
/// place along x and y, a range that cannot be, a grid of fewer than 2 or more than 1e5 places, a pressure law.
TouchMapRequest mapRequest(const TouchRange& range, const SensorDesign& design, double relativeNoise,
                           std::array<int, 2> places, const std::string& what);

/// Deviations of a place are the root of the sum of squares of those along x and y.

/// Throws Cancelled where it was stopped.
TouchMap touchMap(const InfluenceSurfaces& surfaces, const TouchMapRequest& request, int threads,
                  const std::stop_token& stop = {});

/// Deviations of any estimate without a bias of one touch: Cramer-Rao bounds for this relative noise of each
/// resistance.
struct TouchDeviations {
  Eigen::Vector3d force_N; ///< of a touch without friction those of Fx and Fy are 0: they are known
  Eigen::Vector2d place_mm;
};
/// `bySize`: how the readings change with another unknown, here the indenter's size; empty: that is known.
TouchDeviations touchDeviations(const TouchInfluence& of, double Fz_N, bool held, double relativeNoise,
                                const Eigen::VectorXd& bySize = {});

/// Deviations of unknowns from what the readings say of each, d reading / d unknown in units of the noise: the roots of
/// the diagonal of (J' J)^-1; infinite where it is singular to rounding.
Eigen::VectorXd leastDeviations(Eigen::MatrixXd slopes);

/// Places of a map, x first: 2 x places.
Eigen::Matrix2Xd placesOf(const TouchMapRequest& request);

} // namespace palp
