#pragma once

#include "tests/app/study/live/LiveFixture.h"

#include <map>

namespace palp {

inline constexpr double kGood = 5e-6;  ///< noise of a good board, relative
inline constexpr double kPlain = 1e-4; ///< and of a plain one

/// A network for boards of this noise, trained once.
inline const Decoder& decoderFor(double noise) {
  static std::map<double, Decoder> decoders;
  if (!decoders.contains(noise)) decoders.emplace(noise, liveDecoder(noise));
  return decoders.at(noise);
}

/// The paper's sensor under the touch that moves.
inline VirtualStream streamWith(const BoardDisturbance& disturbance, std::uint64_t seed = 3) {
  VirtualBoard board = simulatedBoard(shippedSamples(), disturbance, 1000, seed);
  const BoardConfiguration configuration = board.configuration();
  return {std::move(board), configuration};
}

inline BoardDisturbance noisy(double noise) {
  BoardDisturbance disturbance;
  disturbance.noise = noise;
  return disturbance;
}

} // namespace palp
