#pragma once

#include "model/Mesh.h"
#include "solver/mesh/DelaunayTets.h"

#include <stop_token>

namespace palp {

/// Quadratic tetrahedra on the points: adds the edge midpoints, in VTK's order, after the points. Elements are turned
/// to positive volume. The hull's faces at the largest z become the top faces, without areas. Throws Cancelled.
Mesh quadraticTets(const Eigen::Matrix3Xd& points_mm, const LinearTets& tets, const std::stop_token& stop = {});

} // namespace palp
