#pragma once

#include "model/base/Error.h"

namespace palp {

/// A design or a load that cannot be built; the text names the key.
struct DesignError : Error {
  using Error::Error;
};

} // namespace palp
