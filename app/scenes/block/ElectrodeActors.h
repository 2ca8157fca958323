#pragma once

#include "app/scenes/block/DeformationScene.h"
#include "app/scenes/block/Overlay.h"
#include "app/scenes/block/Polylines.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

namespace palp {

/// Electrodes as spheres of one colour at places [mm].
class Spheres {
public:
  Spheres(vtkRenderer& renderer, double radius_mm);

  void set(const Eigen::Matrix3Xd& places_mm, const Color& color);
  void setVisible(bool visible);

private:
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkActor> actor_;
};

/// Both layers: wires as tubes, electrodes as spheres, the electrodes of one cell lit.
class ElectrodeActors {
public:
  explicit ElectrodeActors(vtkRenderer& renderer);

  /// Drawn displacements 3 x electrodes, already multiplied by the deformation scale.
  void show(const SensorDesign& design, const Eigen::Matrix3Xd& upper_mm, const Eigen::Matrix3Xd& lower_mm,
            const DeformationOptions& options);
  /// The electrodes of the chosen cell as drawn, each with what it is.
  [[nodiscard]] const std::vector<PlacedText>& lit() const { return litWords_; }

private:
  Polylines rowWires_;
  Polylines columnWires_;
  Spheres upper_;
  Spheres lower_;
  Spheres lit_;
  std::vector<PlacedText> litWords_;
};

} // namespace palp
