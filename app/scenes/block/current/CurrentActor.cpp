#include "app/scenes/block/current/CurrentActor.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace palp {

CurrentActor::CurrentActor(vtkRenderer& renderer)
    : data_(vtkSmartPointer<vtkPolyData>::New()), mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->SetInputData(data_);
  mapper_->UseLookupTableScalarRangeOn();
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->LightingOff();
  actor_->PickableOff();
  actor_->VisibilityOff();
  renderer.AddActor(actor_);
}

void CurrentActor::show(const CurrentLines* current, double warp, const ColorScale& colors, double width_px) {
  actor_->SetVisibility(current != nullptr ? 1 : 0);
  if (current == nullptr) return;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> values;
  points->SetNumberOfPoints(current->places_mm.cols());
  for (Eigen::Index k = 0; k < current->places_mm.cols(); ++k) {
    const Eigen::Vector3d place = current->places_mm.col(k) + (warp - 1) * current->displacement_mm.col(k);
    points->SetPoint(k, place.data());
    // The colours lie between the lines' points as their logarithms do.
    values->InsertNextValue(
        static_cast<float>(colors.share(std::max(current->density[static_cast<std::size_t>(k)], colors.low))));
  }
  vtkNew<vtkCellArray> lines;
  for (const std::vector<int>& line : current->lines) {
    lines->InsertNextCell(static_cast<int>(line.size()));
    for (const int point : line) lines->InsertCellPoint(point);
  }
  ColorScale shares = colors;
  shares.low = 0;
  shares.high = 1;
  shares.logarithmic = false;
  data_->SetPoints(points);
  data_->SetLines(lines);
  data_->GetPointData()->SetScalars(values);
  data_->Modified();
  mapper_->SetLookupTable(lookupTable(shares));
  actor_->GetProperty()->SetLineWidth(static_cast<float>(width_px));
}

ColorScale currentColors(const CurrentLines& current) {
  ColorScale colors;
  colors.quantity = "|J|";
  colors.unit = "A/mm2/A";
  colors.logarithmic = true;
  std::vector<double> sorted = current.density;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) { return sorted[static_cast<std::size_t>(share * double(sorted.size() - 1))]; };
  colors.high = sorted.empty() || !(at(0.98) > 0) ? 1 : at(0.98);
  colors.low = std::max(sorted.empty() ? 0 : at(0.02), 1e-3 * colors.high);
  if (!(colors.low < 0.5 * colors.high)) colors.low = 0.5 * colors.high;
  return colors;
}

} // namespace palp
