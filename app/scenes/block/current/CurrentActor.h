#pragma once

#include "app/scenes/ColorScale.h"
#include "app/scenes/block/current/CurrentLines.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;

namespace palp {

/// The current paths as coloured lines in the block.
class CurrentActor {
public:
  explicit CurrentActor(vtkRenderer& renderer);

  /// Displacements drawn this many times as large; null draws none.
  void show(const CurrentLines* current, double warp, const ColorScale& colors, double width_px);

private:
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

/// By factors: from what nearly all of the lines exceed to what they nearly nowhere do, over three decades at most.
ColorScale currentColors(const CurrentLines& current);

} // namespace palp
