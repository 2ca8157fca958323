#include "app/cli/Interrupt.h"

#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <csignal>

using nlohmann::json;
using namespace palp::test;

namespace {

/// Waits as long as it takes for the waiter's tick; a test that hangs here is ended by CTest.
void waitForStop(const std::stop_token& token) {
  while (!token.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

using Handler = void (*)(int);

Handler handlerOf(int signal) {
  struct sigaction now {};
  sigaction(signal, nullptr, &now);
  return now.sa_handler;
}

/// A coarse mesh and few samples: what is tested here is how the work ends.
const std::vector<std::string> kSmall{"--mapped", "4x4x2", "--per-area", "20", "--json"};

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Exit 130, one JSON object that names the command, and no internal error.
void expectCleanEnd(const Outcome& outcome, const std::string& command) {
  ASSERT_EQ(outcome.exit, 130) << outcome.errors << outcome.output;
  EXPECT_EQ(outcome.errors.find("internal error"), std::string::npos) << outcome.errors;
  const json result = json::parse(outcome.output, nullptr, false);
  ASSERT_FALSE(result.is_discarded()) << "no JSON: " << outcome.output;
  EXPECT_EQ(result.at("command"), command);
  EXPECT_TRUE(result.contains("stages"));
}

class InterruptedReport : public testing::TestWithParam<std::tuple<std::string, double>> {};

} // namespace

TEST(Interrupt, TurnsCtrlCAndAPoliteKillIntoAStopRequest) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const palp::Interrupt interrupt;
    EXPECT_FALSE(interrupt.token().stop_requested());
    std::raise(signal);
    waitForStop(interrupt.token());
  }
}

TEST(Interrupt, LeavesTheSignalsAsTheyWere) {
  {
    const palp::Interrupt interrupt;
    EXPECT_NE(handlerOf(SIGINT), SIG_DFL);
  }
  EXPECT_EQ(handlerOf(SIGINT), SIG_DFL);
  EXPECT_EQ(handlerOf(SIGTERM), SIG_DFL);
}

TEST(Interrupt, CountsFromItsOwnBeginning) {
  {
    const palp::Interrupt interrupt;
    std::raise(SIGINT);
    waitForStop(interrupt.token());
  }
  const palp::Interrupt next; // a second one ends the process only within one life
  std::raise(SIGINT);
  waitForStop(next.token());
}

TEST(InterruptDeathTest, ASecondCtrlCEndsTheProcessAtOnce) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        const palp::Interrupt interrupt;
        std::raise(SIGINT);
        std::raise(SIGINT);
      },
      testing::ExitedWithCode(130), "");
}

TEST(InterruptDeathTest, WorkThatDoesNotHearOfItIsEndedSoon) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        const palp::Interrupt interrupt;
        std::raise(SIGTERM);
        while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
      },
      testing::ExitedWithCode(130), "");
}

TEST_P(InterruptedReport, PrintsItsJsonAndLeavesNothing) {
  const auto& [words, share] = GetParam();
  const palp::TemporaryFolder folder;
  std::vector<std::string> arguments{words.substr(0, words.find(' ')), words.substr(words.find(' ') + 1)};
  const bool reproduce = arguments[0] == "reproduce";
  const std::vector<std::string> more = reproduce ? std::vector<std::string>{"--mapped", "4x4x2", "--json"} : kSmall;
  const Outcome outcome = palpInterruptedAt(joined(joined(arguments, more), {"-o", folder / "out"}), share);
  expectCleanEnd(outcome, arguments[0]);
  EXPECT_FALSE(std::filesystem::exists(folder / "out")) << "something was left";
}

// The shares lie in meshing and samples and in the trainings.
INSTANTIATE_TEST_SUITE_P(AtSeveralMoments, InterruptedReport,
                         testing::Values(std::tuple("reproduce all", 0.2), std::tuple("reproduce all", 0.73),
                                         std::tuple("reproduce all", 0.9), std::tuple("report networks", 0.1),
                                         std::tuple("report networks", 0.35), std::tuple("report networks", 0.45),
                                         std::tuple("report noise", 0.05), std::tuple("report noise", 0.3),
                                         std::tuple("report layout", 0.3), std::tuple("report map", 0.35),
                                         std::tuple("report map", 0.55), std::tuple("report stability", 0.1),
                                         std::tuple("report stability", 0.7), std::tuple("report error-time", 0.05),
                                         std::tuple("report error-time", 0.6)));

TEST(InterruptedCommand, PrintsItsJsonAndWritesNothing) {
  const palp::TemporaryFolder folder;
  const std::string samples = folder / "samples.csv";
  ASSERT_EQ(palp::test::palp({"sample", "paper", "--per-area", "60", "--mesh-size", "6", "-o", samples}).exit, 0);
  const std::string network = folder / "network.json";
  expectCleanEnd(palpInterruptedAt({"train", samples, "--decoder", "bp", "--json", "-o", network}, 0.01), "train");
  EXPECT_FALSE(std::filesystem::exists(network));
  expectCleanEnd(palpInterruptedAt({"sweep", samples, "--test", samples, "--json", "--spreads", "0.3:30:2000"}, 0.001),
                 "sweep");
  const std::string more = folder / "more.csv";
  expectCleanEnd(
      palpInterruptedAt({"sample", "paper", "--per-area", "2000", "--mesh-size", "6", "--json", "-o", more}, 0.01),
      "sample");
  EXPECT_FALSE(std::filesystem::exists(more)); // what was made waits in its part
}

TEST(InterruptedCommand, StopsWithinASolveAndWritesNoHalfLoad) {
  const palp::TemporaryFolder folder;
  // Hard and fine enough to still be at work when its output begins to wait for the solve.
  const std::string file = folder / "a.vtu";
  const Outcome outcome =
      palpInterruptedAfter({"solve", "paper", "--load", "0:1,0,-150", "--mesh-size", "1", "--json", "-o", file}, 700);
  expectCleanEnd(outcome, "solve");
  EXPECT_FALSE(std::filesystem::exists(file));
}
