#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <algorithm>

using namespace palp::test;

namespace {

constexpr std::uintmax_t kFull_bytes = 1000; ///< below every file that is written here

/// One line that names the file and why, and nothing left of it.
void expectRefusal(const Outcome& outcome, const std::filesystem::path& file) {
  EXPECT_EQ(outcome.exit, 2) << outcome.output;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  EXPECT_NE(outcome.errors.find(file.filename().string()), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("File too large"), std::string::npos) << outcome.errors; // the system's own reason
  EXPECT_FALSE(std::filesystem::exists(file));
}

void expectEmpty(const std::filesystem::path& folder) {
  for (const auto& left : std::filesystem::directory_iterator(folder)) ADD_FAILURE() << left.path() << " is left";
}

} // namespace

TEST(FullDisk, RefusesADeckWithTheReasonAndLeavesNothing) {
  const palp::TemporaryFolder folder;
  const std::filesystem::path deck = folder / "a.inp";
  expectRefusal(palpOnAFullDisk({"mesh", "paper", "--load", "0:1,0,-6", "--mapped", "6x6x3", "--format", "inp", "-o",
                                 deck, "--json"},
                                kFull_bytes),
                deck);
  expectEmpty(folder.path());
}

TEST(FullDisk, RefusesSamplesAsArraysWithTheReasonAndLeavesNothing) {
  const palp::TemporaryFolder folder;
  const std::string samples = std::string(PALP_SOURCE_DIR) + "/resources/board/paper-samples.csv";
  for (const char* name : {"a.h5", "a.npz"})
    expectRefusal(palpOnAFullDisk({"merge", samples, "-o", folder / name, "--json"}, kFull_bytes), folder / name);
  expectEmpty(folder.path());
}

#if PALP_PICTURES // VTK writes them
TEST(FullDisk, RefusesVtuAndPictureWithTheReasonAndLeavesNothing) {
  const palp::TemporaryFolder folder;
  const std::filesystem::path vtu = folder / "a.vtu", png = folder / "a.png";
  expectRefusal(
      palpOnAFullDisk({"solve", "paper", "--load", "0:1,0,-6", "--mapped", "6x6x3", "-o", vtu, "--json"}, kFull_bytes),
      vtu);
  expectRefusal(
      palpOnAFullDisk({"render", "paper", "--load", "0:1,0,-6", "--mapped", "6x6x3", "-o", png, "--json"}, kFull_bytes),
      png);
  expectEmpty(folder.path());
}
#else
TEST(FullDisk, AProgramWithoutVtkRefusesVtuAndPicture) {
  const palp::TemporaryFolder folder;
  for (const auto& [command, name] : {std::pair{"solve", "a.vtu"}, std::pair{"render", "a.png"}}) {
    const Outcome outcome =
        palp::test::palp({command, "paper", "--load", "0:1,0,-6", "--mapped", "6x6x3", "-o", folder / name});
    EXPECT_EQ(outcome.exit, 2) << outcome.output;
    EXPECT_NE(outcome.errors.find(std::string(name) + " needs VTK"), std::string::npos) << outcome.errors;
  }
  expectEmpty(folder.path());
}
#endif

TEST(FullDisk, RefusesNetworkForcesAndSamplesWithTheReason) {
  const palp::TemporaryFolder folder;
  const std::string samples = folder / "samples.csv", network = folder / "network.json";
  ASSERT_EQ(palp::test::palp({"sample", "paper", "--per-area", "20", "--mapped", "6x6x2", "-o", samples}).exit, 0);
  expectRefusal(palpOnAFullDisk({"train", samples, "-o", network, "--json"}, kFull_bytes), network);
  ASSERT_EQ(palp::test::palp({"train", samples, "-o", network}).exit, 0);
  const std::filesystem::path forces = folder / "forces.csv", more = folder / "more.csv";
  expectRefusal(palpOnAFullDisk({"predict", network, samples, "-o", forces}, kFull_bytes), forces);
  const Outcome sampled =
      palpOnAFullDisk({"sample", "paper", "--per-area", "20", "--mapped", "6x6x2", "-o", more}, kFull_bytes);
  EXPECT_EQ(sampled.exit, 2);
  EXPECT_NE(sampled.errors.find("File too large"), std::string::npos) << sampled.errors;
  EXPECT_FALSE(std::filesystem::exists(more));
}

TEST(FullDisk, LeavesNoHalfReport) {
  const palp::TemporaryFolder folder;
  const Outcome outcome =
      palpOnAFullDisk({"reproduce", "figures", "--mapped", "4x4x2", "-o", folder / "paper"}, 30'000);
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.errors.find("File too large"), std::string::npos) << outcome.errors;
  expectEmpty(folder.path());
}

TEST(FullDisk, SaysThatStandardOutputIsFull) {
  const Outcome outcome = palpOnAFullDisk({"solve", "paper", "--load", "0:1,0,-6", "--mapped", "6x6x3", "--json"}, 500);
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.errors.find("standard output: cannot be written"), std::string::npos) << outcome.errors;
}
