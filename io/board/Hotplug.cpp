#include "io/board/Hotplug.h"

#include <libudev.h>
#include <poll.h>

#include <algorithm>
#include <thread>

namespace palp {

namespace {

constexpr auto kPollInterval = std::chrono::seconds(1);

struct Release {
  void operator()(udev* context) const { udev_unref(context); }
  void operator()(udev_monitor* monitor) const { udev_monitor_unref(monitor); }
  void operator()(udev_device* device) const { udev_device_unref(device); }
};

} // namespace

struct Hotplug::Monitor {
  std::unique_ptr<udev, Release> context{udev_new()};
  std::unique_ptr<udev_monitor, Release> monitor;

  Monitor() {
    if (!context) return;
    monitor.reset(udev_monitor_new_from_netlink(context.get(), "udev"));
    const bool works = monitor &&
                       udev_monitor_filter_add_match_subsystem_devtype(monitor.get(), "hidraw", nullptr) >= 0 &&
                       udev_monitor_enable_receiving(monitor.get()) >= 0;
    if (!works) monitor.reset();
  }
};

Hotplug::Hotplug() : monitor_(std::make_unique<Monitor>()), nextPoll_(std::chrono::steady_clock::now()) {}

Hotplug::~Hotplug() = default;

bool Hotplug::byEvents() const {
  return monitor_->monitor != nullptr;
}

bool Hotplug::wait(std::chrono::milliseconds timeout) {
  const auto now = std::chrono::steady_clock::now();
  bool changed = now >= nextPoll_; // also with events: a container may have libudev but no udev that sends them
  if (changed) nextPoll_ = now + kPollInterval;
  if (!byEvents()) {
    if (!changed) std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(timeout, nextPoll_ - now));
    return changed;
  }
  pollfd events{udev_monitor_get_fd(monitor_->monitor.get()), POLLIN, 0};
  while (::poll(&events, 1, changed ? 0 : static_cast<int>(timeout.count())) > 0) {
    const std::unique_ptr<udev_device, Release> device(udev_monitor_receive_device(monitor_->monitor.get()));
    if (!device) break;
    changed = true;
  }
  return changed;
}

} // namespace palp
