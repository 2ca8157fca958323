#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

using nlohmann::json;
using namespace palp::test;

namespace {

/// A coarse mesh: what is tested here are bytes, not accuracy.
const std::vector<std::string> kTetrahedra{"--mesh-size", "6"};
/// A thirtieth of the time of the tetrahedra: where files are tested, and not how samples are made.
const std::vector<std::string> kHexahedra{"--mapped", "6x6x2"};

std::vector<std::string> sample(const std::filesystem::path& file, const std::vector<std::string>& more = {},
                                const std::string& perArea = "40", const std::vector<std::string>& mesh = kTetrahedra) {
  std::vector<std::string> words{"sample", "paper", "--per-area", perArea, "--seed", "7", "-o", file, "--json"};
  words.insert(words.end(), mesh.begin(), mesh.end());
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

} // namespace

TEST(SampleCommand, GivesTheSameBytesWithOneAndTwoThreads) {
  const palp::TemporaryFolder folder;
  const Outcome one = palp::test::palp(sample(folder / "one.csv", {"--threads", "1"}));
  ASSERT_EQ(one.exit, 0) << one.errors;
  EXPECT_EQ(one.json().at("samples"), 240);
  ASSERT_EQ(palp::test::palp(sample(folder / "two.csv", {"--threads", "2"})).exit, 0);
  EXPECT_TRUE(readAll(folder / "one.csv") == readAll(folder / "two.csv"));
}

TEST(SampleCommand, GivesTheSameBytesInShards) {
  const palp::TemporaryFolder folder;
  ASSERT_EQ(palp::test::palp(sample(folder / "whole.csv", {}, "40", kHexahedra)).exit, 0);
  std::vector<std::string> merge{"merge"};
  for (const char* part : {"1", "2", "3"}) {
    const std::filesystem::path file = folder / (std::string("part") + part + ".csv");
    ASSERT_EQ(palp::test::palp(sample(file, {"--shard", std::string(part) + "/3"}, "40", kHexahedra)).exit, 0);
    merge.push_back(file);
  }
  merge.insert(merge.end(), {"-o", folder / "merged.csv"});
  ASSERT_EQ(palp::test::palp(merge).exit, 0);
  EXPECT_TRUE(readAll(folder / "whole.csv") == readAll(folder / "merged.csv"));
}

TEST(SampleCommand, WritesShardsAsArraysThatMergeToTheBytesOfOneRun) {
  const palp::TemporaryFolder folder;
  for (const char* whole : {"whole.csv", "whole.h5", "whole.npz"})
    ASSERT_EQ(palp::test::palp(sample(folder / whole, {}, "40", kHexahedra)).exit, 0);
  std::vector<std::string> merge{"merge"};
  for (const auto& [part, ending] : {std::pair{"3", ".csv"}, {"1", ".h5"}, {"2", ".npz"}}) {
    const std::filesystem::path file = folder / (std::string("part") + part + ending);
    ASSERT_EQ(palp::test::palp(sample(file, {"--shard", std::string(part) + "/3"}, "40", kHexahedra)).exit, 0);
    merge.push_back(file);
  }
  for (const char* whole : {"whole.csv", "whole.h5", "whole.npz"}) {
    std::vector<std::string> words = merge;
    words.insert(words.end(), {"-o", folder / ("merged" + std::filesystem::path(whole).extension().string())});
    ASSERT_EQ(palp::test::palp(words).exit, 0);
    EXPECT_TRUE(readAll(folder / whole) == readAll(words.back())) << whole;
  }
}

TEST(SampleCommand, NetworksOfAllFormatsAreTheSame) {
  const palp::TemporaryFolder folder;
  std::vector<json> results;
  for (const char* name : {"s.csv", "s.h5", "s.npz"}) {
    ASSERT_EQ(palp::test::palp(sample(folder / name, {}, "20", kHexahedra)).exit, 0);
    ASSERT_EQ(palp::test::palp({"train", folder / name, "-o", folder / "n.json", "--force"}).exit, 0);
    results.push_back(palp::test::palp({"predict", folder / "n.json", folder / name, "--json"}).json());
    const Outcome swept =
        palp::test::palp({"sweep", folder / name, "--test", folder / "s.csv", "--spreads", "1", "--json"});
    ASSERT_EQ(swept.exit, 0) << swept.errors;
    results.back()["swept"] = swept.json().at("rows")[0].at("error");
  }
  for (const json& result : results)
    for (const char* key : {"forces_N", "error", "swept"}) EXPECT_EQ(result.at(key), results[0].at(key)) << key;
}

TEST(SampleCommand, GoesOnAfterAnInterruptionToTheSameBytes) {
  const palp::TemporaryFolder folder;
  ASSERT_EQ(palp::test::palp(sample(folder / "whole.csv", {}, "100")).exit, 0);
  const std::filesystem::path file = folder / "cut.csv";
  const std::vector<std::string> words = sample(file, {}, "100");
  const Outcome cut = palpInterrupted(words, file.string() + ".part", 100'000);
  EXPECT_EQ(cut.exit, 130) << cut.errors;
  EXPECT_FALSE(std::filesystem::exists(file));
  ASSERT_TRUE(std::filesystem::exists(file.string() + ".part"));

  const Outcome other = palp::test::palp(sample(file, {}, "99"));
  EXPECT_EQ(other.exit, 2);
  EXPECT_NE(other.errors.find("per_area"), std::string::npos) << other.errors;

  const Outcome rest = palp::test::palp(words);
  ASSERT_EQ(rest.exit, 0) << rest.errors;
  EXPECT_NE(rest.errors.find("continuing after"), std::string::npos);
  EXPECT_TRUE(readAll(folder / "whole.csv") == readAll(file));
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST(SampleCommand, SaysHowFarTheSamplesAreFromFullNewton) {
  const palp::TemporaryFolder folder;
  const json result = palp::test::palp(sample(folder / "s.csv")).json();
  EXPECT_LE(result.at("measured_error_relative").get<double>(), 1e-6);
  EXPECT_GT(result.at("solves").get<int>(), 0);
}

TEST(SampleCommand, SaysWhereFullNewtonFindsAnotherEquilibrium) {
  const palp::TemporaryFolder folder; // a few nodes touch, with friction: g++ 12 finds load 5 57 % away
  const json result = palp::test::palp({"sample", "paper", "--touch", "sphere:3..6", "--friction", "0..0.5", "--mapped",
                                        "20x20x4", "--seed", "2", "--count", "10", "--json", "-o", folder / "s.csv"})
                          .json();
  bool said = false;
  for (const json& warning : result.at("warnings"))
    said = said || warning.get<std::string>().find("full Newton's method finds another equilibrium") == 8 ||
           warning.get<std::string>().find("though the batch found one") != std::string::npos;
  const json& error = result.at("measured_error_relative"); // null: Newton's method found none
  EXPECT_EQ(said, error.is_null() || error.get<double>() > 1e-3) << result.at("warnings");
}

TEST(SampleCommand, LoadsAllAreasTogether) {
  const palp::TemporaryFolder folder;
  const Outcome outcome = palp::test::palp(sample(folder / "s.csv", {"--areas", "together"}, "20"));
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  EXPECT_EQ(outcome.json().at("samples"), 20);
  EXPECT_NE(readAll(folder / "s.csv").find("a5_fz_N"), std::string::npos);
}

TEST(SampleCommand, RefusesShardsThatDoNotBelongTogether) {
  const palp::TemporaryFolder folder;
  ASSERT_EQ(palp::test::palp(sample(folder / "a.csv", {"--shard", "1/2"}, "40", kHexahedra)).exit, 0);
  ASSERT_EQ(palp::test::palp({"sample", "paper", "--per-area", "40", "--seed", "8", "--mapped", "6x6x2", "--shard",
                              "2/2", "-o", folder / "b.csv"})
                .exit,
            0);
  const Outcome outcome = palp::test::palp({"merge", folder / "a.csv", folder / "b.csv", "-o", folder / "c.csv"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.errors.find("seed"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "c.csv"));
}

TEST(SampleCommand, MakesTouchesWhoseForceAndPlaceADecoderLearns) {
  const palp::TemporaryFolder folder;
  const auto touches = [&](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> words{"sample", "paper",    "--touch", "sphere:3..6@*", "--count", "40",         "--seed",
                                   "3",      "--mapped", "12x12x2", "--json",        "-o",      folder / file};
    words.insert(words.end(), more.begin(), more.end());
    return palp::test::palp(words);
  };
  const Outcome whole = touches("whole.csv", {});
  ASSERT_EQ(whole.exit, 0) << whole.errors;
  EXPECT_LT(whole.json().at("measured_error_relative"), 1e-4);
  ASSERT_EQ(touches("part1.h5", {"--shard", "1/2"}).exit, 0);
  ASSERT_EQ(touches("part2.npz", {"--shard", "2/2"}).exit, 0);
  ASSERT_EQ(palp::test::palp({"merge", folder / "part2.npz", folder / "part1.h5", "-o", folder / "merged.csv"}).exit,
            0);
  EXPECT_TRUE(readAll(folder / "whole.csv") == readAll(folder / "merged.csv"));
  EXPECT_NE(readAll(folder / "whole.csv").find("\narea,shape,size_mm,friction,x_mm,y_mm,fx_N,fy_N,fz_N,u_r0"),
            std::string::npos);
  const std::string network = folder / "network.json";
  ASSERT_EQ(palp::test::palp({"train", folder / "whole.csv", "--input", "resistance", "--rows", "all", "--decoder",
                              "touch", "--target", "force+place", "--noise", "1e-5", "-o", network})
                .exit,
            0);
  const Outcome used =
      palp::test::palp({"predict", network, folder / "whole.csv", "-o", folder / "said.csv", "--json"});
  ASSERT_EQ(used.exit, 0) << used.errors;
  EXPECT_LT(used.json().at("place_error").at("median_mm"), 1); // on what it was fitted to
  EXPECT_EQ(used.json().at("place_mm").size(), 40U);
  for (const char* key : {"forces_N", "standard_deviation_N"}) {
    EXPECT_TRUE(used.json().at(key)[0][0].is_null()) << "no touch pulls sideways: not measured, not 0 +- 0";
    EXPECT_TRUE(used.json().at(key)[0][2].is_number());
  }
  EXPECT_NE(readAll(folder / "said.csv").find("\n0,,,-"), std::string::npos) << "an empty cell";
  EXPECT_EQ(readAll(folder / "said.csv")
                .find("sample,fx_N,fy_N,fz_N,sd_fx_N,sd_fy_N,sd_fz_N,x_mm,y_mm,sd_x_mm,sd_y_mm,outside_training_range,"
                      "pressing\n"),
            0U);
}

TEST(SampleCommand, RefusesTouchesThatCannotBe) {
  const palp::TemporaryFolder folder;
  const auto refuses = [&](const std::vector<std::string>& more, const std::string& word) {
    std::vector<std::string> words{"sample", "paper", "-o", folder / "never.csv"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = palp::test::palp(words);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(outcome.errors.find(word), std::string::npos) << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  };
  refuses({"--touch", "sphere:3..6"}, "--count");
  refuses({"--count", "3"}, "--touch");
  refuses({}, "--per-area is missing");
  refuses({"--touch", "ball:3", "--count", "3"}, "(shape): got 'ball', expected sphere");
  refuses({"--touch", "sphere", "--count", "3"}, "sizes after the shape");
  refuses({"--touch", "sphere:6..3", "--count", "3"}, "sizes: got 6..3");
  refuses({"--touch", "flat:3", "--count", "3"}, "flat:FROM..TO,RIM");
  refuses({"--touch", "plane:3", "--count", "3"}, "plane, which has no sizes");
  refuses({"--touch", "sphere:3@1,2,3", "--count", "3"}, "--touch (region)");
  refuses({"--touch", "sphere:3@1,2,3,4", "--region", "1,2,3,4", "--count", "3"}, "not together with the region");
  refuses({"--touch", "sphere:3", "--region", "-5,0,30,30", "--count", "3"}, "top face");
  refuses({"--touch", "sphere:3", "--friction", "0.3..nan", "--count", "3"}, "--friction");
  refuses({"--touch", "sphere:3", "--force-range", "0..6", "--count", "3"}, "presses: got 0..6");
  refuses({"--touch", "sphere:3", "--grid", "5", "--count", "3"}, "--grid");
  refuses({"--touch", "sphere:3", "--surrogate", "--count", "3"}, "--surrogate requires --per-area");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}
