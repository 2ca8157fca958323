#pragma once

#include "model/TouchRange.h"

#include <QString>

#include <cstdint>
#include <optional>

namespace palp {

inline constexpr int kFewestTouches = 20, kMostTouches = 100000; ///< of a set of samples

/// Random touches of an indenter, anywhere on the top face except close to its sides.
struct TouchSampling {
  int count = 500; ///< for training, and as many for testing
  IndenterShape shape = IndenterShape::Sphere;
  double smallest_mm = 3, largest_mm = 6; ///< radius, but of a plane
  double rim_mm = 0.5;                    ///< of a punch alone
  double leastPress_N = 0.5, mostPress_N = 6;
  double leastFriction = 0, mostFriction = 0;
  double margin_mm = 3; ///< of the places, from the sides of the block
  bool operator==(const TouchSampling&) const = default;
};

/// The touches that palp sample draws by default.
TouchSampling usualTouches(const SensorDesign& design);
TouchRange rangeOf(const TouchSampling& touches, const SensorDesign& design);

/// Which samples the Network scene makes.
struct SampleSettings {
  int perArea = 100;
  std::uint64_t seed = 1;
  bool surrogate = false;                 ///< per-area polynomial instead of full solves
  std::optional<TouchSampling> touches{}; ///< in place of forces on areas

  bool operator==(const SampleSettings&) const = default;
};

/// "100 an area", "500 touches".
QString countWords(const SampleSettings& samples);

} // namespace palp
