#pragma once

#include <string>
#include <string_view>

namespace palp {

/// FNV-1a of the bytes, 64 bits as 16 hexadecimal digits: distinguishes files, does not protect them.
std::string fingerprint(std::string_view bytes);

} // namespace palp
