#pragma once

#include <stop_token>
#include <thread>

namespace palp {

/// Turns Ctrl-C (and a polite kill) into a stop request while it lives. A second Ctrl-C ends the process immediately,
/// and so does a second in which the work has not ended, as where a library cannot be interrupted. One at a time.
class Interrupt {
public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

private:
  std::stop_source source_;
  std::jthread waiter_;
};

} // namespace palp
