#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace palp {

/// The requested number of threads; 0: all cores.
inline int threadCount(int requested) {
  return requested > 0 ? requested : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls work(begin, end) for chunks of 0 .. count - 1, each once, from at most `threads` threads (0: all cores), the
/// caller's among them. Each chunk writes only what is its own, so the result does not depend on the number of threads.
/// The first exception of any thread is rethrown in the caller's thread once all threads have ended.
template <class Work> void forChunks(int count, int chunk, int threads, const Work& work) {
  const int chunks = (count + chunk - 1) / chunk;
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex guard; // of failure
  const auto run = [&] {
    try {
      // Relaxed: the counter orders nothing but itself, so that a race between two chunks stays one for the sanitizer.
      for (int c = next.fetch_add(1, std::memory_order_relaxed); c < chunks;
           c = next.fetch_add(1, std::memory_order_relaxed))
        work(c * chunk, std::min(count, (c + 1) * chunk));
    } catch (...) { // carried over to the caller's thread
      const std::lock_guard lock(guard);
      if (!failure) failure = std::current_exception();
      next = chunks;
    }
  };
  {
    const int workers = std::min(threadCount(threads), chunks);
    std::vector<std::jthread> others;
    try {
      for (int t = 1; t < workers; ++t) others.emplace_back(run);
    } catch (const std::system_error&) { // the system has no more threads: the existing ones do the work
    }
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

/// Calls work(i) for i = 0 .. count - 1, as forChunks does.
template <class Work> void inParallel(std::size_t count, int threads, const Work& work) {
  forChunks(static_cast<int>(count), 1, threads, [&](int i, int) { work(static_cast<std::size_t>(i)); });
}

} // namespace palp
