#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace palp {

/// A line of resources/published.csv: errors that the paper prints, by Eq. (13).
struct PublishedPoint {
  std::string figure; ///< table1 (from deformation) or fig12 (from resistance)
  double spread = 0;
  Eigen::Vector3d error_percent; ///< of Fx, Fy, Fz
};

/// The numbers that the paper prints; built into the program from resources/published.csv.
std::vector<PublishedPoint> publishedPoints(const std::string& figure);

} // namespace palp
