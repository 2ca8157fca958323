#pragma once

#include <stdexcept>

namespace palp {

/// Something outside the program is wrong (file, device, option): the text states what, where, which value and the
/// expected range. The base of all our errors whose text is for the user.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace palp
