#pragma once

#include "model/base/Error.h"

namespace palp {

/// Data or options that no network can be made from; the text names the fault, the value and the expected range.
struct NetworkError : Error {
  using Error::Error;
};

} // namespace palp
