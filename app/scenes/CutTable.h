#pragma once

#include "app/scenes/block/DeformationScene.h"

#include <stop_token>
#include <string>

namespace palp {

/// The coloured field in the cut as it is drawn: one line a point where the plane meets the mesh's edges, its place at
/// rest [mm], its displacement [mm] and the value that its colour shows, with commas. Empty where there is no cut, no
/// solution or no colours. Throws Cancelled where it is stopped.
std::string cutCsv(const DeformationState& state, const DeformationOptions& options, const std::stop_token& stop = {});

} // namespace palp
