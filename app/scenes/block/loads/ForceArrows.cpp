#include "app/scenes/block/loads/ForceArrows.h"

#include "model/base/NumberText.h"

#include <vtkArrowSource.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kSmall_N = 0.1;
constexpr double kRounding = 1e-9;
constexpr double kWordGap_mm = 0.7; // between an arrow's end and its words

/// Three digits; what is rounding compared with the other components is 0.
std::string forceText(const Eigen::Vector3d& force_N) {
  const double least_N = kRounding * force_N.norm();
  const Eigen::Array3d shown_N = (force_N.array().abs() < least_N).select(0, force_N.array());
  return "(" + withDigits(shown_N.x(), 3) + ", " + withDigits(shown_N.y(), 3) + ", " + withDigits(shown_N.z(), 3) +
         ") N";
}

/// Two decimals [N], three where the force is small.
std::string steadyText(const Eigen::Vector3d& force_N) {
  const int decimals = force_N.norm() < kSmall_N ? 3 : 2;
  const double step_N = std::pow(10, -decimals);
  const Eigen::Array3d shown_N = (force_N.array() / step_N).round() * step_N + 0.0; // no "-0.00"
  return "(" + withDecimals(shown_N.x(), decimals) + ", " + withDecimals(shown_N.y(), decimals) + ", " +
         withDecimals(shown_N.z(), decimals) + ") N";
}

constexpr double kWordsAbove_mm = 0.7; ///< the free end

} // namespace

Eigen::Vector3d PlacedForce::freeEnd_mm(double mmPerN) const {
  return force_N.z() < 0 ? Eigen::Vector3d(place_mm - mmPerN * force_N) : Eigen::Vector3d(place_mm + mmPerN * force_N);
}

double arrowScale_mmPerN(const std::vector<PlacedForce>& forces, double largest_mm) {
  double largest_N = 0;
  for (const PlacedForce& force : forces) largest_N = std::max(largest_N, force.force_N.norm());
  return largest_N > 0 ? largest_mm / largest_N : 1;
}

ForceArrows::ForceArrows(vtkRenderer& renderer)
    : data_(vtkSmartPointer<vtkPolyData>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  vtkNew<vtkArrowSource> arrow;
  arrow->SetTipResolution(24);
  arrow->SetShaftResolution(16);
  arrow->SetTipRadius(0.09);
  arrow->SetTipLength(0.28);
  arrow->SetShaftRadius(0.032);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data_);
  mapper->SetSourceConnection(arrow->GetOutputPort());
  mapper->SetOrientationArray("force");
  mapper->SetOrientationModeToDirection();
  mapper->SetScaleArray("force");
  mapper->SetScaleModeToScaleByMagnitude();
  actor_->SetMapper(mapper);
  actor_->PickableOff();
  renderer.AddActor(actor_);
}

void ForceArrows::showToScale(const std::vector<PlacedForce>& forces, double mm_per_N, const Color& color,
                              bool fixedDigits) {
  words_.clear();
  vtkNew<vtkPoints> starts;
  vtkNew<vtkDoubleArray> arrows;
  arrows->SetName("force");
  arrows->SetNumberOfComponents(3);
  for (const PlacedForce& force : forces) {
    if (force.hidden || !(force.force_N.norm() > 0)) continue;
    const Eigen::Vector3d far = force.freeEnd_mm(mm_per_N);
    const Eigen::Vector3d start = force.force_N.z() < 0 ? far : force.place_mm;
    const Eigen::Vector3d arrow = mm_per_N * force.force_N;
    starts->InsertNextPoint(start.data());
    arrows->InsertNextTuple(arrow.data());
    words_.push_back({far + Eigen::Vector3d(0, 0, kWordsAbove_mm),
                      fixedDigits ? steadyText(force.force_N) : forceText(force.force_N), color});
  }
  data_->SetPoints(starts);
  data_->GetPointData()->Initialize();
  data_->GetPointData()->AddArray(arrows);
  data_->Modified();
  actor_->SetVisibility(starts->GetNumberOfPoints() > 0 ? 1 : 0);
  actor_->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor_->GetProperty()->SetAmbient(0.3);
}

} // namespace palp
