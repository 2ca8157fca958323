#pragma once

#include "model/SensorDesign.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace palp {

/// Tetrahedra with straight edges, as TetGen gives them: the first points are those that were asked for.
struct LinearTets {
  Eigen::Matrix3Xd points;
  Eigen::Matrix4Xi corners;   ///< one column an element, positive volume
  Eigen::Matrix3Xi faces;     ///< faces on the facets
  std::vector<int> faceMarks; ///< mark of the facet of each
};

/// A plane polygon of the surface.
struct Facet {
  std::vector<int> corners;
  int mark = 0;
};

/// Mesh by TetGen of the domain inside the facets, with all points as nodes, elements up to the volume given. Throws
/// DesignError with TetGen's reason where there is none.
LinearTets tetrahedralise(const Eigen::Matrix3Xd& points, const std::vector<Facet>& facets, double largestVolume);

} // namespace palp
