#pragma once

#include "app/gui/project/ViewSettings.h"
#include "app/scenes/charts/Heatmap.h"
#include "model/SensorDesign.h"

namespace palp {

/// A design's resistances under a load as a heatmap: R [ohm], R - R at rest [ohm], or its share of R at rest [%]; that
/// share too for LessKept.
HeatmapSpec resistanceHeatmap(const SensorDesign& design, const Eigen::MatrixXd& resistances_ohm, ResistanceKind kind);

/// The shares [%] of a design less those of a kept one with as many wires.
HeatmapSpec heatmapLessKept(const Eigen::MatrixXd& shares, const Eigen::MatrixXd& kept);

} // namespace palp
