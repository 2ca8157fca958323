#include "app/cli/Interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>
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

} // namespace

Interrupt::Interrupt() {
  interrupts = 0;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, count);
  waiter_ = std::jthread([source = source_](const std::stop_token& ended) mutable {
    while (!ended.stop_requested()) {
      if (interrupts > 0) source.request_stop();
      std::this_thread::sleep_for(kTick);
    }
  });
}

Interrupt::~Interrupt() {
  waiter_.request_stop();
  waiter_.join();
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

} // namespace palp
