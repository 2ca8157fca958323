#pragma once

#include "app/scenes/block/Overlay.h"
#include "model/LoadCase.h"

#include <Eigen/Core>

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkPolyData;
class vtkRenderer;

namespace palp {

/// A force and the drawn place that it acts on.
struct PlacedForce {
  Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  int load = 0;        ///< place in the load case: areas first, then patches, then indenters
  bool hidden = false; ///< on the part that is cut away
  bool movable = true; ///< by the mouse: the load gives it, not the solve

  /// The end of its arrow that is not on the surface: a push ends on the surface, a pull starts there.
  [[nodiscard]] Eigen::Vector3d freeEnd_mm(double mmPerN) const;
};

/// The scale at which the largest force has the given length.
double arrowScale_mmPerN(const std::vector<PlacedForce>& forces, double largest_mm);

/// One arrow a force, all to one scale.
class ForceArrows {
public:
  explicit ForceArrows(vtkRenderer& renderer);

  /// Each newton has the given length.
  /// `fixedDigits`: forces that change from frame to frame keep their decimals.
  void showToScale(const std::vector<PlacedForce>& forces, double mm_per_N, const Color& color,
                   bool fixedDigits = false);
  /// The forces as text, each at its arrow's free end.
  [[nodiscard]] const std::vector<PlacedText>& words() const { return words_; }

private:
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkActor> actor_;
  std::vector<PlacedText> words_;
};

} // namespace palp
