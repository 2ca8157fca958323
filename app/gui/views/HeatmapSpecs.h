#pragma once

#include "app/gui/project/ViewSettings.h"
#include "app/scenes/charts/Heatmap.h"
#include "app/study/touch/Touch.h"

namespace palp {

/// The touch's resistances as a heatmap: R [ohm], R - R at rest [ohm], or its share of R at rest [%].
HeatmapSpec resistanceHeatmap(const Touch& touch, const Eigen::MatrixXd& resistances_ohm, ResistanceKind kind);

} // namespace palp
