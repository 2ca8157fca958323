#pragma once

#include <Eigen/Core>

#include <stop_token>
#include <string>

class tetgenio;

namespace palp {

/// Corners of tetrahedra, one column per element.
struct LinearTets {
  Eigen::Matrix4Xi corners;
  Eigen::Matrix3Xi hull; ///< triangles of the convex hull
};

/// Weighted Delaunay triangulation of the points' convex hull by TetGen; every point becomes a node. Throws DesignError
/// where there is none (fewer than four points, all in a plane, a coordinate that is not finite) and Cancelled on a
/// stop request.
LinearTets weightedDelaunay(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights,
                            const std::stop_token& stop = {});

/// Calls TetGen, one call at a time in the complete program: the filters of its predicates are globals, scaled by the
/// body. Its output is suppressed. Throws DesignError with TetGen's reason where it fails.
void tetrahedralise(std::string switches, tetgenio& in, tetgenio& out);

} // namespace palp
