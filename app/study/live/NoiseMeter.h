#pragma once

#include <Eigen/Core>

#include <deque>

namespace palp {

/// Relative noise of readings while the sensor is in use: second differences over time take out rest and steady
/// motion, the median over the readings those few that a touch moves fast.
class NoiseMeter {
public:
  /// The readings of the next frame, NaN where one is missing; a frame may be missing in between.
  void add(const Eigen::VectorXd& readings_ohm);
  void restart();
  /// Enough frames have come.
  [[nodiscard]] bool ready() const { return recent_.size() >= kFewest; }
  /// rms, relative to R; 0 before the third frame.
  [[nodiscard]] double noise() const;
  /// Standard deviation of noise(), relative to it.
  [[nodiscard]] double uncertainty() const;

private:
  static constexpr std::size_t kFewest = 6;
  static constexpr std::size_t kMost = 50;

  Eigen::VectorXd before_ohm_, last_ohm_;
  std::deque<double> recent_; ///< of each frame
};

} // namespace palp
