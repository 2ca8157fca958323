#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace palp {

/// Latency of what comes from another clock: host time minus device time, above its minimum of the last seconds, so
/// that neither the clocks' offset nor their slow drift counts. In constant memory.
class LatencyMeter {
public:
  /// Takes one event; returns its latency [s].
  double add(double hostTime_s, double deviceTime_s);
  /// Takes one latency [s] that a single clock has measured.
  void addMeasured(double latency_s);
  /// The device's clock began anew.
  void restart();

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Latency [s] that this share (0..1) of the events stays below, to 5 %; 0 without events.
  [[nodiscard]] double quantile_s(double share) const;
  [[nodiscard]] double longest_s() const { return longest_s_; }

private:
  static constexpr std::size_t kBinsPerOctave = 14;
  static constexpr std::size_t kOctaves = 27; ///< 1 us to 134 s

  struct Second {
    double start_s;
    double least_s;
  };
  std::array<std::uint64_t, kBinsPerOctave * kOctaves> bins_{};
  std::deque<Second> seconds_;
  std::uint64_t count_ = 0;
  double longest_s_ = 0;
};

} // namespace palp
