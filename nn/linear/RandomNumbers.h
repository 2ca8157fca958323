#pragma once

// Private to nn.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace palp {

/// Random numbers that are the same with every standard library (its distributions are not).
class RandomNumbers {
public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  /// In 0..bound-1.
  std::uint64_t below(std::uint64_t bound) { return engine_() % bound; }
  /// Standard normal, by Box and Muller.
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

private:
  std::mt19937_64 engine_;
};

} // namespace palp
