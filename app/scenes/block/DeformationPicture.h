#pragma once

#include "app/scenes/Picture.h"
#include "app/scenes/block/DeformationScene.h"

namespace palp {

/// The deformed block, with electrodes, areas, force arrows and legend, seen from the front, above and the left. With
/// no fields: the block at rest.
Picture drawDeformation(const DeformationState& state, const DeformationOptions& options = {}, int width = 1200,
                        int height = 800);

/// One row-wire in the block, its electrodes at rest and displaced (Figs. 6 and 7 of the paper); the displacements are
/// drawn `deformationScale` times as large, automatic where none is given. Without displacements: at rest alone.
Picture drawRowWire(const SensorDesign& design, int rowWire, const ElectrodeDisplacements* displacements,
                    std::optional<double> deformationScale = {}, int width = 1000, int height = 520,
                    Theme theme = Theme::Light);

} // namespace palp
