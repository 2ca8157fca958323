#pragma once

#include "app/study/Median.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace palp {

/// Seconds that a piece of work takes.
template <class Work> double secondsOf(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Seconds of repeated runs; 0 where there was none.
struct Timing {
  std::vector<double> seconds;

  [[nodiscard]] double median() const { return seconds.empty() ? 0 : palp::median(seconds); }
  [[nodiscard]] double least() const { return seconds.empty() ? 0 : *std::min_element(seconds.begin(), seconds.end()); }
  [[nodiscard]] double most() const { return seconds.empty() ? 0 : *std::max_element(seconds.begin(), seconds.end()); }
};

/// Runs the work `times` times.
template <class Work> Timing timed(int times, Work&& work) {
  Timing timing;
  for (int i = 0; i < times; ++i) timing.seconds.push_back(secondsOf(work));
  return timing;
}

} // namespace palp
