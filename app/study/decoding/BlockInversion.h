#pragma once

#include "io/Decoder.h"
#include "nn/RbfTrainer.h"

#include <stop_token>
#include <vector>

namespace palp {

/// Step 1 under the law of the field. Faces move with the electrodes, so R does not follow from a row-wire's own
/// electrodes alone; it is explained by the block's linear answers to a force on each area instead, electrodes and
/// faces together, by the exact sensitivities at rest: one Gauss-Newton step, with the variance of forces that are
/// uniform over their range as prior and the noise of the readings (at least 1e-6, for R is not quite linear).
/// Condition and rank go into the report. Throws DesignError where the design has a pressure law, Cancelled where it
/// was stopped.
BlockInversion blockInversion(const SensorDesign& design, const std::vector<int>& rows, double relativeNoise,
                              int threads, const std::stop_token& stop, FitReport& report);

} // namespace palp
