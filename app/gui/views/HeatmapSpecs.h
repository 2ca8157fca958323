#pragma once

#include "app/gui/jobs/TouchResistances.h"
#include "app/gui/project/ViewSettings.h"
#include "app/scenes/charts/Heatmap.h"

namespace palp {

/// Resistances under a load as a heatmap: R [ohm], R - R at rest [ohm], or its share of R at rest [%]; that share too
/// for LessReference.
HeatmapSpec resistanceHeatmap(const TouchResistances& resistances, ResistanceKind kind);

/// A sentence in their place: why there are none, empty while they are computed.
HeatmapSpec noResistancesYet(const QString& problem);

/// The same of a design; where its law has none a sentence in their place.
HeatmapSpec resistanceHeatmap(const SensorDesign& design, const ElectrodeDisplacements& electrodes,
                              ResistanceKind kind);

/// Relative changes [%] of a design minus those of another one with as many wires: "the reference design's".
HeatmapSpec heatmapLess(const Eigen::MatrixXd& difference_percent, const std::string& whose);

} // namespace palp
