#pragma once

#include "app/study/live/SimulatedTouch.h"

#include <memory>

namespace palp {

/// An indenter without friction that presses anywhere on the simulated board: the resistances that the solver gives for
/// touches of one size, by a spline through solved samples over place and force (J. Duchon, Splines minimizing
/// rotation-invariant semi-norms in Sobolev spaces, 1977: r^3 with a linear part), so that nothing is solved while the
/// board is simulated.
class MovingTouch {
public:
  /// Samples of touches of one size that press straight down, or one of them not at all: without that, rest is found
  /// from the others. Throws Error where they are others.
  explicit MovingTouch(const SampleSet& touches);

  /// The touch at a time: it wanders over the rectangle of the samples, comes down and goes up once in `kPress_s`, and
  /// rests in the first `kRest_s` of that (time to tare).
  [[nodiscard]] SimulatedTouch::Truth truth(double time_s) const;
  /// Row-wires x column-wires [ohm]. A place outside of the samples' rectangle is taken at its border, a press below
  /// zero as none, one beyond twice the samples' as that.
  [[nodiscard]] Eigen::MatrixXd resistances_ohm(const SimulatedTouch::Truth& truth) const;
  /// Lets a hand hold the touch from now on, and gives it the touch.
  void follow(std::shared_ptr<TouchHand> hand) { hand_ = std::move(hand); }
  /// For Board: valid until the next call.
  const Eigen::MatrixXd& at(double time_s);

  static constexpr double kPress_s = 3, kRest_s = 1;

private:
  [[nodiscard]] Eigen::Vector3d scaled(const Eigen::Vector2d& place_mm, double press_N) const;

  int rowWires_ = 0;
  int columnWires_ = 0;
  Eigen::Vector2d low_mm_, high_mm_; ///< of the samples' places
  double most_N_ = 0;                ///< that they press
  Eigen::VectorXd rest_ohm_;
  Eigen::Matrix3Xd nodes_;  ///< scaled place and press of each sample
  Eigen::MatrixXd weights_; ///< readings x (samples, then 1 and the three): of d ln R / press
  Eigen::MatrixXd now_ohm_;
  std::shared_ptr<TouchHand> hand_; ///< null: none
};

} // namespace palp
