#pragma once

#include "model/SensorDesign.h"

namespace palp {

/// Returns all faults of the material, in the order of the design file, their keys beginning with "material.".
std::vector<DesignFault> check(const Material& material);

/// Returns a sentence where the law is not stable (Drucker) in one of the three tests (uniaxial, equibiaxial, planar)
/// between the stretches 0.5 and 2; nullopt where it is. A law that locks within is reported, too.
std::optional<std::string> stabilityWarning(const Material& material);

} // namespace palp
