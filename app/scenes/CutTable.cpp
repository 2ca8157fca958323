#include "app/scenes/CutTable.h"

#include "model/base/Cancelled.h"
#include "model/base/Text.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkCutter.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

namespace palp {

namespace {

/// Components x nodes under a name.
void addNodal(vtkUnstructuredGrid& grid, const char* name, const Eigen::Ref<const Eigen::MatrixXd>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.rows()));
  array->SetNumberOfTuples(values.cols());
  for (Eigen::Index node = 0; node < values.cols(); ++node)
    for (Eigen::Index k = 0; k < values.rows(); ++k) array->SetComponent(node, static_cast<int>(k), values(k, node));
  grid.GetPointData()->AddArray(array);
}

/// The mesh with its nodes where they are drawn.
void fillGrid(vtkUnstructuredGrid& grid, const Mesh& mesh, const Eigen::Matrix3Xd& drawn_mm) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(drawn_mm.cols());
  for (Eigen::Index k = 0; k < drawn_mm.cols(); ++k) points->SetPoint(k, drawn_mm.col(k).data());
  vtkNew<vtkCellArray> cells;
  for (int element = 0; element < mesh.elementCount(); ++element) {
    cells->InsertNextCell(static_cast<int>(mesh.elements.rows()));
    for (Eigen::Index k = 0; k < mesh.elements.rows(); ++k) cells->InsertCellPoint(mesh.elements(k, element));
  }
  grid.SetPoints(points);
  grid.SetCells(mesh.shape == ElementShape::Tetrahedron10 ? VTK_QUADRATIC_TETRA : VTK_HEXAHEDRON, cells);
}

std::string quantityHead(const DeformationOptions& options) {
  const std::string unit = quantityUnit(options.quantity);
  return "\"" + quantityName(options.quantity) + (options.lessKept ? ", less the kept design's" : "") +
         (unit.empty() ? "" : " [" + unit + "]") + "\"";
}

} // namespace

std::string cutCsv(const DeformationState& state, const DeformationOptions& options, const std::stop_token& stop) {
  if (!options.cut || state.fields == nullptr || state.mesh == nullptr) return {};
  const bool less = options.lessKept && state.kept != nullptr;
  if (options.lessKept && !less) return {};
  const std::vector<double> values = less ? quantityValues(options.quantity, *state.fields, *state.kept)
                                          : quantityValues(options.quantity, *state.fields);
  if (values.empty()) return {};
  const Eigen::Matrix3Xd& u_mm = state.fields->displacement_mm;
  const double warp = options.warpFactor.value_or(automaticWarpFactor(*state.design, u_mm));
  vtkNew<vtkUnstructuredGrid> grid;
  fillGrid(*grid, *state.mesh, state.mesh->nodes_mm + warp * u_mm);
  addNodal(*grid, "rest", state.mesh->nodes_mm);
  addNodal(*grid, "u", u_mm);
  addNodal(*grid, "value",
           Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  stopIfAsked(stop);
  vtkNew<vtkPlane> plane;
  const Eigen::Vector3d origin = options.cut->at_mm * Eigen::Vector3d::Unit(options.cut->axis);
  plane->SetOrigin(origin.x(), origin.y(), origin.z());
  plane->SetNormal(options.cut->normal().data());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(grid);
  cutter->SetCutFunction(plane);
  cutter->Update();
  stopIfAsked(stop);
  vtkPointData& found = *cutter->GetOutput()->GetPointData();
  std::string csv = "x_mm,y_mm,z_mm,u_x_mm,u_y_mm,u_z_mm," + quantityHead(options) + "\n";
  const vtkIdType count = cutter->GetOutput()->GetNumberOfPoints();
  for (vtkIdType point = 0; point < count; ++point) {
    for (const char* name : {"rest", "u"})
      for (int k = 0; k < 3; ++k)
        csv += text(vtkDoubleArray::SafeDownCast(found.GetArray(name))->GetComponent(point, k)) + ",";
    csv += text(found.GetArray("value")->GetComponent(point, 0)) + "\n";
  }
  return csv;
}

} // namespace palp
