#pragma once

#include "nn/NetworkError.h"

#include <Eigen/Core>

#include <string>

namespace palp {

/// Throws NetworkError where no input (inputs x samples) varies, to rounding: nothing can be learned from it.
inline void requireVarying(const Eigen::Ref<const Eigen::MatrixXd>& samples) {
  constexpr double rounding = 1e-14;
  const Eigen::ArrayXd low = samples.rowwise().minCoeff(), high = samples.rowwise().maxCoeff();
  if (samples.cols() < 2 || !(high - low > rounding * low.abs().max(high.abs())).any())
    throw NetworkError("the readings do not vary over the " + std::to_string(samples.cols()) +
                       (samples.cols() == 1 ? " sample" : " samples") +
                       "; check that the sensor is connected; expected samples under different forces");
}

} // namespace palp
