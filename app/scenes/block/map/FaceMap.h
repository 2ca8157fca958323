#pragma once

#include "app/scenes/ColorScale.h"

#include <Eigen/Core>

#include <vtkActor.h>
#include <vtkSmartPointer.h>

class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;

namespace palp {

/// Values at a grid of places of the top face, drawn over it as coloured cells.
struct FaceMap {
  Eigen::MatrixXd values;                      ///< places along x x places along y; not a number: no cell
  Eigen::Vector2d low_mm{0, 0}, high_mm{0, 0}; ///< of the first and of the last place
  ColorScale colors;
  std::string title; ///< what it shows, in the view's first line
};

class FaceMapActor {
public:
  explicit FaceMapActor(vtkRenderer& renderer);

  /// On the face of a block of this size; null draws none.
  void show(const FaceMap* map, const Eigen::Vector3d& block_mm);

private:
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

} // namespace palp
