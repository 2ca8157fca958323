#pragma once

#include <stdexcept>

namespace palp {

/// Something outside the program is wrong (file, device, option): the text says what, where, which value and what is
/// allowed. The base of all our errors whose text is for the user.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace palp
