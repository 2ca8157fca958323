#pragma once

#include <stdexcept>
#include <stop_token>

namespace palp {

/// Data or options from which no network can be made; the text says what, which value and what is allowed.
struct NetworkError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The work was stopped by a stop token before there was a result.
struct Cancelled : NetworkError {
  Cancelled() : NetworkError("cancelled") {}
};

/// Throws Cancelled where it was asked to stop.
inline void stopIfAsked(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled();
}

} // namespace palp
