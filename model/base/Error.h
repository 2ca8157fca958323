#pragma once

#include <stdexcept>

namespace palp {

/// A refusal by the outside (file, device, option): the text says what, where, which value and what is allowed.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A design or a load that cannot be built; the text names the key.
struct DesignError : Error {
  using Error::Error;
};

} // namespace palp
