#include "app/gui/views/UprightCamera.h"

#include <vtkCamera.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {

vtkStandardNewMacro(UprightCamera)

    void UprightCamera::Rotate() {
  if (CurrentRenderer == nullptr) return;
  const int* size = CurrentRenderer->GetSize();
  const int* now = Interactor->GetEventPosition();
  const int* before = Interactor->GetLastEventPosition();
  vtkCamera& camera = *CurrentRenderer->GetActiveCamera();
  const double* focus = camera.GetFocalPoint();
  const double* eye = camera.GetPosition();
  const double* up = camera.GetViewUp();
  const double x = eye[0] - focus[0], y = eye[1] - focus[1], z = eye[2] - focus[2];
  const double distance = std::hypot(x, y, z), aside = std::hypot(x, y);
  // Straight from above or below only the upper edge of the view shows which direction is ahead.
  const double azimuth =
      aside > 1e-6 * distance ? std::atan2(y, x) : (z > 0 ? std::atan2(-up[1], -up[0]) : std::atan2(up[1], up[0]));
  constexpr double kTurn = std::numbers::pi; // for a drag across the view
  const double phi = azimuth - kTurn * (now[0] - before[0]) / std::max(size[0], 1);
  const double theta =
      std::clamp(std::atan2(aside, z) + kTurn * (now[1] - before[1]) / std::max(size[1], 1), 0.0, std::numbers::pi);
  camera.SetPosition(focus[0] + distance * std::sin(theta) * std::cos(phi),
                     focus[1] + distance * std::sin(theta) * std::sin(phi), focus[2] + distance * std::cos(theta));
  camera.SetViewUp(-std::cos(theta) * std::cos(phi), -std::cos(theta) * std::sin(phi), std::sin(theta));
  CurrentRenderer->ResetCameraClippingRange();
  Interactor->Render();
}

} // namespace palp
