#pragma once

#include "io/Decoder.h"

#include <ostream>

namespace palp {

/// In the names of the tests.
inline void PrintTo(DecoderKind kind, std::ostream* out) {
  *out << name(kind);
}

} // namespace palp
