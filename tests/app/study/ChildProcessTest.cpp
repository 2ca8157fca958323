#include "app/study/ChildProcess.h"

#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <gtest/gtest.h>

#include <csignal>
#include <vector>

namespace palp {
namespace {

ChildRun shell(const std::string& script, double limit_s = 60, const std::stop_token& stop = {}) {
  const ScratchFolder folder;
  return runChild({"/bin/sh", {"-c", script}, folder.path(), {"PALP_WORD=from us"}, limit_s}, stop);
}

TEST(ChildProcess, GivesItsOutputAndWorksInItsFolderAndEnvironment) {
  const ScratchFolder folder;
  const ChildRun run =
      runChild({"/bin/sh", {"-c", "echo $PALP_WORD; touch here"}, folder.path(), {"PALP_WORD=a b"}}, {});
  EXPECT_EQ(run.failed, "");
  EXPECT_EQ(run.output, "a b\n");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "here"));
}

TEST(ChildProcess, ThatFailsSaysItsLastWords) {
  EXPECT_EQ(shell("echo first >&2; echo last words >&2; exit 3").failed, "status 3: last words");
  EXPECT_EQ(shell("kill -9 $$").failed, "ended by signal 9");
  EXPECT_THROW(runChild({"/no/such/program", {}, "/tmp", {}}, {}), Error);
}

TEST(ChildProcess, IsEndedAfterItsLimitAndOnARequest) {
  EXPECT_EQ(shell("sleep 60", 0.05).failed, "ended after 0 s");
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(shell("sleep 60", 60, source.get_token()).failed, "cancelled");
}

TEST(ChildProcess, ThatCannotBeWaitedForHasNotSucceeded) {
  const auto before = std::signal(SIGCHLD, SIG_IGN); // as some daemons leave it to what they start
  const ChildRun run = shell("exit 3");
  std::signal(SIGCHLD, before);
  EXPECT_NE(run.failed.find("its exit status is unknown"), std::string::npos) << run.failed;
}

TEST(ChildProcess, HoldsItsOwnMemoryAndNotThatOfItsParent) {
  const std::vector<char> ours(300'000'000, 1);
  const ChildRun run = shell("sleep 0.1");
  EXPECT_GT(run.peak_MB, 0);
  EXPECT_LT(run.peak_MB, 100) << ours.size() << " bytes are its parent's";
}

} // namespace
} // namespace palp
