#pragma once

#include "model/SensorDesign.h"

#include <optional>

namespace palp {

/// Electrodes of the field law that touch each other or a face of the block, or too many of them; the design's
/// electrodes lie inside the block.
std::optional<DesignFault> sphereFault(const SensorDesign& design);

} // namespace palp
