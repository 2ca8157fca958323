#include "app/study/live/BoardWatch.h"

#include "app/study/Failure.h"
#include "io/board/Hotplug.h"

namespace palp {

namespace {

constexpr auto kWait = std::chrono::milliseconds(100);

} // namespace

BoardWatch::BoardWatch(BoardAccess access)
    : access_(std::move(access)), thread_([this](const std::stop_token& stop) {
        try {
          run(stop);
        } catch (...) { // what goes wrong before it looks for boards
          const std::lock_guard lock(mutex_);
          problem_ = failureInWords(std::current_exception());
        }
      }) {}

std::vector<HidBoard> BoardWatch::boards() const {
  const std::lock_guard lock(mutex_);
  return boards_;
}

std::string BoardWatch::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void BoardWatch::run(const std::stop_token& stop) {
  Hotplug hotplug;
  std::vector<std::string> nodes;
  while (!stop.stop_requested()) {
    const bool changed = hotplug.wait(kWait);
    if (looks_ > 0 && !changed) continue;
    std::vector<HidBoard> boards;
    std::string problem;
    try {
      const std::vector<std::string> before = std::exchange(nodes, access_.nodes());
      if (looks_ > 0 && quiet_ && nodes == before) continue;
      boards = access_.list();
    } catch (...) { // the last resort of this thread: no boards, and why
      problem = failureInWords(std::current_exception());
    }
    const std::lock_guard lock(mutex_);
    boards_ = std::move(boards);
    problem_ = std::move(problem);
    ++looks_;
  }
}

} // namespace palp
