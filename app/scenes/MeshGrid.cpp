#include "app/scenes/MeshGrid.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <cassert>

namespace palp {

void fillGrid(vtkUnstructuredGrid& grid, const Mesh& mesh, const Eigen::Ref<const Eigen::Matrix3Xd>& drawn_mm) {
  assert(drawn_mm.cols() == mesh.nodeCount() && "one column a node");
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(drawn_mm.cols());
  for (Eigen::Index node = 0; node < drawn_mm.cols(); ++node) points->SetPoint(node, drawn_mm.col(node).data());
  vtkNew<vtkCellArray> cells;
  for (int element = 0; element < mesh.elementCount(); ++element) {
    cells->InsertNextCell(static_cast<int>(mesh.elements.rows()));
    for (Eigen::Index k = 0; k < mesh.elements.rows(); ++k) cells->InsertCellPoint(mesh.elements(k, element));
  }
  grid.SetPoints(points);
  grid.SetCells(mesh.shape == ElementShape::Tetrahedron10 ? VTK_QUADRATIC_TETRA : VTK_HEXAHEDRON, cells);
}

void addNodalArray(vtkUnstructuredGrid& grid, const std::string& name,
                   const Eigen::Ref<const Eigen::MatrixXd>& values) {
  assert(values.cols() == grid.GetNumberOfPoints() && "one column a node");
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(values.rows()));
  array->SetNumberOfTuples(values.cols());
  for (Eigen::Index node = 0; node < values.cols(); ++node)
    for (Eigen::Index k = 0; k < values.rows(); ++k) array->SetComponent(node, static_cast<int>(k), values(k, node));
  grid.GetPointData()->AddArray(array);
}

} // namespace palp
