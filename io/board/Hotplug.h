#pragma once

#include <chrono>
#include <memory>

namespace palp {

/// Reports when HID devices come and go: by libudev, or, where that does not answer, once a second.
class Hotplug {
public:
  Hotplug();
  ~Hotplug();
  Hotplug(const Hotplug&) = delete;
  Hotplug& operator=(const Hotplug&) = delete;

  /// Waits at most this long; true where the list of devices may have changed.
  bool wait(std::chrono::milliseconds timeout);
  /// By events; else by the clock.
  [[nodiscard]] bool byEvents() const;

private:
  struct Monitor;
  std::unique_ptr<Monitor> monitor_;
  std::chrono::steady_clock::time_point nextPoll_;
};

} // namespace palp
