#include "app/scenes/VtuFile.h"

#include "app/scenes/Picture.h"
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
  return {{"displacement_mm", fields.displacement_mm},
          {"cauchy_MPa", fields.cauchy_MPa},
          {"pressure_MPa", fields.pressure_MPa.transpose()},
          {"von_mises_MPa", fields.vonMises_MPa.transpose()},
          {"volume_ratio", fields.volumeRatio.transpose()}};
}

void writeVtu(const std::filesystem::path& path, const Mesh& mesh, const std::vector<NodalArray>& arrays) {
  vtkNew<vtkUnstructuredGrid> grid;
  fillGrid(*grid, mesh);
  for (const NodalArray& array : arrays) addArray(*grid, array);
  const std::filesystem::path part = path.string() + ".part";
  requireWritable(part);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(part.c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToBinary();
  std::error_code failure;
  const bool written = writer->Write() == 1 && writer->GetErrorCode() == 0;
  if (written) std::filesystem::rename(part, path, failure);
  if (!written || failure) {
    std::filesystem::remove(part, failure);
    throw Error(path.string() + ": cannot be written; allowed is a file in a folder that exists and may be written to");
  }
}

} // namespace palp
