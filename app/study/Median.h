#pragma once

#include <Eigen/Core>

#include <vector>

namespace palp {

/// The middle value, of an even count the mean of the two in the middle; at least one value is needed.
double median(std::vector<double> values);
/// Axis by axis.
Eigen::Vector3d median(const std::vector<Eigen::Vector3d>& values);

} // namespace palp
