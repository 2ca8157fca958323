#pragma once

#include "app/scenes/block/DeformationScene.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkPolyData;

namespace palp {

/// The indenters of a load, seen through, where they press: their tips move as far as the displacements are drawn. Of a
/// body that is large compared with the block its lowest part is drawn.
class IndenterActors {
public:
  explicit IndenterActors(vtkRenderer& renderer);

  void show(const DeformationState& state, double warp);
  /// One of them at another place or of another size, while it is dragged.
  void move(std::size_t indenter, const Indenter& to);
  /// As drawn.
  [[nodiscard]] const std::vector<Indenter>& indenters() const { return indenters_; }

private:
  void draw();

  std::vector<Indenter> indenters_;
  std::vector<Eigen::Vector3d> shifts_mm_; ///< drawn, of each one's tip from its place on the top face at rest
  Eigen::Vector3d block_mm_ = Eigen::Vector3d::Ones();
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkActor> actor_;
};

} // namespace palp
