#include "app/scenes/VtuFile.h"

#include "model/SensorDesign.h"
#include "solver/SensorMesh.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>

namespace palp {
namespace {

Mesh hexahedra() {
  MeshOptions options;
  options.mapped = std::array<int, 3>{3, 2, 1};
  return sensorMesh(paperDesign(), options);
}

Mesh tetrahedra() {
  MeshOptions options;
  options.meshSize_mm = 12;
  return sensorMesh(paperDesign(), options);
}

/// Different at every node and in every component, and not a round number.
NodalFields fieldsOf(const Mesh& mesh) {
  NodalFields fields;
  const Eigen::Index nodes = mesh.nodeCount();
  const auto numbered = [](Eigen::Index rows, Eigen::Index columns, double shift) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::NullaryExpr(rows, columns,
                                        [=](Eigen::Index r, Eigen::Index c) { return std::sin(shift + r + 10.0 * c); });
  };
  fields.displacement_mm = numbered(3, nodes, 0.1);
  fields.cauchy_MPa = numbered(6, nodes, 0.2);
  fields.pressure_MPa = numbered(nodes, 1, 0.3);
  fields.vonMises_MPa = numbered(nodes, 1, 0.4);
  fields.volumeRatio = numbered(nodes, 1, 0.5);
  return fields;
}

vtkSmartPointer<vtkUnstructuredGrid> readBack(const std::filesystem::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Components x nodes.
Eigen::MatrixXd valuesOf(vtkUnstructuredGrid& grid, const std::string& name) {
  vtkDataArray* array = grid.GetPointData()->GetArray(name.c_str());
  if (array == nullptr) return {};
  Eigen::MatrixXd values(array->GetNumberOfComponents(), array->GetNumberOfTuples());
  for (Eigen::Index node = 0; node < values.cols(); ++node)
    for (Eigen::Index k = 0; k < values.rows(); ++k) values(k, node) = array->GetComponent(node, static_cast<int>(k));
  return values;
}

void expectSame(const Mesh& mesh, int cellType) {
  const TemporaryFolder folder;
  const NodalFields fields = fieldsOf(mesh);
  writeVtu(folder / "a.vtu", mesh, nodalArrays(fields));
  const auto grid = readBack(folder / "a.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), mesh.nodeCount());
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.elementCount());
  for (int node = 0; node < mesh.nodeCount(); ++node)
    for (int d = 0; d < 3; ++d) ASSERT_EQ(grid->GetPoint(node)[d], mesh.nodes_mm(d, node)) << node; // doubles, whole
  for (int e = 0; e < mesh.elementCount(); ++e) {
    ASSERT_EQ(grid->GetCellType(e), cellType);
    vtkNew<vtkIdList> nodes;
    grid->GetCellPoints(e, nodes);
    ASSERT_EQ(nodes->GetNumberOfIds(), mesh.elements.rows());
    for (Eigen::Index k = 0; k < mesh.elements.rows(); ++k) ASSERT_EQ(nodes->GetId(k), mesh.elements(k, e));
  }
  EXPECT_EQ(valuesOf(*grid, "displacement_mm"), fields.displacement_mm);
  EXPECT_EQ(valuesOf(*grid, "cauchy_MPa"), fields.cauchy_MPa);
  EXPECT_EQ(valuesOf(*grid, "pressure_MPa"), fields.pressure_MPa.transpose());
  EXPECT_EQ(valuesOf(*grid, "von_mises_MPa"), fields.vonMises_MPa.transpose());
  EXPECT_EQ(valuesOf(*grid, "volume_ratio"), fields.volumeRatio.transpose());
}

TEST(VtuFile, ReadsBackAsTheSameHexahedraAndFields) {
  expectSame(hexahedra(), VTK_HEXAHEDRON);
}

TEST(VtuFile, ReadsBackAsTheSameTetrahedraAndFields) {
  expectSame(tetrahedra(), VTK_QUADRATIC_TETRA);
}

TEST(VtuFile, SaysWhyItCannotBeWritten) {
  const std::string words = refusal([] { writeVtu("/no/such/folder/a.vtu", hexahedra()); });
  EXPECT_EQ(words, "/no/such/folder/a.vtu: cannot be written: No such file or directory");
}

TEST(VtuFile, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string words = refusal([] { writeVtu("/dev/full", hexahedra()); });
  EXPECT_EQ(words, "/dev/full: cannot be written: No space left on device");
}

} // namespace
} // namespace palp
