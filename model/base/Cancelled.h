#pragma once

#include <exception>
#include <stop_token>

namespace palp {

/// The work was stopped by a stop token before there was a result. No palp::Error: nobody made a mistake, and nothing
/// that refuses bad input may catch it.
struct Cancelled : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return "cancelled"; }
};

/// Throws Cancelled where it was asked to stop.
inline void stopIfAsked(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled();
}

} // namespace palp
