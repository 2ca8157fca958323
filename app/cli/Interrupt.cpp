#include "app/cli/Interrupt.h"

#include <csignal>
#include <ctime>
#include <unistd.h>

namespace palp {

namespace {

sigset_t handled() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

} // namespace

Interrupt::Interrupt() {
  const sigset_t signals = handled();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_ = std::jthread([source = source_](const std::stop_token& ended) mutable {
    const sigset_t waited = handled();
    while (!ended.stop_requested()) {
      const timespec tick{0, 50'000'000}; // 50 ms: far below the 0.3 s a cancel may take
      if (sigtimedwait(&waited, nullptr, &tick) < 0) continue;
      if (!source.request_stop()) _exit(130);
    }
  });
}

Interrupt::~Interrupt() {
  waiter_.request_stop();
  waiter_.join();
  const sigset_t signals = handled();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

} // namespace palp
