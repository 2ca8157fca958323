#pragma once

#include <cstdint>

namespace palp {

/// The finaliser of SplitMix64 (Steele, Lea, Flood, 2014): a hash that turns counters into random bits.
inline std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// Uniform in [0, 1), by counters alone: any sample can be made without those before it.
inline double uniformAt(std::uint64_t seed, std::uint64_t stream, std::uint64_t sample, std::uint64_t axis) {
  const std::uint64_t bits = mixBits(mixBits(mixBits(mixBits(seed) ^ stream) ^ sample) ^ axis);
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

} // namespace palp
