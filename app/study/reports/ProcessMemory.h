#pragma once

namespace palp {

/// Memory that the process holds [MB].
double heldMemory_MB();

/// The most that the process held since resetPeakMemory(), or since its start where the system cannot reset it [MB].
/// rusage's ru_maxrss would be at least that of the process that started this one.
double peakMemory_MB();
/// Starts watching the peak again.
void resetPeakMemory();

} // namespace palp
