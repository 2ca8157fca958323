#include "app/scenes/block/Polylines.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTubeFilter.h>

namespace palp {

Polylines::Polylines(vtkRenderer& renderer)
    : data_(vtkSmartPointer<vtkPolyData>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data_);
  actor_->SetMapper(mapper);
  actor_->GetProperty()->LightingOff();
  actor_->PickableOff();
  renderer.AddActor(actor_);
}

void Polylines::set(const Eigen::Matrix3Xd& points_mm, const std::vector<std::vector<int>>& lines) {
  vtkNew<vtkCellArray> cells;
  for (const std::vector<int>& line : lines) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const int point : line) cells->InsertCellPoint(point);
  }
  data_->SetLines(cells);
  move(points_mm);
}

void Polylines::move(const Eigen::Matrix3Xd& points_mm) {
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(points_mm.cols());
  for (Eigen::Index k = 0; k < points_mm.cols(); ++k) points->SetPoint(k, points_mm.col(k).data());
  data_->SetPoints(points);
  data_->Modified();
}

void Polylines::setLook(const Color& color, double width_px, double opacity) {
  vtkProperty& look = *actor_->GetProperty();
  look.SetColor(color[0], color[1], color[2]);
  look.SetLineWidth(static_cast<float>(width_px));
  look.SetOpacity(opacity);
}

void Polylines::setTubes(double radius_mm) {
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(data_);
  tubes->SetRadius(radius_mm);
  tubes->SetNumberOfSides(8);
  actor_->GetMapper()->SetInputConnection(tubes->GetOutputPort());
  actor_->GetProperty()->LightingOn();
  actor_->GetProperty()->SetAmbient(0.25);
}

void Polylines::setVisible(bool visible) {
  actor_->SetVisibility(visible ? 1 : 0);
}

void Polylines::clip(vtkPlane* plane) {
  actor_->GetMapper()->RemoveAllClippingPlanes();
  if (plane != nullptr) actor_->GetMapper()->AddClippingPlane(plane);
}

Eigen::Matrix3Xd boxCorners(const Eigen::Vector3d& size_mm) {
  Eigen::Matrix3Xd corners(3, 8);
  for (int k = 0; k < 8; ++k)
    corners.col(k) =
        Eigen::Vector3d((k & 1) != 0 ? 1 : 0, (k & 2) != 0 ? 1 : 0, (k & 4) != 0 ? 1 : 0).cwiseProduct(size_mm);
  return corners;
}

const std::vector<std::vector<int>>& boxEdges() {
  static const std::vector<std::vector<int>> edges{{0, 1, 3, 2, 0}, {4, 5, 7, 6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  return edges;
}

} // namespace palp
