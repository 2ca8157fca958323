#include "model/base/Base64.h"

#include <cstdint>

namespace palp {

namespace {

constexpr std::string_view kBase64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

} // namespace

std::string base64(std::span<const unsigned char> bytes) {
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t group = static_cast<std::uint32_t>(bytes[i]) << 16U |
                                (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8U : 0U) |
                                (left > 2 ? static_cast<std::uint32_t>(bytes[i + 2]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) result += k <= left ? kBase64Digits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return result;
}

std::optional<std::vector<unsigned char>> fromBase64(std::string_view text) {
  if (text.size() % 4 != 0) return {};
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  std::vector<unsigned char> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    for (std::size_t k = i; k < i + 4; ++k) {
      const std::size_t digit = k < text.size() - padding ? kBase64Digits.find(text[k]) : 0;
      if (digit == std::string_view::npos) return {};
      group = group << 6U | static_cast<std::uint32_t>(digit);
    }
    for (unsigned shift = 16;; shift -= 8) {
      bytes.push_back(static_cast<unsigned char>(group >> shift & 255U));
      if (shift == 0) break;
    }
  }
  bytes.resize(bytes.size() - padding);
  return bytes;
}

} // namespace palp
