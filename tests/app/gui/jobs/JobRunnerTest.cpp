#include "app/gui/jobs/JobRunner.h"

#include "model/base/Error.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include <atomic>

namespace palp {
namespace {

/// Generous: the machine may be busy with other tests.
constexpr int kJobPatience_ms = 20000;

JobRunner::Work untilStopped(std::atomic<bool>& stopped) {
  return [&stopped](const std::stop_token& stop, JobProgress&) -> JobRunner::Taking {
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stopped = true;
    return {};
  };
}

TEST(JobRunner, TakesTheResultInTheWindowsThread) {
  JobRunner runner;
  const std::thread::id window = std::this_thread::get_id();
  std::thread::id worked;
  std::thread::id taken;
  runner.start("work", [&](const std::stop_token&, JobProgress&) -> JobRunner::Taking {
    worked = std::this_thread::get_id();
    return [&] { taken = std::this_thread::get_id(); };
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.running(); }, kJobPatience_ms));
  EXPECT_EQ(taken, window);
  EXPECT_NE(worked, window);
}

TEST(JobRunner, StopsWhatRunsForWhatComesAfterIt) {
  JobRunner runner;
  std::atomic<bool> stopped = false;
  int taken = 0;
  runner.start("first", untilStopped(stopped));
  for (int k = 1; k <= 5; ++k)
    runner.start("next", [&taken, k](const std::stop_token&, JobProgress&) { return [&taken, k] { taken = k; }; });
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.running(); }, kJobPatience_ms));
  EXPECT_TRUE(stopped);
  EXPECT_EQ(taken, 5) << "only the last of the waiting ones runs";
}

TEST(JobRunner, TakesNothingAfterACancel) {
  JobRunner runner;
  QSignalSpy finished(&runner, &JobRunner::finished);
  std::atomic<bool> stopped = false;
  bool taken = false;
  runner.start("work", [&](const std::stop_token& stop, JobProgress&) -> JobRunner::Taking {
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stopped = true;
    return [&] { taken = true; };
  });
  runner.cancel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return finished.count() == 1; }, kJobPatience_ms));
  EXPECT_TRUE(stopped);
  EXPECT_FALSE(taken);
  EXPECT_TRUE(finished[0][0].toBool()) << "says that it was cancelled";
}

TEST(JobRunner, SaysWhyWorkFailed) {
  JobRunner runner;
  QSignalSpy failed(&runner, &JobRunner::failed);
  runner.start("work", [](const std::stop_token&, JobProgress&) -> JobRunner::Taking {
    throw Error("area 7: allowed is 0 to 5");
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return failed.count() == 1; }, kJobPatience_ms));
  EXPECT_EQ(failed[0][0].toString(), "area 7: allowed is 0 to 5");
}

TEST(JobRunner, SaysWhyAResultCannotBeTakenAndRunsOn) {
  JobRunner runner;
  QSignalSpy failed(&runner, &JobRunner::failed);
  QSignalSpy finished(&runner, &JobRunner::finished);
  runner.start("work", [](const std::stop_token&, JobProgress&) -> JobRunner::Taking {
    return [] { throw Error("frames.csv: the file has gone"); };
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return finished.count() == 1; }, kJobPatience_ms));
  ASSERT_EQ(failed.count(), 1);
  EXPECT_EQ(failed[0][0].toString(), "frames.csv: the file has gone");
  bool taken = false;
  runner.start("work", [&](const std::stop_token&, JobProgress&) { return [&] { taken = true; }; });
  EXPECT_TRUE(QTest::qWaitFor([&] { return taken; }, kJobPatience_ms));
}

TEST(JobRunner, WhateverWorkThrowsIsSaid) {
  JobRunner runner;
  QSignalSpy failed(&runner, &JobRunner::failed);
  runner.start("work", [](const std::stop_token&, JobProgress&) -> JobRunner::Taking { throw 7; });
  EXPECT_TRUE(QTest::qWaitFor([&] { return failed.count() == 1; }, kJobPatience_ms));
}

TEST(JobRunner, EndsItsWorkWhenItIsDestroyed) {
  std::atomic<bool> stopped = false;
  {
    JobRunner runner;
    runner.start("work", untilStopped(stopped));
  }
  EXPECT_TRUE(stopped);
}

} // namespace
} // namespace palp
