#include "model/base/Text.h"

#include <array>
#include <charconv>

namespace palp {

std::string text(double value) {
  std::array<char, 32> buffer{};
  const std::to_chars_result result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

} // namespace palp
