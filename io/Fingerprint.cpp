#include "io/Fingerprint.h"

#include <cstdint>

namespace palp {

std::string fingerprint(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325; // http://www.isthe.com/chongo/tech/comp/fnv
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits.push_back("0123456789abcdef"[hash >> shift & 0xF]);
  return digits;
}

} // namespace palp
