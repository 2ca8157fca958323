#include "io/board/LatencyMeter.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kWindow_s = 10; // quartz clocks drift by less than 1 ms in it
constexpr double kShortest_s = 1e-6;

} // namespace

double LatencyMeter::add(double hostTime_s, double deviceTime_s) {
  const double offset_s = hostTime_s - deviceTime_s;
  if (seconds_.empty() || hostTime_s >= seconds_.back().start_s + 1) seconds_.push_back({hostTime_s, offset_s});
  while (seconds_.front().start_s < hostTime_s - kWindow_s) seconds_.pop_front();
  seconds_.back().least_s = std::min(seconds_.back().least_s, offset_s);
  double least_s = offset_s;
  for (const Second& second : seconds_) least_s = std::min(least_s, second.least_s);
  addMeasured(offset_s - least_s);
  return offset_s - least_s;
}

void LatencyMeter::addMeasured(double latency_s) {
  const double bin = static_cast<double>(kBinsPerOctave) * std::log2(std::max(latency_s, kShortest_s) / kShortest_s);
  ++bins_[std::min(static_cast<std::size_t>(bin), bins_.size() - 1)];
  ++count_;
  longest_s_ = std::max(longest_s_, latency_s);
}

void LatencyMeter::restart() {
  seconds_.clear();
}

double LatencyMeter::quantile_s(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < bins_.size() && count_ > 0; ++i) {
    below += bins_[i];
    if (below >= wanted)
      return std::min(longest_s_,
                      kShortest_s * std::exp2(static_cast<double>(i + 1) / static_cast<double>(kBinsPerOctave)));
  }
  return 0;
}

} // namespace palp
