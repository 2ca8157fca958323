#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace palp {

/// The number of threads asked for; 0: all cores.
inline int threadCount(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls work(begin, end) for chunks of 0 .. count - 1, on several threads. Each chunk writes what is its own, so that
/// the result does not depend on the number of threads. `work` must not throw.
template <class Work> void forChunks(int count, int chunk, int threads, const Work& work) {
  const int chunks = (count + chunk - 1) / chunk;
  const int workers = std::min(threadCount(threads), chunks);
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int c = next++; c < chunks; c = next++) work(c * chunk, std::min(count, (c + 1) * chunk));
  };
  std::vector<std::jthread> others;
  for (int t = 1; t < workers; ++t) others.emplace_back(run);
  run();
}

} // namespace palp
