#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <sstream>

using nlohmann::json;
using namespace palp::test;

namespace {

/// JSON Lines: an object a line.
std::vector<json> lines(const std::string& text) {
  std::vector<json> objects;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) objects.push_back(json::parse(line));
  return objects;
}

std::string samplesFile() {
  return PALP_SOURCE_DIR "/resources/board/paper-samples.csv";
}

TEST(ListenCommand, PrintsALineAFrameAndTheTotals) {
  const Outcome outcome = palp::test::palp({"listen", "--simulate", "--frames", "20", "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  const std::vector<json> objects = lines(outcome.output);
  ASSERT_GE(objects.size(), 21U);
  for (const char* key :
       {"t_s", "frame", "complete", "lost_reports", "forces_N", "standard_deviation_N", "valid", "latency_ms"})
    EXPECT_TRUE(objects[0].contains(key)) << key;
  EXPECT_TRUE(objects[0].at("valid").get<bool>());
  EXPECT_EQ(objects[0].at("forces_N").size(), 3U);
  const json& totals = objects.back();
  for (const char* key : {"frames", "reports", "lost_reports", "bad_reports", "peak_memory_MB", "warnings"})
    EXPECT_TRUE(totals.contains(key)) << key;
  EXPECT_GE(totals.at("frames").get<int>(), 20);
  EXPECT_TRUE(totals.at("latency_ms").contains("p99"));
  EXPECT_TRUE(totals.at("stages").empty()); // meshes and solves nothing
}

TEST(ListenCommand, RecordsAndReplays) {
  const palp::TemporaryFolder folder;
  const std::string file = (folder / "a.palprec").string();
  ASSERT_EQ(palp::test::palp({"listen", "--simulate", "--seconds", "1", "--record", file}).exit, 0);
  const Outcome again = palp::test::palp({"listen", "--simulate", "--seconds", "1", "--record", file});
  EXPECT_EQ(again.exit, 2);
  EXPECT_NE(again.errors.find("--force"), std::string::npos);
  const Outcome replay = palp::test::palp({"listen", "--replay", file, "--speed", "0", "--json"});
  ASSERT_EQ(replay.exit, 0) << replay.errors;
  const json totals = lines(replay.output).back();
  EXPECT_EQ(totals.at("state"), "ended");
  EXPECT_EQ(totals.at("lost_reports"), 0);
  EXPECT_GT(totals.at("reports").get<int>(), 100);
}

TEST(ListenCommand, ARecordingBeginsWithTheFirstReport) {
  const palp::TemporaryFolder folder;
  const std::string file = (folder / "a.palprec").string();
  const Outcome first = palp::test::palp({"listen", "--simulate", "--frames", "25", "--record", file, "--json"});
  ASSERT_EQ(first.exit, 0) << first.errors;
  const Outcome again = palp::test::palp({"listen", "--replay", file, "--speed", "0", "--json"});
  ASSERT_EQ(again.exit, 0) << again.errors;
  const std::vector<json> seen = lines(first.output), replayed = lines(again.output);
  EXPECT_GE(replayed.back().at("frames"), 25);
  EXPECT_EQ(replayed.back().at("reports"), seen.back().at("reports"));
  EXPECT_EQ(replayed.front().at("frame"), seen.front().at("frame"));
  EXPECT_EQ(replayed.front().at("t_s"), seen.front().at("t_s"));
}

TEST(ListenCommand, ChecksABoard) {
  const Outcome outcome = palp::test::palp({"listen", "--check", "--simulate", "--seconds", "3", "--json"});
  const json result = lines(outcome.output).back();
  for (const json& check : result.at("checks")) {
    if (check.at("what").get<std::string>().rfind("reports per second", 0) == 0) continue; // a busy machine is late
    EXPECT_TRUE(check.at("passed").get<bool>()) << check;
  }
}

TEST(ListenCommand, RefusesWhatCannotBe) {
  const auto refuses = [](std::vector<std::string> arguments, const std::string& word) {
    arguments.insert(arguments.begin(), "listen");
    const Outcome outcome = palp::test::palp(arguments);
    EXPECT_EQ(outcome.exit, 2) << outcome.errors;
    EXPECT_NE(outcome.errors.find(word), std::string::npos) << outcome.errors;
  };
  refuses({"--simulate", "--replay", "x"}, "exclude each other");
  refuses({"--simulate", "--check", "--record", "x"}, "records nothing");
  refuses({"--replay", "/nonexistent"}, "/nonexistent");
  refuses({"--replay", samplesFile()}, "not a recording");
  refuses({"--simulate", "--rate", "0"}, "--rate");
  refuses({"--simulate", "--noise", "x"}, "--noise");
  refuses({"--simulate", "--open-row", "10"}, "row-wire: got 10, expected 0 to 9");
  refuses({"--simulate", "--open-column", "30"}, "column-wire: got 30, expected 0 to 29");
  refuses({"--replay", "/nonexistent", "--noise", "1e-6"}, "--noise requires --simulate");
  refuses({"--simulate", "--usb", "12", "--list"}, "--usb");
  refuses({"--simulate", "--label", "0:0,0,-1"}, "--append");
  refuses({"--simulate", "--hold", "6:0,0,-1"}, "--hold (area): got '6'");
  refuses({"--simulate", "--hold", "0:0,0,-60"}, "--hold 0:0,0,-60: Fz is outside of the samples");
  refuses({"--hold", "0:0,0,-1"}, "--hold requires --simulate");
  refuses({"--simulate", "--network", samplesFile()}, "paper-samples.csv");
}

TEST(ListenCommand, TheVirtualBoardCanBeHeld) {
  const Outcome outcome =
      palp::test::palp({"listen", "--simulate", "--hold", "2:0.4,-0.3,-4", "--frames", "5", "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  int frames = 0;
  for (const json& line : lines(outcome.output)) {
    if (!line.contains("forces_N")) continue;
    ++frames;
    EXPECT_EQ(line.at("area"), 2);
    EXPECT_NEAR(line.at("forces_N")[0], 0.4, 0.1);
    EXPECT_NEAR(line.at("forces_N")[2], -4, 0.3);
  }
  EXPECT_EQ(frames, 5);
}

TEST(ListenCommand, EndsWithoutAResultWhereNoBoardIs) {
  const Outcome outcome = palp::test::palp({"listen", "--usb", "1209:0fff", "--seconds", "0.3", "--json"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_EQ(lines(outcome.output).back().at("reports"), 0);
}

TEST(CalibrateCommand, RefinesANetworkWithFramesOfTheBoard) {
  const palp::TemporaryFolder folder;
  const std::string network = (folder / "network.json").string();
  const std::string frames = (folder / "frames.csv").string();
  ASSERT_EQ(palp::test::palp(
                {"train", samplesFile(), "--input", "resistance", "--noise", "1e-4", "--spread", "2", "-o", network})
                .exit,
            0);
  for (int i = 0; i < 8; ++i) { // the simulated board rests: the label says so, this network reads something else
    const Outcome outcome =
        palp::test::palp({"listen", "--simulate", "--network", network, "--label", std::to_string(i % 6) + ":0,0,0",
                          "--append", frames, "--average", "2", "--seed", std::to_string(i), "--force"});
    ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  }
  const Outcome again = palp::test::palp({"listen", "--simulate", "--network", network, "--label", "1:0,0,0",
                                          "--append", frames, "--average", "2", "--seed", "7", "--force"});
  EXPECT_EQ(again.exit, 2);
  EXPECT_NE(again.errors.find("(sample 8 of 8); it would count twice"), std::string::npos) << again.errors;
  const std::string better = (folder / "better.json").string();
  const Outcome outcome = palp::test::palp({"calibrate", network, frames, "-o", better, "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  const json result = outcome.json();
  EXPECT_EQ(result.at("samples"), 8);
  EXPECT_FALSE(result.at("warnings").empty()); // rest alone covers no force
  EXPECT_TRUE(std::filesystem::exists(better));
  EXPECT_EQ(palp::test::palp({"calibrate", network, frames, "-o", better}).exit, 2); // no --force
}

} // namespace
