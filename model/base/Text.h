#pragma once

#include <string>

namespace palp {

/// Shortest text that reads back as the same number: "0.499", "1e-09", "nan".
std::string text(double value);

} // namespace palp
