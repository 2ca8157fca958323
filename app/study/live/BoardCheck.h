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

/// Checks a board's own description and what it sent in `seconds`. `descriptor` is empty where it is not known
/// it (a recording).
std::vector<BoardCheckResult> checkBoard(const LiveStatus& status, double seconds,
                                         const std::vector<std::uint8_t>& descriptor);

} // namespace palp
