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

/// A line of resources/converged.csv: a solution of the paper's block by another program (hexahedra of high order on a
/// graded mesh), for the ten electrodes of row-wire 4.
struct PublishedSolution {
  std::string name;
  int area = 0;
  Eigen::Vector3d force_N;
  int unknowns = 0;
  double statedError = 0;            ///< relative L2, from the change of order
  Eigen::Matrix3Xd displacements_mm; ///< 3 x electrodes
};

std::vector<PublishedSolution> publishedSolutions();

} // namespace palp
