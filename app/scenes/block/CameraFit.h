#pragma once

#include <Eigen/Core>

class vtkRenderer;

namespace palp {

/// Shares of the view that stay free at its borders.
struct ViewMargins {
  double left = 0.04;
  double right = 0.04;
  double bottom = 0.04;
  double top = 0.04;
};

/// Looks along the direction with z up (y where it is looked at from above), so that the points fill what the margins
/// leave of a view `aspect` times as wide as high.
void fitCamera(vtkRenderer& renderer, const Eigen::Matrix3Xd& points_mm, const Eigen::Vector3d& direction,
               double aspect, const ViewMargins& margins);

} // namespace palp
