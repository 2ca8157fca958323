#pragma once

#include <stdexcept>

namespace palp {

/// Data or options from which no network can be made; the text says what, which value and what is allowed.
struct NetworkError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The work was stopped by a stop token before there was a result.
struct Cancelled : NetworkError {
  Cancelled() : NetworkError("cancelled") {}
};

} // namespace palp
