#pragma once

#include "app/scenes/block/DeformationScene.h"
#include "app/scenes/block/Overlay.h"

namespace palp {

/// The largest and the smallest of the values at their places, of what stays where the block is cut as it is drawn;
/// none where the options ask for none, or where all are alike, as at rest. Not in the
/// colour of what was chosen: electrodes of the chosen cell are balls too.
std::vector<PlacedText> extremeMarks(const std::vector<double>& values, const Eigen::Matrix3Xd& drawn_mm,
                                     const DeformationOptions& options);

} // namespace palp
