#pragma once

#include "app/scenes/block/DeformationScene.h"

#include <string>
#include <vector>

namespace palp {

/// Nothing happened yet, or what is compared is not there.
bool nothingColoured(const DeformationState& state, const DeformationOptions& options);

/// The text over the block: what the colours are, how much larger displacements are drawn, the share of the load.
std::vector<std::string> sceneWords(const DeformationState& state, const DeformationOptions& options, double warp);

} // namespace palp
