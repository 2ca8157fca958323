#pragma once

#include <chrono>

namespace palp {

/// Seconds of the host's monotonic clock.
inline double hostClock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace palp
