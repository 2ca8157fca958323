#include "app/scenes/VtuFile.h"

#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cassert>

namespace palp {

namespace {

void fillGrid(vtkUnstructuredGrid& grid, const Mesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh.nodeCount());
  for (int node = 0; node < mesh.nodeCount(); ++node) points->SetPoint(node, mesh.nodes_mm.col(node).data());
  vtkNew<vtkCellArray> cells;
  for (int element = 0; element < mesh.elementCount(); ++element) {
    cells->InsertNextCell(static_cast<int>(mesh.elements.rows()));
    for (Eigen::Index k = 0; k < mesh.elements.rows(); ++k) cells->InsertCellPoint(mesh.elements(k, element));
  }
  grid.SetPoints(points);
  grid.SetCells(mesh.shape == ElementShape::Tetrahedron10 ? VTK_QUADRATIC_TETRA : VTK_HEXAHEDRON, cells);
}

void addArray(vtkUnstructuredGrid& grid, const NodalArray& array) {
  assert(array.values.cols() == grid.GetNumberOfPoints() && "one column a node");
  vtkNew<vtkDoubleArray> data;
  data->SetName(array.name.c_str());
  data->SetNumberOfComponents(static_cast<int>(array.values.rows()));
  data->SetNumberOfTuples(array.values.cols());
  for (Eigen::Index node = 0; node < array.values.cols(); ++node)
    for (Eigen::Index k = 0; k < array.values.rows(); ++k)
      data->SetComponent(node, static_cast<int>(k), array.values(k, node));
  grid.GetPointData()->AddArray(data);
}

} // namespace

std::vector<NodalArray> nodalArrays(const NodalFields& fields) {
  std::vector<NodalArray> arrays{{"displacement_mm", fields.displacement_mm},
                                 {"cauchy_MPa", fields.cauchy_MPa},
                                 {"pressure_MPa", fields.pressure_MPa.transpose()},
                                 {"von_mises_MPa", fields.vonMises_MPa.transpose()},
                                 {"volume_ratio", fields.volumeRatio.transpose()}};
  if (fields.principalStretches.cols() > 0) arrays.push_back({"principal_stretches", fields.principalStretches});
  return arrays;
}

void writeVtu(const std::filesystem::path& path, const Mesh& mesh, const std::vector<NodalArray>& arrays) {
  vtkNew<vtkUnstructuredGrid> grid;
  fillGrid(*grid, mesh);
  for (const NodalArray& array : arrays) addArray(*grid, array);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToBinary();
  writer->WriteToOutputStringOn(); // VTK itself would not say why a file cannot be written, and would print besides
  if (writer->Write() != 1) throw Error(path.string() + ": cannot be written: VTK refuses the mesh");
  writeFile(path, writer->GetOutputString(), true);
}

} // namespace palp
