#include "app/scenes/block/map/FaceMap.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace palp {

namespace {

constexpr double kAbove = 2e-3; ///< of the block's height, so that the face does not shine through

/// Sides of the cells around `count` places between low and high, none beyond the face.
std::vector<double> sides(double low, double high, Eigen::Index count, double face) {
  std::vector<double> all;
  for (Eigen::Index k = 0; k <= count; ++k)
    all.push_back(
        std::clamp(low + (high - low) * (static_cast<double>(k) - 0.5) / static_cast<double>(count - 1), 0.0, face));
  return all;
}

} // namespace

FaceMapActor::FaceMapActor(vtkRenderer& renderer)
    : data_(vtkSmartPointer<vtkPolyData>::New()), mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->SetInputData(data_);
  mapper_->UseLookupTableScalarRangeOn();
  mapper_->SetScalarModeToUseCellData();
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->LightingOff(); // the legend's colours
  actor_->PickableOff();
  actor_->VisibilityOff();
  renderer.AddActor(actor_);
}

void FaceMapActor::show(const FaceMap* map, const Eigen::Vector3d& block_mm) {
  actor_->SetVisibility(map != nullptr ? 1 : 0);
  if (map == nullptr) return;
  const std::vector<double> x = sides(map->low_mm.x(), map->high_mm.x(), map->values.rows(), block_mm.x());
  const std::vector<double> y = sides(map->low_mm.y(), map->high_mm.y(), map->values.cols(), block_mm.y());
  const double z = (1 + kAbove) * block_mm.z();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkFloatArray> values;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const double value = map->values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (!std::isfinite(value)) continue;
      std::array<vtkIdType, 4> corners{};
      corners[0] = points->InsertNextPoint(x[i], y[j], z);
      corners[1] = points->InsertNextPoint(x[i + 1], y[j], z);
      corners[2] = points->InsertNextPoint(x[i + 1], y[j + 1], z);
      corners[3] = points->InsertNextPoint(x[i], y[j + 1], z);
      cells->InsertNextCell(4, corners.data());
      values->InsertNextValue(static_cast<float>(map->colors.share(value)));
    }
  ColorScale shares = map->colors;
  shares.low = 0;
  shares.high = 1;
  shares.logarithmic = false;
  data_->SetPoints(points);
  data_->SetPolys(cells);
  data_->GetCellData()->SetScalars(values);
  data_->Modified();
  mapper_->SetLookupTable(lookupTable(shares));
}

} // namespace palp
