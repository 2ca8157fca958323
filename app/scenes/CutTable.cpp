#include "app/scenes/CutTable.h"

#include "app/scenes/MeshGrid.h"
#include "model/base/Cancelled.h"
#include "model/base/Text.h"

#include <vtkCutter.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

namespace palp {

namespace {

std::string quantityHead(const DeformationOptions& options) {
  const std::string unit = quantityUnit(options.quantity);
  return "\"" + quantityName(options.quantity) +
         (!options.lessReference ? ""
          : options.lessUniform  ? ", minus uniform load"
                                 : ", minus reference design") +
         (unit.empty() ? "" : " [" + unit + "]") + "\"";
}

} // namespace

std::string cutCsv(const DeformationState& state, const DeformationOptions& options, const std::stop_token& stop) {
  if (!options.cut || state.fields == nullptr || state.mesh == nullptr) return {};
  const bool less = options.lessReference && state.kept != nullptr;
  if (options.lessReference && !less) return {};
  const std::vector<double> values = less ? quantityValues(options.quantity, *state.fields, *state.kept)
                                          : quantityValues(options.quantity, *state.fields);
  if (values.empty()) return {};
  const Eigen::Matrix3Xd& u_mm = state.fields->displacement_mm;
  const double warp = options.deformationScale.value_or(automaticDeformationScale(*state.design, u_mm));
  vtkNew<vtkUnstructuredGrid> grid;
  fillGrid(*grid, *state.mesh, state.mesh->nodes_mm + warp * u_mm);
  addNodalArray(*grid, "rest", state.mesh->nodes_mm);
  addNodalArray(*grid, "u", u_mm);
  addNodalArray(*grid, "value",
                Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  throwIfStopped(stop);
  vtkNew<vtkPlane> plane;
  const Eigen::Vector3d origin = options.cut->at_mm * Eigen::Vector3d::Unit(options.cut->axis);
  plane->SetOrigin(origin.x(), origin.y(), origin.z());
  plane->SetNormal(options.cut->normal().data());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(grid);
  cutter->SetCutFunction(plane);
  cutter->Update();
  throwIfStopped(stop);
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
