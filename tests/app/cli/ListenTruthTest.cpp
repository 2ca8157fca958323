// palp listen in plain text says what is wrong, and its exit status says it too.

#include "io/board/RecordingReader.h"
#include "io/board/RecordingWriter.h"
#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

using namespace palp::test;

namespace {

Outcome listen(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "listen");
  return palp::test::palp(arguments);
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// The whole text that a test may look into.
std::string all(const Outcome& outcome) {
  return "exit " + std::to_string(outcome.exit) + "\n" + outcome.output + "\n" + outcome.errors;
}

std::ptrdiff_t count(const std::string& text, const std::string& words) {
  std::ptrdiff_t times = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++times;
  return times;
}

TEST(ListenTruth, TheLastLineCounts) {
  const palp::TemporaryFolder folder;
  const std::string file = folder / "a.palprec";
  const Outcome outcome = listen({"--simulate", "--rate", "8000", "--frames", "40", "--record", file});
  EXPECT_EQ(outcome.exit, 0) << all(outcome);
  EXPECT_TRUE(says(outcome.output, "40 frames, 0 incomplete; 40 with a force, 0 of them implausible; "))
      << all(outcome);
  EXPECT_TRUE(says(outcome.output, " reports, 0 lost, 0 corrupt; ")) << all(outcome);
  EXPECT_TRUE(says(outcome.output, " reports written to " + file + ", 0 entries not written")) << all(outcome);
}

TEST(ListenTruth, WithoutAForceTheReasonIsThere) {
  const palp::TemporaryFolder folder;
  const std::string file = folder / "a.palprec";
  ASSERT_EQ(listen({"--simulate", "--rate", "8000", "--frames", "40", "--record", file}).exit, 0);
  const Outcome raw = listen({"--replay", file, "--speed", "0"});
  EXPECT_EQ(raw.exit, 0) << all(raw);
  EXPECT_TRUE(says(raw.output, "no force: no network")) << all(raw);
  const Outcome sent = listen({"--replay", file, "--speed", "0", "--send", "csv:" + (folder / "f.csv").string()});
  EXPECT_EQ(sent.exit, 1) << all(sent);
  EXPECT_TRUE(says(sent.errors, "--send: no forces were sent")) << all(sent);
}

TEST(ListenTruth, ANetworkThatDoesNotFitEndsWithStatusOne) {
  const palp::TemporaryFolder folder;
  const std::string samples = folder / "samples.csv", network = folder / "network.json";
  ASSERT_EQ(palp::test::palp({"sample", "paper", "--per-area", "20", "--mapped", "6x6x2", "-o", samples}).exit, 0);
  ASSERT_EQ(palp::test::palp({"train", samples, "-o", network}).exit, 0); // reads displacements
  const Outcome outcome = listen({"--simulate", "--rate", "8000", "--network", network, "--frames", "20"});
  EXPECT_EQ(outcome.exit, 1) << all(outcome);
  EXPECT_EQ(count(outcome.errors, "the network reads displacements"), 1) << all(outcome);
  EXPECT_TRUE(says(outcome.output, "no force: the network reads displacements")) << all(outcome);
}

TEST(ListenTruth, DoubtIsPrinted) {
  const Outcome outcome =
      listen({"--simulate", "--rate", "8000", "--hold", "3:0.8,0.5,-4", "--warming", "40", "--frames", "600"});
  EXPECT_EQ(outcome.exit, 0) << all(outcome);
  EXPECT_FALSE(says(outcome.output, " 0 of them implausible")) << all(outcome);
  EXPECT_TRUE(says(outcome.output, "of them implausible (")) << all(outcome);
  EXPECT_TRUE(says(outcome.output, "N  implausible: ")) << all(outcome);
}

/// The network that ships with Palp as one that was trained for another design.
std::string networkOfAnotherDesign(const palp::TemporaryFolder& folder) {
  nlohmann::json network = nlohmann::json::parse(readAll(PALP_SOURCE_DIR "/resources/board/paper-network.json"));
  network["design_fingerprint"] = "0123456789abcdef";
  writeAll(folder / "other.json", network.dump());
  return folder / "other.json";
}

TEST(ListenTruth, ANetworkOfAnotherDesignIsWarnedOf) {
  const palp::TemporaryFolder folder;
  const std::string words = "the network was trained for another design: its error is unknown";
  const std::vector<std::string> other{
      "--simulate", "--rate", "8000", "--frames", "20", "--network", networkOfAnotherDesign(folder)};
  const Outcome outcome = listen(other);
  EXPECT_EQ(outcome.exit, 0) << all(outcome);
  EXPECT_EQ(count(outcome.errors, words), 1) << all(outcome);
  EXPECT_TRUE(says(outcome.output, "deviations: " + words)) << all(outcome);
  std::vector<std::string> asJson = other;
  asJson.emplace_back("--json");
  const std::string lines = listen(asJson).output;
  const nlohmann::json totals = nlohmann::json::parse(lines.substr(lines.rfind('\n', lines.size() - 2) + 1));
  EXPECT_EQ(totals.at("deviation_note"), words);
  EXPECT_EQ(totals.at("warnings").at(0), words);
  const Outcome own = listen({"--simulate", "--rate", "8000", "--frames", "20"});
  EXPECT_FALSE(says(all(own), "the network")) << all(own);
}

/// A recording of a simulated board as that of a real one: its reports do not call themselves simulated.
void copyAsOfABoard(const std::filesystem::path& from, const std::filesystem::path& to) {
  palp::RecordingReader reader(from);
  palp::RecordingWriter writer(to, reader.head(), false);
  while (const auto entry = reader.next()) {
    const auto decoded = palp::decodeInput(entry->bytes, reader.head().info);
    if (const auto* readings = std::get_if<palp::Readings>(&decoded)) {
      palp::Readings real = *readings;
      real.flags &= static_cast<std::uint8_t>(~palp::ReadingFlag::Simulated);
      writer.append(entry->kind, entry->hostTime_s, palp::encode(real));
    }
  }
}

TEST(ListenTruth, AnUncalibratedNetworkIsWarnedOf) {
  const palp::TemporaryFolder folder;
  const std::string simulated = folder / "simulated.palprec", real = folder / "real.palprec";
  ASSERT_EQ(listen({"--simulate", "--rate", "8000", "--frames", "30", "--record", simulated}).exit, 0);
  copyAsOfABoard(simulated, real);
  const std::string words = "the network is not calibrated: the deviation includes noise and training error only";
  const auto replayed = [](const std::string& file) {
    return listen(
        {"--replay", file, "--speed", "0", "--network", PALP_SOURCE_DIR "/resources/board/paper-network.json"});
  };
  const Outcome outcome = replayed(real);
  EXPECT_EQ(outcome.exit, 0) << all(outcome);
  EXPECT_EQ(count(outcome.errors, words), 1) << all(outcome);
  EXPECT_TRUE(says(outcome.output, "deviations: " + words)) << all(outcome);
  EXPECT_FALSE(says(all(replayed(simulated)), "calibrated")) << "a simulated board has nothing to calibrate";
}

TEST(ListenTruth, ARecordingOnAFullDiskIsSaidAndEndsWithStatusOne) {
  const palp::TemporaryFolder folder;
  const std::string file = folder / "a.palprec";
  for (const char* frames : {"20", "400"}) { // shorter than the half second after which it is written, and longer
    const Outcome outcome = palpOnAFullDisk(
        {"listen", "--simulate", "--rate", "8000", "--record", file, "--frames", frames, "--force"}, 20'000);
    EXPECT_EQ(outcome.exit, 1) << all(outcome);
    EXPECT_EQ(count(outcome.errors, file + ": can no longer be written: File too large"), 1) << all(outcome);
    EXPECT_FALSE(says(outcome.output, ", 0 entries not written")) << all(outcome);
  }
}

TEST(ListenTruth, LinesOnAFullDiskAreWholeAndEndWithStatusOne) {
  const palp::TemporaryFolder folder;
  const std::string file = folder / "f.csv";
  const Outcome outcome =
      palpOnAFullDisk({"listen", "--simulate", "--rate", "8000", "--send", "csv:" + file, "--frames", "200"}, 5000);
  EXPECT_EQ(outcome.exit, 1) << all(outcome);
  EXPECT_EQ(count(outcome.errors, "csv:" + file + ": can no longer be written: File too large"), 1) << all(outcome);
  const std::string lines = readAll(file);
  ASSERT_GT(lines.size(), 1000U);
  EXPECT_LT(lines.size(), 5000U);
  EXPECT_EQ(lines.back(), '\n');
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 10) << line;
  const std::string sent = "csv:" + file + ": " + std::to_string(std::count(lines.begin(), lines.end(), '\n') - 1);
  EXPECT_TRUE(says(outcome.errors, sent + " frames passed to the system")) << all(outcome);
}

TEST(ListenTruth, ATareUnderALoadIsRefused) {
  const std::vector<std::string> words{"--simulate", "--rate", "8000",     "--hold", "0:0,0,-3",
                                       "--tare",     "20",     "--frames", "40"};
  const Outcome refused = listen(words);
  EXPECT_EQ(refused.exit, 2) << all(refused);
  EXPECT_TRUE(says(refused.errors, "--tare: the network predicts a steady (")) << all(refused);
  EXPECT_TRUE(says(refused.errors, "--force")) << all(refused);
  std::vector<std::string> anyway = words;
  anyway.emplace_back("--force");
  EXPECT_EQ(listen(anyway).exit, 0);
  EXPECT_EQ(listen({"--simulate", "--rate", "8000", "--hold", "0:0,0,0", "--tare", "20", "--frames", "40"}).exit, 0);
  const Outcome few = listen({"--simulate", "--rate", "8000", "--hold", "0:0,0,0", "--tare", "50", "--frames", "10"});
  EXPECT_EQ(few.exit, 1) << all(few);
  EXPECT_TRUE(says(few.errors, "--tare: not tared")) << all(few);
}

TEST(ListenTruth, ALabelThatTheNetworkContradictsIsRefused) {
  const palp::TemporaryFolder folder;
  const std::string frames = folder / "frames.csv";
  const auto label = [&](const std::string& held, const std::string& words, bool force = false) {
    std::vector<std::string> all{"--simulate", "--rate",   "8000", "--hold",    held, "--label",
                                 words,        "--append", frames, "--average", "20"};
    if (force) all.emplace_back("--force");
    return listen(all);
  };
  for (const auto& [words, reason] :
       {std::pair{"4:0,0,3", "other sign of Fz"}, std::pair{"4:0,0,0", "check that the sensor is at rest"},
        std::pair{"4:0,0,-0.5", "check that this load is on the sensor"}, std::pair{"1:0,0,-3", "area 4"}}) {
    const Outcome outcome = label("4:0,0,-3", words);
    EXPECT_EQ(outcome.exit, 2) << words << all(outcome);
    EXPECT_TRUE(says(outcome.errors, reason)) << words << all(outcome);
    EXPECT_FALSE(std::filesystem::exists(frames)) << words;
  }
  const Outcome nothing = label("4:0,0,0", "4:0,0,-3");
  EXPECT_EQ(nothing.exit, 2) << all(nothing);
  EXPECT_TRUE(says(nothing.errors, "as at rest")) << all(nothing);
  const Outcome right = label("4:0,0,-3", "4:0,0,-3.1");
  EXPECT_EQ(right.exit, 0) << all(right);
  EXPECT_TRUE(says(right.output, "1 labelled frame added to " + frames + ": the mean of 20")) << all(right);
  const Outcome anyway = label("4:0,0,-3", "4:0,0,3", true);
  EXPECT_EQ(anyway.exit, 0) << all(anyway);
  EXPECT_TRUE(says(anyway.errors, "added nevertheless")) << all(anyway);
}

TEST(ListenTruth, AMovingLoadIsNoLabelledFrame) {
  const palp::TemporaryFolder folder;
  const std::string frames = folder / "frames.csv";
  const Outcome outcome = listen({"--simulate", "--rate", "8000", "--label", "0:0,0,-3", "--append", frames,
                                  "--average", "800"}); // two seconds of the touch that moves
  EXPECT_EQ(outcome.exit, 2) << all(outcome);
  EXPECT_TRUE(says(outcome.errors, "moved")) << all(outcome);
  EXPECT_FALSE(std::filesystem::exists(frames));
}

TEST(ListenTruth, ADeviceThatIsNoBoardIsNamed) {
  const auto refuses = [](const std::string& device, const std::string& words) {
    const Outcome outcome = listen({"--device", device, "--seconds", "1"});
    EXPECT_EQ(outcome.exit, 2) << all(outcome);
    EXPECT_EQ(count(outcome.errors, "\n"), 1) << all(outcome);
    EXPECT_TRUE(says(outcome.errors, "--device: got '" + device + "', expected " + words)) << all(outcome);
  };
  refuses("/dev/hidraw77", "an existing device");
  refuses("/dev/tty", "a USB HID device /dev/hidrawN, not a serial port");
  refuses("/dev/null", "a HID device");
  const Outcome list = listen({"--list", "--usb", "0x1209:0x0fff"});
  EXPECT_EQ(list.exit, 0) << all(list);
  EXPECT_FALSE(list.output.empty());
  const Outcome serial = listen({"--device", "NO-SUCH", "--usb", "1209:0fff", "--seconds", "1.3"});
  EXPECT_EQ(serial.exit, 1) << all(serial);
  EXPECT_EQ(count(serial.errors, "searching: "), 1) << all(serial);
}

TEST(ListenTruth, AReplayGivesEveryFrameAtAnySpeed) {
  const palp::TemporaryFolder folder;
  const std::string file = folder / "a.palprec";
  ASSERT_EQ(listen({"--simulate", "--rate", "8000", "--frames", "600", "--record", file}).exit, 0);
  std::vector<std::string> seen;
  for (const char* speed : {"0", "3", "50"}) {
    const Outcome outcome = listen({"--replay", file, "--speed", speed});
    EXPECT_EQ(outcome.exit, 0) << all(outcome);
    seen.push_back(outcome.output.substr(outcome.output.rfind('\n', outcome.output.size() - 2) + 1));
  }
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(seen[0], seen[2]);
  const std::string lines = folder / "f.csv"; // more than wait for a receiver that is late
  for (int k = 0; k < 2; ++k)
    ASSERT_EQ(listen({"--simulate", "--rate", "8000", "--frames", "1500", "--record", file, "--force"}).exit, 0);
  const Outcome sent = listen({"--replay", file, "--speed", "0", "--network",
                               PALP_SOURCE_DIR "/resources/board/paper-network.json", "--send", "csv:" + lines});
  EXPECT_EQ(sent.exit, 0) << all(sent);
  EXPECT_TRUE(says(sent.errors, " 0 dropped")) << all(sent);
  EXPECT_GT(std::stoi(sent.output.substr(sent.output.rfind('\n', sent.output.size() - 2) + 1)), 1490) << all(sent);
}

TEST(ListenTruth, ARecordingIsJudgedByItsOwnTime) {
  const palp::TemporaryFolder folder;
  const std::string file = folder / "a.palprec";
  ASSERT_EQ(listen({"--simulate", "--rate", "8000", "--frames", "200", "--record", file}).exit, 0); // half a second
  const Outcome outcome = listen({"--check", "--replay", file, "--speed", "0"}); // five seconds of a board
  EXPECT_TRUE(says(outcome.output, " of 8000")) << all(outcome);
  EXPECT_GT(std::stod(outcome.output.substr(outcome.output.find("to 2 %: ") + 8)), 4000) << all(outcome);
}

TEST(ListenTruth, SpoiltBytesOfARecordingAreSaid) {
  const palp::TemporaryFolder folder;
  const std::string file = folder / "a.palprec";
  ASSERT_EQ(listen({"--simulate", "--rate", "8000", "--frames", "100", "--record", file}).exit, 0);
  std::string bytes = readAll(file);
  std::fill_n(bytes.begin() + 50'000, 200, 'x');
  writeAll(file, bytes);
  const Outcome outcome = listen({"--replay", file, "--speed", "0"});
  EXPECT_EQ(outcome.exit, 0) << all(outcome);
  EXPECT_TRUE(says(outcome.errors, " bytes are damaged and were skipped")) << all(outcome);
  EXPECT_FALSE(says(outcome.output, " 0 lost")) << all(outcome);
  EXPECT_GE(std::stoi(outcome.output.substr(outcome.output.rfind('\n', outcome.output.size() - 2) + 1)), 99);
}

} // namespace
