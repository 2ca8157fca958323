#include "app/scenes/block/CameraFit.h"

#include <Eigen/Geometry>

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double kHalfAngle = 0.26; ///< half the vertical opening of the view [rad]

/// Extent of the points in the view's plane at distance 1, as slopes.
struct Extent {
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
};

Extent extentFrom(const Eigen::Vector3d& eye, const Eigen::Matrix3d& axes, const Eigen::Matrix3Xd& points) {
  Extent extent;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const Eigen::Vector3d seen = axes.transpose() * (points.col(k) - eye);
    const Eigen::Array2d slope = seen.head<2>().array() / seen.z();
    extent.low = extent.low.min(slope);
    extent.high = extent.high.max(slope);
  }
  return extent;
}

} // namespace

void fitCamera(vtkRenderer& renderer, const Eigen::Matrix3Xd& points_mm, const Eigen::Vector3d& direction,
               double aspect, const ViewMargins& margins) {
  Eigen::Matrix3d axes; // right, up, forward
  axes.col(2) = direction.normalized();
  const Eigen::Vector3d right = axes.col(2).cross(Eigen::Vector3d::UnitZ());
  axes.col(0) = right.norm() > 1e-6 ? right.normalized() : Eigen::Vector3d::UnitX(); // from above: y up
  axes.col(1) = axes.col(0).cross(axes.col(2));
  const double half = std::tan(kHalfAngle);
  const Eigen::Array2d size(2 * half * aspect, 2 * half);
  const Eigen::Array2d low = Eigen::Array2d(margins.left, margins.bottom) * size - size / 2;
  const Eigen::Array2d high = size / 2 - Eigen::Array2d(margins.right, margins.top) * size;
  const Eigen::Vector3d centre = points_mm.rowwise().mean();
  double distance = 4 * (points_mm.colwise() - centre).colwise().norm().maxCoeff() + 1e-9;
  Eigen::Vector3d eye = centre - distance * axes.col(2);
  // A fixed-point iteration: extents scale with 1/distance but for the perspective, which is weak.
  for (int k = 0; k < 12; ++k) {
    const Extent extent = extentFrom(eye, axes, points_mm);
    const double factor = ((extent.high - extent.low) / (high - low)).maxCoeff();
    const Eigen::Array2d shift = 0.5 * (extent.low + extent.high) - 0.5 * (low + high) * factor;
    eye += distance * (shift.x() * axes.col(0) + shift.y() * axes.col(1));
    eye -= distance * (factor - 1) * axes.col(2);
    distance = axes.col(2).dot(centre - eye);
  }
  const Eigen::Vector3d focus = eye + distance * axes.col(2);
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.SetViewAngle(2 * kHalfAngle * 180 / 3.14159265358979);
  camera.SetFocalPoint(focus.x(), focus.y(), focus.z());
  camera.SetPosition(eye.x(), eye.y(), eye.z());
  camera.SetViewUp(axes.col(1).data());
  renderer.ResetCameraClippingRange();
}

} // namespace palp
