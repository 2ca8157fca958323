#pragma once

#include <optional>
#include <string>

namespace palp {

/// A sentence where the BLAS in use is not OpenBLAS (the factorisation is then several times slower), and how to change
/// that; empty where it is.
std::optional<std::string> slowBlas();

} // namespace palp
