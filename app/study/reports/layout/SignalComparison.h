#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace palp {

/// d ln R / dF [1/N], row-wires x column-wires for Fx, Fy, Fz; one an area.
using LogSensitivity = std::vector<std::array<Eigen::MatrixXd, 3>>;

/// One law's signals compared with another's, over all readings and areas, for Fx, Fy, Fz.
struct SignalComparison {
  Eigen::Vector3d factor; ///< root mean square over that of the other
  Eigen::Vector3d correlation;
};

SignalComparison comparedWith(const LogSensitivity& other, const LogSensitivity& own);

} // namespace palp
