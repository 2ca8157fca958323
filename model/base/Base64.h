#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palp {

/// Base64 (RFC 4648).
std::string base64(std::span<const unsigned char> bytes);
/// Decodes; nullopt where the text is not base64.
std::optional<std::vector<unsigned char>> fromBase64(std::string_view text);

} // namespace palp
