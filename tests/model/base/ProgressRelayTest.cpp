#include "model/base/ProgressRelay.h"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>
#include <thread>
#include <vector>

namespace palp {
namespace {

// The other thread's call must return while the callback runs: under a lock held while calling out it never would.
TEST(ProgressRelay, HoldsNoLockWhileItCallsOut) {
  std::vector<std::size_t> calls;
  std::promise<void> callbackRuns, otherReturned;
  bool returnedMeanwhile = false;
  ProgressRelay relay([&](std::size_t count) {
    calls.push_back(count);
    if (calls.size() > 1) return;
    callbackRuns.set_value();
    returnedMeanwhile = otherReturned.get_future().wait_for(std::chrono::seconds(10)) == std::future_status::ready;
  });
  std::jthread other([&] {
    callbackRuns.get_future().wait();
    relay.add(5);
    otherReturned.set_value();
  });
  relay.add(3);
  other.join();
  EXPECT_TRUE(returnedMeanwhile);
  EXPECT_EQ(calls, (std::vector<std::size_t>{3, 5}));
}

TEST(ProgressRelay, HandsOverEveryCountOneCallAtATime) {
  std::size_t total = 0; // unguarded: calls never overlap
  ProgressRelay relay([&](std::size_t count) { total += count; });
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int i = 0; i < 1000; ++i) relay.add(1);
      });
  }
  EXPECT_EQ(total, 4000);
}

TEST(ProgressRelay, PassesAnExceptionOnAndCallsNoMore) {
  int calls = 0;
  ProgressRelay relay([&](std::size_t) {
    ++calls;
    throw std::runtime_error("no");
  });
  EXPECT_THROW(relay.add(1), std::runtime_error);
  relay.add(1);
  EXPECT_EQ(calls, 1);
}

} // namespace
} // namespace palp
