#include "app/gui/jobs/JobRunner.h"

#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

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
  runner.start("work", [](const std::stop_token&, JobProgress&) -> JobRunner::Taking {
    throw std::logic_error("a promise is broken");
  });
  EXPECT_TRUE(QTest::qWaitFor([&] { return failed.count() == 2; }, kJobPatience_ms));
  EXPECT_EQ(failed[1][0].toString(), "internal error: a promise is broken")
      << "no sentence of ours, and said to be none";
}

/// Saving cannot be stopped; `begun` is raised and then `go` waited for.
JobRunner::Work saving(std::vector<int>& saved, int number, std::atomic<bool>& begun, const std::atomic<bool>& go) {
  return [&saved, &begun, &go, number](const std::stop_token&, JobProgress&) -> JobRunner::Taking {
    begun = true;
    while (!go) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (number == 0) throw Error("a.json: cannot be written: No space left on device");
    return [&saved, number] { saved.push_back(number); };
  };
}

TEST(WriteQueue, CarriesOutEveryOrderAndSaysTheErrorOfTheFirst) {
  JobRunner runner(JobRunner::Orders::Each);
  QSignalSpy failed(&runner, &JobRunner::failed), finished(&runner, &JobRunner::finished);
  std::atomic<bool> begun = false, go = false;
  std::vector<int> saved;
  for (const int number : {0, 1, 2, 3}) runner.start("save", saving(saved, number, begun, go));
  go = true;
  ASSERT_TRUE(QTest::qWaitFor([&] { return finished.count() == 1; }, kJobPatience_ms));
  EXPECT_EQ(saved, (std::vector{1, 2, 3}));
  ASSERT_EQ(failed.count(), 1);
  EXPECT_TRUE(failed[0][0].toString().contains("No space left"));
}

TEST(WriteQueue, ACancelDropsOnlyWhatHasNotBegun) {
  JobRunner runner(JobRunner::Orders::Each);
  QSignalSpy dropped(&runner, &JobRunner::dropped), finished(&runner, &JobRunner::finished);
  std::atomic<bool> begun = false, go = false;
  std::vector<int> saved;
  runner.start("first", saving(saved, 1, begun, go));
  runner.start("second", saving(saved, 2, begun, go));
  ASSERT_TRUE(QTest::qWaitFor([&] { return begun.load(); }, kJobPatience_ms));
  runner.cancel();
  go = true;
  ASSERT_TRUE(QTest::qWaitFor([&] { return finished.count() == 1; }, kJobPatience_ms));
  EXPECT_EQ(saved, std::vector{1}) << "what is written is taken: the document is saved";
  ASSERT_EQ(dropped.count(), 1);
  EXPECT_EQ(dropped[0][0].toString(), "second");
  EXPECT_FALSE(finished[0][0].toBool());
}

TEST(WriteQueue, WorkThatStopsItselfIsSaidAndTheNextIsCarriedOut) {
  JobRunner runner(JobRunner::Orders::Each);
  QSignalSpy dropped(&runner, &JobRunner::dropped), failed(&runner, &JobRunner::failed);
  runner.start("export", [](const std::stop_token& stop, JobProgress&) -> JobRunner::Taking {
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    throw Cancelled();
  });
  runner.cancel();
  bool taken = false;
  runner.start("save", [&](const std::stop_token&, JobProgress&) { return [&] { taken = true; }; });
  ASSERT_TRUE(QTest::qWaitFor([&] { return taken; }, kJobPatience_ms));
  ASSERT_EQ(dropped.count(), 1);
  EXPECT_EQ(dropped[0][0].toString(), "export");
  EXPECT_EQ(failed.count(), 0);
}

TEST(JobRunner, EndsItsWorkWhenItIsDestroyed) {
  std::atomic<bool> stopped = false;
  {
    JobRunner runner;
    runner.start("work", untilStopped(stopped));
  }
  EXPECT_TRUE(stopped);
}

TEST(JobRunner, SaysThatWorkWouldBeLostOnlyWhileItRunsAndIsWanted) {
  JobRunner runner;
  std::atomic<bool> stopped = false;
  runner.start("a picture", untilStopped(stopped));
  EXPECT_EQ(runner.loss(), "") << "it is done again where it is needed";
  runner.start("samples", untilStopped(stopped), JobRunner::Loss::Work);
  EXPECT_TRUE(runner.loss().startsWith("samples: ")) << runner.loss().toStdString();
  ASSERT_TRUE(QTest::qWaitFor([&] { return runner.title() == "samples"; }, kJobPatience_ms));
  EXPECT_TRUE(runner.loss().startsWith("samples: "));
  runner.cancel();
  EXPECT_EQ(runner.loss(), "") << "it was given up";
}

} // namespace
} // namespace palp
