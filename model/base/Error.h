#pragma once

#include <stdexcept>

namespace palp {

/// A refusal by the outside (file, device, option): the text says what, where, which value and what is allowed. The
/// base of every error of ours whose text is for the user.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace palp
