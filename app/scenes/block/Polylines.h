#pragma once

#include "app/scenes/Palette.h"

#include <Eigen/Core>

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkPlane;
class vtkPolyData;
class vtkRenderer;

namespace palp {

/// Lines through points [mm], drawn as lines `width_px` wide or as tubes.
class Polylines {
public:
  explicit Polylines(vtkRenderer& renderer);

  void set(const Eigen::Matrix3Xd& points_mm, const std::vector<std::vector<int>>& lines);
  /// New places of the same points.
  void move(const Eigen::Matrix3Xd& points_mm);
  void setLook(const Color& color, double width_px, double opacity = 1);
  /// Drawn as tubes of this radius from now on, lit like a body.
  void setTubes(double radius_mm);
  void setVisible(bool visible);
  /// Leaves out what lies behind the plane; null shows all.
  void clip(vtkPlane* plane);

private:
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkActor> actor_;
};

/// The twelve edges of a box with one corner at the origin.
Eigen::Matrix3Xd boxCorners(const Eigen::Vector3d& size_mm);
const std::vector<std::vector<int>>& boxEdges();

} // namespace palp
