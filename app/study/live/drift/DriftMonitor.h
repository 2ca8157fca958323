#pragma once

#include <Eigen/Core>

#include <optional>

namespace palp {

/// How far all readings together have gone since rest, while the sensor is left alone: warming rubber changes them by
/// one factor, a touch never does.
class DriftMonitor {
public:
  /// R / R at rest - 1 of a frame (NaN where a reading is not good), and the relative noise of a reading.
  void add(const Eigen::MatrixXd& change, double noise, double time_s);
  void restart();
  /// Relative; none before the sensor was seen at rest.
  [[nodiscard]] std::optional<double> drift() const { return drift_; }

private:
  std::optional<double> drift_;
  double last_s_ = 0;
};

} // namespace palp
