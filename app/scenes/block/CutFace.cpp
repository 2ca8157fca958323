#include "app/scenes/block/CutFace.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkCutter.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>

namespace palp {

CutFace::CutFace(vtkRenderer& renderer)
    : grid_(vtkSmartPointer<vtkUnstructuredGrid>::New()), cutter_(vtkSmartPointer<vtkCutter>::New()),
      mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  cutter_->SetInputData(grid_);
  mapper_->SetInputConnection(cutter_->GetOutputPort());
  mapper_->InterpolateScalarsBeforeMappingOn();
  actor_->SetMapper(mapper_);
  actor_->PickableOff();
  actor_->VisibilityOff();
  actor_->GetProperty()->SetAmbient(1); // unlit: the legend's colours
  actor_->GetProperty()->SetDiffuse(0);
  renderer.AddActor(actor_);
}

void CutFace::setMesh(const Mesh& mesh) {
  vtkNew<vtkCellArray> cells;
  for (int element = 0; element < mesh.elementCount(); ++element) {
    cells->InsertNextCell(static_cast<int>(mesh.elements.rows()));
    for (Eigen::Index k = 0; k < mesh.elements.rows(); ++k) cells->InsertCellPoint(mesh.elements(k, element));
  }
  grid_->SetCells(mesh.shape == ElementShape::Tetrahedron10 ? VTK_QUADRATIC_TETRA : VTK_HEXAHEDRON, cells);
}

void CutFace::show(const Eigen::Matrix3Xd& drawn_mm, const std::vector<double>& values, const ColorScale& colors,
                   const Color& plain, double opacity, vtkPlane* plane) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> scalars;
  points->SetNumberOfPoints(drawn_mm.cols());
  for (Eigen::Index k = 0; k < drawn_mm.cols(); ++k) points->SetPoint(k, drawn_mm.col(k).data());
  for (const double value : values) scalars->InsertNextValue(static_cast<float>(value));
  grid_->SetPoints(points);
  grid_->GetPointData()->SetScalars(values.empty() ? nullptr : scalars.Get());
  grid_->Modified();
  cutter_->SetCutFunction(plane);
  mapper_->SetScalarVisibility(values.empty() ? 0 : 1);
  mapper_->SetLookupTable(lookupTable(colors));
  mapper_->UseLookupTableScalarRangeOn();
  actor_->GetProperty()->SetColor(plain[0], plain[1], plain[2]);
  actor_->GetProperty()->SetOpacity(opacity);
  actor_->VisibilityOn();
}

void CutFace::hide() {
  actor_->VisibilityOff();
}

} // namespace palp
