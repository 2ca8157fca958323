#include "app/scenes/block/ElectrodeActors.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <numeric>

namespace palp {

namespace {

constexpr double kRadius_mm = 0.28;
constexpr double kWireRadius_mm = 0.07;

/// One line per wire through its electrodes; electrode e of wire w is point w * perWire + e.
std::vector<std::vector<int>> wires(int count, int perWire) {
  std::vector<std::vector<int>> lines(static_cast<std::size_t>(count),
                                      std::vector<int>(static_cast<std::size_t>(perWire)));
  for (int wire = 0; wire < count; ++wire)
    std::iota(lines[static_cast<std::size_t>(wire)].begin(), lines[static_cast<std::size_t>(wire)].end(),
              wire * perWire);
  return lines;
}

/// Those of the places that are not cut away. A sphere that the plane goes through stays complete: displacements of a
/// rounding error would otherwise take single ones out of a row that lies in the plane.
Eigen::Matrix3Xd kept(const Eigen::Matrix3Xd& places_mm, const std::optional<CutPlane>& cut) {
  if (!cut) return places_mm;
  const Eigen::Vector3d reach = kRadius_mm * cut->normal();
  std::vector<Eigen::Index> stay;
  for (Eigen::Index k = 0; k < places_mm.cols(); ++k)
    if (cut->keeps(places_mm.col(k) + reach)) stay.push_back(k);
  return places_mm(Eigen::all, stay);
}

} // namespace

Spheres::Spheres(vtkRenderer& renderer, double radius_mm)
    : data_(vtkSmartPointer<vtkPolyData>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  // Round in the fragment shader, on a triangle each: as meshes, 600 spheres cost 30 ms a frame by software.
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(data_);
  mapper->SetRadius(static_cast<float>(radius_mm));
  actor_->SetMapper(mapper);
  actor_->PickableOff();
  renderer.AddActor(actor_);
}

void Spheres::set(const Eigen::Matrix3Xd& places_mm, const Color& color) {
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(places_mm.cols());
  for (Eigen::Index k = 0; k < places_mm.cols(); ++k) points->SetPoint(k, places_mm.col(k).data());
  vtkNew<vtkCellArray> vertices; // a surface's bounds are those of its cells, and what has none is not drawn
  vertices->InsertNextCell(static_cast<int>(places_mm.cols()));
  for (vtkIdType k = 0; k < places_mm.cols(); ++k) vertices->InsertCellPoint(k);
  data_->SetPoints(points);
  data_->SetVerts(vertices);
  data_->Modified();
  actor_->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor_->GetProperty()->SetAmbient(0.25);
}

void Spheres::setVisible(bool visible) {
  actor_->SetVisibility(visible ? 1 : 0);
}

ElectrodeActors::ElectrodeActors(vtkRenderer& renderer)
    : rowWires_(renderer), columnWires_(renderer), upper_(renderer, kRadius_mm), lower_(renderer, kRadius_mm),
      lit_(renderer, 1.9 * kRadius_mm) {
  rowWires_.setTubes(kWireRadius_mm);
  columnWires_.setTubes(kWireRadius_mm);
}

void ElectrodeActors::show(const SensorDesign& design, const Eigen::Matrix3Xd& upper_mm,
                           const Eigen::Matrix3Xd& lower_mm, const DeformationOptions& options) {
  const Palette& ink = palette(options.theme);
  const Eigen::Matrix3Xd upper = design.upperElectrodes_mm() + upper_mm;
  const Eigen::Matrix3Xd lower = design.lowerElectrodes_mm() + lower_mm;
  rowWires_.set(upper, wires(design.rowWires(), design.electrodesPerRowWire()));
  columnWires_.set(lower, wires(design.columnWires(), design.electrodesPerColumnWire()));
  rowWires_.setLook(ink.upper, options.scale);
  columnWires_.setLook(ink.lower, options.scale);
  vtkNew<vtkPlane> plane;
  if (options.cut) {
    const Eigen::Vector3d origin = options.cut->at_mm * Eigen::Vector3d::Unit(options.cut->axis);
    plane->SetOrigin(origin.x(), origin.y(), origin.z());
    plane->SetNormal(options.cut->normal().data());
  }
  for (Polylines* lines : {&rowWires_, &columnWires_}) lines->clip(options.cut ? plane.Get() : nullptr);
  upper_.set(kept(upper, options.cut), ink.upper);
  lower_.set(kept(lower, options.cut), ink.lower);

  Eigen::Matrix3Xd lit(3, 0);
  litWords_.clear();
  if (options.litCell) {
    const int perRow = design.electrodesPerRowWire();
    const int perColumn = design.electrodesPerColumnWire();
    lit.resize(3, perRow + perColumn);
    lit << upper.middleCols((*options.litCell)[0] * perRow, perRow),
        lower.middleCols((*options.litCell)[1] * perColumn, perColumn);
    for (int k = 0; k < lit.cols(); ++k) {
      if (kept(lit.col(k), options.cut).cols() == 0) continue;
      const bool row = k < perRow;
      litWords_.push_back({lit.col(k),
                           (row ? "row-wire " : "column-wire ") + std::to_string((*options.litCell)[row ? 0 : 1]) +
                               ", electrode " + std::to_string(row ? k : k - perRow) + ": of the selected resistance",
                           ink.selection});
    }
  }
  lit_.set(kept(lit, options.cut), ink.selection);
  for (Polylines* lines : {&rowWires_, &columnWires_}) lines->setVisible(options.electrodes);
  for (Spheres* spheres : {&upper_, &lower_}) spheres->setVisible(options.electrodes);
  lit_.setVisible(lit.cols() > 0);
}

} // namespace palp
