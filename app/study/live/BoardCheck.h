#pragma once

#include "app/study/live/LiveSession.h"

#include <string>
#include <vector>

namespace palp {

/// One thing that a board must do by the protocol, and what it does.
struct BoardCheckResult {
  std::string what;
  bool passed = false;
  std::string found;
};

/// Judges a board by what it says of itself and by what it sent in `seconds`. `descriptor` is empty where nobody knows
/// it (a recording).
std::vector<BoardCheckResult> checkBoard(const LiveStatus& status, double seconds,
                                         const std::vector<std::uint8_t>& descriptor);

} // namespace palp
