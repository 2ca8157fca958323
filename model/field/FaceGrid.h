#pragma once

#include "model/SensorDesign.h"

#include <Eigen/Core>

#include <vector>

namespace palp {

/// A face of the block with a quadrature rule on it: points (u, v) of two rules, u first.
struct FaceGrid {
  int axis = 2;              ///< normal to the face
  bool high = true;          ///< at the end of the block along it, or at its beginning
  double at_mm = 0;          ///< position along its axis
  int first = 0, second = 1; ///< axes of u and v
  Eigen::ArrayXd u_mm, uWeights, v_mm, vWeights;
  double nearest_mm = 0; ///< distance of the nearest electrode

  [[nodiscard]] Eigen::Index count() const { return u_mm.size() * v_mm.size(); }
  [[nodiscard]] Eigen::Matrix3Xd points_mm() const;
};

/// The faces that move (all but the bottom). Gauss's rule of four points on panels as wide as the nearest electrode is
/// deep, wider away from it; panels end at the borders of the load areas, where displacements have kinks. `fineness`
/// divides their width.
std::vector<FaceGrid> movingFaces(const SensorDesign& design, double fineness);

} // namespace palp
