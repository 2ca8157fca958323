#include "app/scenes/VtuFile.h"

#include "app/scenes/MeshGrid.h"
#include "io/AtomicFile.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace palp {

std::vector<NodalArray> nodalArrays(const NodalFields& fields) {
  std::vector<NodalArray> arrays{{"displacement_mm", fields.displacement_mm},
                                 {"cauchy_MPa", fields.cauchy_MPa},
                                 {"pressure_MPa", fields.pressure_MPa.transpose()},
                                 {"von_mises_MPa", fields.vonMises_MPa.transpose()},
                                 {"volume_ratio", fields.volumeRatio.transpose()}};
  if (fields.principalStretches.cols() > 0) arrays.push_back({"principal_stretches", fields.principalStretches});
  if (fields.contactTraction_MPa.cols() > 0) arrays.push_back({"contact_traction_MPa", fields.contactTraction_MPa});
  return arrays;
}

namespace {

/// The writer is stopped at VTK's next report of progress.
void endWhereAsked(vtkObject* writer, unsigned long, void* stop, void*) {
  if (static_cast<const std::stop_token*>(stop)->stop_requested()) static_cast<vtkAlgorithm*>(writer)->AbortExecuteOn();
}

} // namespace

std::string vtuText(const Mesh& mesh, const std::vector<NodalArray>& arrays, const std::stop_token& stop) {
  vtkNew<vtkUnstructuredGrid> grid;
  fillGrid(*grid, mesh, mesh.nodes_mm);
  for (const NodalArray& array : arrays) {
    throwIfStopped(stop);
    addNodalArray(*grid, array.name, array.values);
  }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  vtkNew<vtkCallbackCommand> reported;
  reported->SetCallback(endWhereAsked);
  reported->SetClientData(const_cast<std::stop_token*>(&stop)); // VTK has no const; it is only read
  writer->AddObserver(vtkCommand::ProgressEvent, reported);
  writer->SetInputData(grid);
  writer->SetDataModeToBinary();
  writer->WriteToOutputStringOn(); // VTK itself would not say why a file cannot be written, and would print besides
  const bool good = writer->Write() == 1;
  throwIfStopped(stop);
  if (!good) throw Error("VTK refuses to write the mesh");
  return writer->GetOutputString();
}

void writeVtu(const std::filesystem::path& path, const Mesh& mesh, const std::vector<NodalArray>& arrays) {
  writeFile(path, vtuText(mesh, arrays), true);
}

} // namespace palp
