#include "app/study/live/BoardWatch.h"

#include "io/board/Hotplug.h"

namespace palp {

namespace {

constexpr auto kWait = std::chrono::milliseconds(100);

} // namespace

BoardWatch::BoardWatch(BoardAccess access)
    : access_(std::move(access)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::vector<HidBoard> BoardWatch::boards() const {
  const std::lock_guard lock(mutex_);
  return boards_;
}

void BoardWatch::run(const std::stop_token& stop) {
  Hotplug hotplug;
  while (!stop.stop_requested()) {
    const bool changed = hotplug.wait(kWait);
    if (looks_ > 0 && (quiet_ || !changed)) continue;
    std::vector<HidBoard> boards = access_.list();
    const std::lock_guard lock(mutex_);
    boards_ = std::move(boards);
    ++looks_;
  }
}

} // namespace palp
