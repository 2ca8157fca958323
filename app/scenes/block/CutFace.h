#pragma once

#include "app/scenes/ColorScale.h"
#include "model/Mesh.h"

#include <vtkActor.h>
#include <vtkPlane.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkCutter;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkUnstructuredGrid;

namespace palp {

/// The face that shows where the block is cut open by a plane.
class CutFace {
public:
  explicit CutFace(vtkRenderer& renderer);

  void setMesh(const Mesh& mesh);
  /// Places and values at the mesh's nodes; what is coloured is the material that lies in the plane as drawn.
  void show(const Eigen::Matrix3Xd& drawn_mm, const std::vector<double>& values, const ColorScale& colors,
            const Color& plain, double opacity, vtkPlane* plane);
  void hide();

private:
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  vtkSmartPointer<vtkCutter> cutter_;
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

} // namespace palp
