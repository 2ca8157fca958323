#pragma once

#include <Eigen/Core>

namespace palp {

/// Corners of tetrahedra, one column an element.
struct LinearTets {
  Eigen::Matrix4Xi corners;
  Eigen::Matrix3Xi hull; ///< triangles of the convex hull
};

/// Weighted Delaunay triangulation of the points' convex hull by TetGen; every point becomes a node. Throws DesignError
/// with TetGen's reason where there is none.
LinearTets weightedDelaunay(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights);

} // namespace palp
