#pragma once

// Private to io/board: little-endian numbers in a report.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace palp {

/// `Bytes` bytes at `at` as an unsigned number, the lowest first.
template <std::size_t Bytes> std::uint32_t littleEndian(std::span<const std::uint8_t> report, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < Bytes; ++i) value |= static_cast<std::uint32_t>(report[at + i]) << (8 * i);
  return value;
}

template <std::size_t Bytes> void putLittleEndian(std::span<std::uint8_t> report, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < Bytes; ++i) report[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// Printable characters of a text field, up to its first zero byte.
inline std::string textField(std::span<const std::uint8_t> field) {
  std::string text;
  for (const std::uint8_t byte : field) {
    if (byte == 0) break;
    text.push_back(byte >= 0x20 && byte < 0x7F ? static_cast<char>(byte) : '?');
  }
  return text;
}

inline void putTextField(std::span<std::uint8_t> field, std::string_view text) {
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = i < text.size() ? static_cast<std::uint8_t>(text[i]) : 0;
}

} // namespace palp
