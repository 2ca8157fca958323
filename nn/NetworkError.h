#pragma once

#include "model/base/Error.h"

namespace palp {

/// Data or options that no network can be made from; the text says what, which value and what is allowed.
struct NetworkError : Error {
  using Error::Error;
};

} // namespace palp
