#pragma once

#include "model/base/Error.h"

namespace palp {

/// Data or options from which no network can be made; the text says what, which value and what is allowed.
struct NetworkError : Error {
  using Error::Error;
};

} // namespace palp
