#include "model/base/Parallel.h"

#include <gtest/gtest.h>

#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace palp {
namespace {

class Threads : public testing::TestWithParam<int> {};

/// How often each of `count` places was worked on.
std::vector<int> visits(int count, int chunk, int threads) {
  std::vector<std::atomic<int>> visited(static_cast<std::size_t>(count));
  forChunks(count, chunk, threads, [&](int begin, int end) {
    EXPECT_LT(begin, end);
    EXPECT_LE(end - begin, chunk);
    EXPECT_EQ(begin % chunk, 0);
    for (int i = begin; i < end; ++i) ++visited[static_cast<std::size_t>(i)];
  });
  return {visited.begin(), visited.end()};
}

TEST_P(Threads, EachChunkIsWorkedOnOnce) {
  for (const int count : {1, 2, 7, 64, 1000})
    for (const int chunk : {1, 3, 64, 5000})
      EXPECT_EQ(visits(count, chunk, GetParam()), std::vector<int>(static_cast<std::size_t>(count), 1))
          << count << " by " << chunk;
}

TEST_P(Threads, NothingToDoCallsNobody) {
  forChunks(0, 4, GetParam(), [](int, int) { FAIL(); });
  inParallel(0, GetParam(), [](std::size_t) { FAIL(); });
}

TEST_P(Threads, EachIndexIsGivenOnce) {
  std::vector<std::atomic<int>> visited(100);
  inParallel(100, GetParam(), [&](std::size_t i) { ++visited[i]; });
  for (const std::atomic<int>& count : visited) EXPECT_EQ(count, 1);
}

TEST_P(Threads, NoMoreOfThemWorkThanWereAskedFor) {
  std::mutex guard;
  std::set<std::thread::id> seen;
  forChunks(200, 1, GetParam(), [&](int, int) {
    const std::lock_guard lock(guard);
    seen.insert(std::this_thread::get_id());
  });
  EXPECT_LE(seen.size(), static_cast<std::size_t>(threadCount(GetParam())));
  if (GetParam() == 1) {
    EXPECT_EQ(seen, std::set{std::this_thread::get_id()});
  }
}

TEST_P(Threads, AnExceptionOfAnyOfThemReachesTheCaller) {
  for (const int thrower : {0, 13, 99}) {
    try {
      forChunks(100, 1, GetParam(), [&](int begin, int) {
        if (begin == thrower) throw std::runtime_error("chunk " + std::to_string(begin));
      });
      FAIL() << "the exception was lost";
    } catch (const std::runtime_error& thrown) {
      EXPECT_EQ(std::string(thrown.what()), "chunk " + std::to_string(thrower));
    }
  }
}

TEST_P(Threads, WhereAllOfThemThrowOneExceptionIsCarriedAndNoThreadIsLeft) {
  std::atomic<int> working{0};
  for (int round = 0; round < 20; ++round) {
    const auto work = [&](int, int) {
      ++working;
      std::this_thread::yield();
      --working;
      throw std::bad_alloc(); // no error of ours: it must not end the program either
    };
    EXPECT_THROW(forChunks(100, 1, GetParam(), work), std::bad_alloc);
    EXPECT_EQ(working, 0);
  }
}

TEST_P(Threads, AfterAnExceptionNoNewChunkIsBegun) {
  std::atomic<int> begun{0};
  EXPECT_THROW(forChunks(1'000'000, 1, GetParam(),
                         [&](int, int) {
                           ++begun;
                           throw 1;
                         }),
               int);
  EXPECT_LE(begun, threadCount(GetParam())); // each thread's own first one
}

INSTANTIATE_TEST_SUITE_P(Number, Threads, testing::Values(0, 1, 2, 8),
                         [](const auto& one) { return "Of" + std::to_string(one.param); });

TEST(ThreadCount, IsWhatWasAskedForOrAllCores) {
  EXPECT_EQ(threadCount(3), 3);
  EXPECT_GE(threadCount(0), 1);
  EXPECT_EQ(threadCount(0), std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

} // namespace
} // namespace palp
