#include "model/base/NumberText.h"

#include <array>
#include <charconv>

namespace palp {

namespace {

constexpr std::size_t kLongest = 512; ///< characters of the largest double with decimals

std::string formatted(double value, std::chars_format format, int precision) {
  std::array<char, kLongest> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, precision).ptr};
}

std::string_view withoutBlanks(std::string_view words) {
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t first = words.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return words.substr(first, words.find_last_not_of(kBlanks) - first + 1);
}

} // namespace

std::string withDigits(double value, int digits) {
  return formatted(value, std::chars_format::general, digits);
}

std::string withDecimals(double value, int decimals) {
  return formatted(value, std::chars_format::fixed, decimals);
}

std::string withExponent(double value, int decimals) {
  return formatted(value, std::chars_format::scientific, decimals);
}

std::string withSign(std::string number) {
  return number.starts_with('-') ? number : "+" + number;
}

std::optional<double> numberIn(std::string_view text) {
  std::string_view digits = withoutBlanks(text);
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1); // from_chars takes no plus
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return {};
  return value;
}

} // namespace palp
