#pragma once

// Private to the charts: how a chart is put before a renderer that draws it once.

#include "app/scenes/Palette.h"

#include <vtkSmartPointer.h>

class vtkChartXY;
class vtkRenderer;

namespace palp {

/// A renderer with the theme's ground that draws the chart, and holds it.
vtkSmartPointer<vtkRenderer> chartRenderer(vtkChartXY& chart, Theme theme);

} // namespace palp
