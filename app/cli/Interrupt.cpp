#include "app/cli/Interrupt.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <unistd.h>

namespace palp {

namespace {

// A handler can reach nothing else. Blocking the signals and waiting for them would not do: threads that libraries
// start before main (OpenBLAS) take them with the default action, which is the end.
std::atomic<int> interrupts{0};

void count(int /*signal*/) {
  if (interrupts.fetch_add(1) > 0) _exit(130);
}

constexpr std::chrono::milliseconds kTick{20}; // far below the 0.3 s that a cancel may take
#ifdef PALP_SANITIZED
constexpr double kEndWithin_s = 10; // the same work takes many times as long there
#else
constexpr double kEndWithin_s = 0.9;
#endif

/// Processes per processor now: a polite end takes that many times as long.
double busyness() {
  constexpr double kMost = 4;
  double waiting = 1;
  ::getloadavg(&waiting, 1);
  return std::clamp(waiting / std::max(1U, std::thread::hardware_concurrency()), 1., kMost);
}

void waitForSignal(std::stop_source& source, const std::stop_token& ended) {
  std::optional<std::chrono::steady_clock::time_point> atLatest;
  while (!ended.stop_requested()) {
    if (interrupts > 0 && !atLatest) {
      source.request_stop();
      atLatest = std::chrono::steady_clock::now() +
                 std::chrono::milliseconds(static_cast<long>(1000 * kEndWithin_s * busyness()));
    }
    if (atLatest && std::chrono::steady_clock::now() > *atLatest) _exit(130);
    std::this_thread::sleep_for(kTick);
  }
}

} // namespace

Interrupt::Interrupt() {
  interrupts = 0;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, count);
  waiter_ = std::jthread([source = source_](const std::stop_token& ended) mutable { waitForSignal(source, ended); });
}

Interrupt::~Interrupt() {
  waiter_.request_stop();
  waiter_.join();
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

} // namespace palp
