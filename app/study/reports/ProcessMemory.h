#pragma once

namespace palp {

/// Memory that the process holds [MB].
double heldMemory_MB();

/// The most that the process held since resetPeakMemory(), or since its start where the system cannot reset it [MB].
double peakMemory_MB();
/// Begins to watch the peak anew.
void resetPeakMemory();

} // namespace palp
