#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"
#include "model/SensorDesign.h"

#include <vector>

namespace palp {

/// Share of a uniform dead traction's force that each node of the top face takes; the shares sum to 1.
struct NodeShare {
  int node = 0;
  double share = 0;
};
using TractionShares = std::vector<NodeShare>;

/// Shares of a traction over a convex region of the top face (corners counter-clockwise, one a column), by the exact
/// integral of the shape functions over each face's part inside the region.
TractionShares tractionShares(const Mesh& mesh, const Eigen::Matrix2Xd& convexRegion);

/// Corners of a load area.
Eigen::Matrix2Xd regionOf(const Rectangle& area);
/// A disc as a polygon of the same area, fine enough for moments right to 1e-5.
Eigen::Matrix2Xd regionOf(const PatchLoad& patch);

/// Nodal forces of the load on all components (3 node + direction). Throws DesignError where it cannot act.
Eigen::VectorXd nodalForces(const Mesh& mesh, const SensorDesign& design, const LoadCase& load);

} // namespace palp
