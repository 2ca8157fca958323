#pragma once

#include "model/SensorDesign.h"

namespace palp {

/// The design with another size of its block, all wires, electrodes and depths in the same shares of it as before,
/// rounded to a millionth of a micrometre. Evenly spaced places stay so.
SensorDesign scaledTo(const SensorDesign& design, const Eigen::Vector3d& block_mm);

} // namespace palp
