#pragma once

#include <vtkInteractorStyleTrackballCamera.h>

namespace palp {

/// Turns a view by the mouse so that up stays up: left and right about z, up and down as far as straight from above and
/// straight from below.
class UprightCamera : public vtkInteractorStyleTrackballCamera {
public:
  static UprightCamera* New();
  vtkTypeMacro(UprightCamera, vtkInteractorStyleTrackballCamera)

      void Rotate() override;
  /// Ctrl and a drag rolls a trackball; here it turns as well.
  void Spin() override { Rotate(); }
};

} // namespace palp
