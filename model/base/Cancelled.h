#pragma once

#include <exception>
#include <stop_token>

namespace palp {

/// The work was stopped through its stop token before there was a result. Not a palp::Error: nobody made a mistake, and
/// code that reports bad input must not catch it.
struct Cancelled : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "cancelled"; }
};

/// Throws Cancelled if a stop was requested.
inline void throwIfStopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled();
}

} // namespace palp
