#include "app/study/live/BoardWatch.h"

#include "tests/app/study/live/PluggedBoard.h"

#include <gtest/gtest.h>

#include <mutex>
#include <stdexcept>

namespace palp {
namespace {

TEST(BoardWatch, SeesABoardThatIsPluggedInWhileAnotherStreams) {
  std::mutex mutex;
  std::vector<HidBoard> boards{{"/dev/hidraw0", "A", "", true}};
  std::atomic<int> lists{0};
  BoardAccess access;
  access.list = [&] {
    ++lists;
    const std::lock_guard lock(mutex);
    return boards;
  };
  access.nodes = [&] {
    const std::lock_guard lock(mutex);
    std::vector<std::string> names;
    for (const HidBoard& board : boards) names.push_back(board.path);
    return names;
  };
  BoardWatch watch(access);
  const auto until = [](const auto& condition) {
    while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  };
  until([&] { return watch.looked(); });
  watch.setQuiet(true);
  {
    const std::lock_guard lock(mutex);
    boards.push_back({"/dev/hidraw1", "B", "", true});
  }
  until([&] { return watch.boards().size() == 2; });
  const int before = lists;
  std::this_thread::sleep_for(std::chrono::milliseconds(1500)); // longer than it is between two looks at the devices
  EXPECT_EQ(lists, before) << "a board that streams is disturbed though nothing has changed";
}

TEST(BoardWatch, SaysWhyALookFailedAndLooksAgain) {
  auto broken = std::make_shared<std::atomic<bool>>(true);
  BoardAccess access;
  access.list = [broken]() -> std::vector<HidBoard> {
    if (*broken) throw std::runtime_error("no list");
    return {{"/dev/hidraw0", "A", "", true}};
  };
  const BoardWatch watch(access);
  const auto waitUntil = [](const auto& condition) {
    const double end_s = hostClock_s() + kPatience_s;
    while (!condition() && hostClock_s() < end_s) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return condition();
  };
  ASSERT_TRUE(waitUntil([&] { return watch.looked(); }));
  EXPECT_NE(watch.problem().find("no list"), std::string::npos);
  *broken = false;
  EXPECT_TRUE(waitUntil([&] { return watch.boards().size() == 1; }));
  EXPECT_EQ(watch.problem(), "");
}

} // namespace
} // namespace palp
