#include "app/scenes/block/current/CurrentLines.h"

#include "model/base/Cancelled.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStreamTracer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr double kLines = 200;            ///< in total, about
constexpr Eigen::Index kLinesAtOnce = 20; ///< a stop is looked at between them
/// From an electrode's middle, in its radii: outside of the sphere, and of the node there, where nothing flows.
constexpr double kBegin = 2.5, kEnd = 1.5;

/// Quadratic tetrahedra as eight with straight edges (the inner four about the edge between nodes 4 and 9).
constexpr std::array<std::array<int, 4>, 8> kParts{
    {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}, {4, 9, 5, 6}, {4, 9, 6, 7}, {4, 9, 7, 8}, {4, 9, 8, 5}}};

vtkSmartPointer<vtkDoubleArray> arrayOf(const char* name, const Eigen::Matrix3Xd& values) {
  auto data = vtkSmartPointer<vtkDoubleArray>::New();
  data->SetName(name);
  data->SetNumberOfComponents(3);
  data->SetNumberOfTuples(values.cols());
  for (Eigen::Index k = 0; k < values.cols(); ++k) data->SetTuple(k, values.col(k).data());
  return data;
}

vtkSmartPointer<vtkPoints> pointsOf(const Eigen::Matrix3Xd& places_mm) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(places_mm.cols());
  for (Eigen::Index k = 0; k < places_mm.cols(); ++k) points->SetPoint(k, places_mm.col(k).data());
  return points;
}

vtkSmartPointer<vtkUnstructuredGrid> gridOf(const Mesh& mesh, const CurrentSources& sources) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkCellArray> cells;
  const bool tets = mesh.shape == ElementShape::Tetrahedron10;
  for (int element = 0; element < mesh.elementCount(); ++element) {
    const auto nodes = mesh.elements.col(element);
    if (!tets) {
      cells->InsertNextCell(static_cast<int>(nodes.size()));
      for (const int node : nodes) cells->InsertCellPoint(node);
      continue;
    }
    for (const std::array<int, 4>& part : kParts) {
      cells->InsertNextCell(4);
      for (const int node : part) cells->InsertCellPoint(nodes(node));
    }
  }
  grid->SetPoints(pointsOf(mesh.nodes_mm + sources.displacement_mm));
  grid->SetCells(tets ? VTK_TETRA : VTK_HEXAHEDRON, cells);
  grid->GetPointData()->SetVectors(arrayOf("density", sources.density));
  grid->GetPointData()->AddArray(arrayOf("displacement", sources.displacement_mm));
  return grid;
}

/// Around every electrode that current leaves, as many places as its share of the current asks for, spread evenly over
/// a sphere (a Fibonacci lattice).
Eigen::Matrix3Xd beginnings(const CurrentSources& sources, double lineCurrent_A) {
  std::vector<Eigen::Vector3d> places;
  for (Eigen::Index e = 0; e < sources.electrodes_A.size(); ++e) {
    const auto count = static_cast<int>(std::lround(sources.electrodes_A(e) / lineCurrent_A));
    for (int k = 0; k < count; ++k) {
      const double z = 1 - (2 * k + 1.0) / count, turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
      const double r = std::sqrt(1 - z * z);
      places.emplace_back(sources.electrodes_mm.col(e) +
                          kBegin * sources.electrodeRadius_mm *
                              Eigen::Vector3d(r * std::cos(turn), r * std::sin(turn), z));
    }
  }
  Eigen::Matrix3Xd all(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k) all.col(static_cast<Eigen::Index>(k)) = places[k];
  return all;
}

/// Points of a traced line up to the electrode that takes the current up.
vtkIdType pointsKept(vtkPolyData& traced, vtkIdList& line, const CurrentSources& sources) {
  const double near = kEnd * sources.electrodeRadius_mm;
  for (vtkIdType k = 0; k < line.GetNumberOfIds(); ++k) {
    const Eigen::Vector3d place(traced.GetPoint(line.GetId(k)));
    for (Eigen::Index e = 0; e < sources.electrodes_A.size(); ++e)
      if (sources.electrodes_A(e) < 0 && (place - sources.electrodes_mm.col(e)).squaredNorm() < near * near)
        return k + 1;
  }
  return line.GetNumberOfIds();
}

