#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>

namespace palp {

/// Relative noise of R, the x axis of the noise reports of both resistance laws.
inline constexpr std::array kNoises{1e-7, 1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 1e-2};
inline constexpr double kShownNoise = 1e-4; ///< of the tables
inline constexpr double kDrawnUpTo_percent =
    300; ///< ten times predicting the mean: more would compress the other curves
inline constexpr std::array<const char*, 3> kForceNames{"Fx", "Fy", "Fz"};

/// Relative noise of rounding to `bits` where R is at full scale; bits that round to a relative noise.
inline double noiseOfBits(double bits) {
  return std::exp2(-bits) / std::sqrt(12.0);
}
inline double bitsOfNoise(double noise) {
  return -std::log2(noise * std::sqrt(12.0));
}

inline double rootMeanSquare(const Eigen::Vector3d& values) {
  return values.norm() / std::sqrt(3.0);
}

} // namespace palp
