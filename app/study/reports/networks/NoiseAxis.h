#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>

namespace palp {

/// What the noise reports of both resistance laws draw over: relative noise of R.
inline constexpr std::array kNoises{1e-7, 1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 1e-2};
inline constexpr double kShownNoise = 1e-4;       ///< of the tables
inline constexpr double kDrawnUpTo_percent = 300; ///< ten times knowing nothing: more would press the rest flat
inline constexpr std::array<const char*, 3> kForceNames{"Fx", "Fy", "Fz"};

inline double rootMeanSquare(const Eigen::Vector3d& values) {
  return values.norm() / std::sqrt(3.0);
}

} // namespace palp