void append(CurrentLines& all, vtkPolyData& traced, const CurrentSources& sources) {
  auto* density = traced.GetPointData()->GetArray("density");
  auto* displacement = traced.GetPointData()->GetArray("displacement");
  if (density == nullptr || displacement == nullptr) return;
  Eigen::Index next = all.places_mm.cols();
  all.places_mm.conservativeResize(Eigen::NoChange, next + traced.GetNumberOfPoints());
  all.displacement_mm.conservativeResize(Eigen::NoChange, next + traced.GetNumberOfPoints());
  vtkNew<vtkIdList> line;
  traced.GetLines()->InitTraversal();
  while (traced.GetLines()->GetNextCell(line) != 0) {
    const vtkIdType kept = pointsKept(traced, *line, sources);
    if (kept < 2) continue;
    std::vector<int>& points = all.lines.emplace_back();
    for (vtkIdType k = 0; k < kept; ++k, ++next) {
      const vtkIdType point = line->GetId(k);
      traced.GetPoint(point, all.places_mm.col(next).data());
      displacement->GetTuple(point, all.displacement_mm.col(next).data());
      Eigen::Vector3d flow;
      density->GetTuple(point, flow.data());
      all.density.push_back(flow.norm());
      points.push_back(static_cast<int>(next));
    }
  }
  all.places_mm.conservativeResize(Eigen::NoChange, next);
  all.displacement_mm.conservativeResize(Eigen::NoChange, next);
}

} // namespace

CurrentLines currentLines(const Mesh& mesh, const CurrentSources& sources, const std::stop_token& stop) {
  CurrentLines all;
  all.places_mm.resize(3, 0);
  all.displacement_mm.resize(3, 0);
  all.current_A = sources.electrodes_A.cwiseMax(0).sum() / kLines;
  if (!(all.current_A > 0)) return all;
  const Eigen::Matrix3Xd begin = beginnings(sources, all.current_A);
  const Eigen::Vector3d size_mm = mesh.nodes_mm.rowwise().maxCoeff() - mesh.nodes_mm.rowwise().minCoeff();
  const auto grid = gridOf(mesh, sources);
  throwIfStopped(stop);
  vtkNew<vtkStreamTracer> tracer;
  tracer->SetInputData(grid);
  tracer->SetInterpolatorTypeToCellLocator();
  tracer->SetIntegratorTypeToRungeKutta45();
  tracer->SetIntegrationStepUnit(vtkStreamTracer::LENGTH_UNIT);
  tracer->SetInitialIntegrationStep(0.5 * sources.electrodeRadius_mm);
  tracer->SetMinimumIntegrationStep(0.1 * sources.electrodeRadius_mm);
  tracer->SetMaximumIntegrationStep(0.02 * size_mm.maxCoeff());
  tracer->SetMaximumError(1e-3 * size_mm.maxCoeff());
  tracer->SetMaximumPropagation(3 * size_mm.maxCoeff());
  tracer->SetMaximumNumberOfSteps(1000);
  tracer->SetTerminalSpeed(1e-12);
  tracer->SetComputeVorticity(false);
  tracer->SetIntegrationDirectionToForward();
  for (Eigen::Index first = 0; first < begin.cols(); first += kLinesAtOnce) {
    throwIfStopped(stop);
    vtkNew<vtkPolyData> seeds;
    seeds->SetPoints(pointsOf(begin.middleCols(first, std::min(kLinesAtOnce, begin.cols() - first))));
    tracer->SetSourceData(seeds);
    tracer->Update();
    append(all, *tracer->GetOutput(), sources);
  }
  return all;
}

} // namespace palp
