#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <ostream>

using nlohmann::json;
using namespace palp::test;

namespace {

/// Exit 2, one line on standard error that holds all the words, nothing on standard output.
void expectRefused(const Outcome& outcome, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.exit, 2) << outcome.errors;
  EXPECT_EQ(outcome.output, "");
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  for (const std::string& word : words)
    EXPECT_NE(outcome.errors.find(word), std::string::npos) << "'" << word << "' is missing in: " << outcome.errors;
}

json paper() {
  return json::parse(palp::test::palp({"design"}).output);
}

struct BrokenDesign {
  std::string name;
  std::function<void(json&)> spoil;
  std::vector<std::string> words;
};
/// In the names of the tests.
void PrintTo(const BrokenDesign& one, std::ostream* out) {
  *out << one.name;
}

const std::vector<BrokenDesign>& brokenDesigns() {
  static const std::vector<BrokenDesign> designs{
      {"ElectrodeOutside",
       [](json& d) { d["upper_layer"]["row_wire_y_mm"][3] = 31; },
       {"upper_layer.row_wire_y_mm", "31", "outside the block", "30"}},
      {"LowerElectrodeOutside",
       [](json& d) { d["lower_layer"]["column_wire_x_mm"][2] = -0.5; },
       {"lower_layer.column_wire_x_mm", "-0.5", "outside"}},
      {"AreaEmpty", [](json& d) { d["areas"]["columns"] = 0; }, {"areas.columns", "got 0", "expected 1 to"}},
      {"PoissonAboveHalf",
       [](json& d) { d["material"]["poisson_ratio"] = 0.51; },
       {"material.poisson_ratio", "0.51", "0 to 0.5"}},
      {"PoissonNegative",
       [](json& d) { d["material"]["poisson_ratio"] = -0.1; },
       {"material.poisson_ratio", "-0.1", "0 to 0.5"}},
      {"LayersCross", [](json& d) { d["lower_layer"]["z_mm"] = 4.5; }, {"lower_layer.z_mm", "cross", "4.5"}},
      {"UnknownKey", [](json& d) { d["upper_layer"]["colour"] = "red"; }, {"upper_layer.colour"}},
      {"MissingKey", [](json& d) { d.erase("material"); }, {"material"}},
      {"DuplicateElectrode",
       [](json& d) { d["upper_layer"]["electrode_x_mm"][1] = 1.5; },
       {"upper_layer.electrode_x_mm", "duplicate"}},
      {"NotANumber", [](json& d) { d["material"]["c10_MPa"] = "NaN"; }, {"material.c10_MPa", "NaN"}},
      {"NoStiffness", [](json& d) { d["material"]["c01_MPa"] = -0.4; }, {"material.c01_MPa", "-0.4"}},
      {"ZeroThickness", [](json& d) { d["block_mm"][2] = 0; }, {"block_mm", "0"}},
      {"HugeBlock", [](json& d) { d["block_mm"][0] = 1e30; }, {"block_mm", "1e+30"}},
      {"NewerVersion", [](json& d) { d["palp_design"] = 2; }, {"palp_design", "2"}},
      {"ForceRangeReversed",
       [](json& d) {
         d["force_range_N"]["z"] = {0, -6};
       },
       {"force_range_N.z"}},
  };
  return designs;
}

class BrokenDesignTest : public testing::TestWithParam<BrokenDesign> {};

} // namespace

TEST_P(BrokenDesignTest, IsRefusedByEveryCommandThatReadsDesigns) {
  const palp::TemporaryFolder folder;
  json design = paper();
  GetParam().spoil(design);
  const std::string file = folder / "sensor.json";
  writeAll(file, design.dump());
  const std::string samples = folder / "samples.csv";
  std::vector<std::string> words = GetParam().words;
  words.push_back("sensor.json");
  expectRefused(palp::test::palp({"design", "--check", file}), words);
  expectRefused(palp::test::palp({"mesh", file}), words);
  expectRefused(palp::test::palp({"solve", file, "--load", "0:0,0,-1"}), words);
  expectRefused(palp::test::palp({"sample", file, "--per-area", "1", "-o", samples}), words);
  expectRefused(palp::test::palp({"render", file, "--load", "0:0,0,-1", "-o", folder / "picture.png"}), words);
  EXPECT_FALSE(std::filesystem::exists(samples));
}

INSTANTIATE_TEST_SUITE_P(Designs, BrokenDesignTest, testing::ValuesIn(brokenDesigns()),
                         [](const auto& tested) { return tested.param.name; });

/// What works by Eq. (1) alone says so in one line and leaves nothing behind.
TEST(BadInput, TheFieldLawIsRefusedWhereEq1IsMeant) {
  const palp::TemporaryFolder folder;
  json design = paper();
  design["resistance"] = {
      {"law", "field"}, {"resistivity_ohm_mm", 2000},  {"electrode_radius_mm", 0.2}, {"contact_ohm_mm2", 0},
      {"wire_ohm", 0},  {"readout", "virtual_ground"}, {"pressure_law", nullptr}};
  const std::string file = folder / "field.json";
  writeAll(file, design.dump());
  const Outcome checked = palp::test::palp({"design", "--check", file, "--json"});
  EXPECT_EQ(checked.exit, 0) << checked.errors;
  EXPECT_EQ(checked.json().at("resistance_law"), "field");
  EXPECT_EQ(checked.json().at("readout"), "virtual_ground");
  const std::string out = folder / "out";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"report", "stability", "--design", file, "-o", out},
        {"report", "error-time", "--design", file, "-o", out}})
    expectRefused(palp::test::palp(command), {"not available under the field law", "expected pairs"});
  expectRefused(palp::test::palp({"listen", "--simulate", "--design", file}), {"--design", "trained for"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

/// Bounds at rest, where the pressure law has a kink: no report begins to work.
TEST(BadInput, APressureLawIsRefusedByTheReportsUnderTheField) {
  const palp::TemporaryFolder folder;
  json design = paper();
  design["resistance"] = {{"law", "field"},
                          {"resistivity_ohm_mm", 2000},
                          {"electrode_radius_mm", 0.2},
                          {"contact_ohm_mm2", 0},
                          {"wire_ohm", 0},
                          {"readout", "floating"},
                          {"pressure_law", {{"p0_MPa", 0.05}, {"exponent", 0.5}}}};
  const std::string file = folder / "field.json", out = folder / "out";
  writeAll(file, design.dump());
  for (const char* kind : {"noise", "layout", "readout", "map"})
    expectRefused(palp::test::palp({"report", kind, "--design", file, "-o", out}),
                  {"resistance.pressure_law", "expected null"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(BadInput, ATruncatedDesignIsRefusedWithItsPlace) {
  const palp::TemporaryFolder folder;
  const std::string text = paper().dump();
  writeAll(folder / "cut.json", text.substr(0, text.size() / 2));
  expectRefused(palp::test::palp({"design", "--check", folder / "cut.json"}), {"cut.json"});
}

TEST(BadInput, AMissingDesignIsRefused) {
  expectRefused(palp::test::palp({"mesh", "nowhere.json"}), {"nowhere.json"});
}

struct BadOption {
  std::string name;
  std::vector<std::string> arguments;
  std::vector<std::string> words;
};
/// In the names of the tests.
void PrintTo(const BadOption& one, std::ostream* out) {
  *out << one.name;
}

class BadOptionTest : public testing::TestWithParam<BadOption> {};

TEST_P(BadOptionTest, IsRefusedInOneLine) {
  expectRefused(palp::test::palp(GetParam().arguments), GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(
    Options, BadOptionTest,
    testing::Values(
        BadOption{"UnknownCommand", {"fly"}, {"'fly' is not expected here (see palp --help)"}},
        BadOption{"MistypedCommand", {"desing", "-o", "x"}, {"'desing'", "did you mean design?"}},
        BadOption{"UnknownOption", {"solve", "paper", "--lod", "0:0,0,-1"}, {"'--lod'", "did you mean --load?"}},
        BadOption{"LoadsOfNoFile", {"solve", "paper", "--loads", "4:0,0,-1"}, {"--loads: got '4:0,0,-1'", "--load"}},
        BadOption{"NoLoad", {"solve", "paper"}, {"--load", "--indenter"}},
        BadOption{"EmptyDesign", {"solve", "", "--load", "0:0,0,-1"}, {"design: got ''", "not empty"}},
        BadOption{"EmptyFriction",
                  {"sample", "paper", "--touch", "sphere:3", "--friction", "", "--count", "1", "-o", "x.csv"},
                  {"--friction: got ''", "not empty"}},
        BadOption{"EmptyLoad", {"solve", "paper", "--load", ""}, {"--load", "''"}},
        BadOption{"EmptyRecording", {"listen", "--replay", ""}, {"--replay: got ''", "not empty"}},
        BadOption{"NoSuchArea", {"solve", "paper", "--load", "6:0,0,-1"}, {"--load", "6", "0 to 5"}},
        BadOption{"ForceNotANumber", {"solve", "paper", "--load", "0:0,nan,-1"}, {"--load", "nan"}},
        BadOption{"ForceTooLong", {"solve", "paper", "--load", "0:0,0,-1,2"}, {"--load", "3 numbers"}},
        BadOption{"ForceHuge", {"solve", "paper", "--load", "0:0,0,-1e300"}, {"-1e+300"}},
        BadOption{"LoadWithoutColon", {"solve", "paper", "--load", "5"}, {"--load", "AREA:FX,FY,FZ"}},
        BadOption{"PatchOutside",
                  {"solve", "paper", "--patch", "29,15,2:0,0,-1"},
                  {"patch", "29", "completely on the top face"}},
        BadOption{"IndenterShape",
                  {"solve", "paper", "--indenter", "cube:3@15,15:press=0,0,-1"},
                  {"indenter", "cube", "sphere"}},
        BadOption{
            "IndenterOutside", {"solve", "paper", "--indenter", "sphere:3@40,15:press=0,0,-1"}, {"sphere at (40, 15)"}},
        BadOption{
            "IndenterPulls", {"solve", "paper", "--indenter", "sphere:3@15,15:press=0,0,1"}, {"sphere", "(0, 0, 1)"}},
        BadOption{"IndenterAside",
                  {"solve", "paper", "--indenter", "sphere:3@15,15:press=1,0,-1"},
                  {"(1, 0, -1) N", "friction (mu)"}},
        BadOption{"IndenterRim", {"solve", "paper", "--indenter", "flat:3,4@15,15:depth=0.1"}, {"rim", "4"}},
        BadOption{"IndenterFriction",
                  {"solve", "paper", "--indenter", "sphere:3@15,15:press=0,0,-1:mu=3"},
                  {"friction: got 3"}},
        BadOption{
            "IndenterNan", {"solve", "paper", "--indenter", "sphere:nan@15,15:press=0,0,-1"}, {"indenter", "nan"}},
        BadOption{"PatchRadiusZero", {"solve", "paper", "--patch", "15,15,0:0,0,-1"}, {"patch", "radius 0"}},
        BadOption{"MeshSizeZero", {"mesh", "paper", "--mesh-size", "0"}, {"0"}},
        BadOption{"MeshSizeNegative", {"mesh", "paper", "--mesh-size", "-2"}, {"-2"}},
        BadOption{"MeshSizeTiny", {"mesh", "paper", "--mesh-size", "1e-6"}, {"1e-06"}},
        BadOption{"MappedOneNumber", {"mesh", "paper", "--mapped", "10"}, {"--mapped", "NxNxN"}},
        BadOption{"MappedZero", {"mesh", "paper", "--mapped", "0x10x5"}, {"--mapped", "0"}},
        BadOption{
            "MappedAndSize", {"mesh", "paper", "--mapped", "2x2x2", "--mesh-size", "2"}, {"--mapped", "--mesh-size"}},
        BadOption{"AccuracyZero", {"solve", "paper", "--load", "0:0,0,-1", "--accuracy", "0"}, {"--accuracy", "0"}},
        BadOption{"DeckWithoutFile", {"mesh", "paper", "--format", "inp", "--load", "0:0,0,-1"}, {"--format", "-o"}},
        BadOption{"FormatUnknown", {"mesh", "paper", "--format", "stl"}, {"--format", "stl"}},
        BadOption{"FolderMissing", {"mesh", "paper", "-o", "no/such/folder/mesh.vtu"}, {"no/such/folder"}},
        BadOption{"ThreadsZero", {"mesh", "paper", "--threads", "0"}, {"--threads", "0"}},
        BadOption{"PresetUnknown", {"design", "--preset", "mine"}, {"--preset", "mine", "paper"}},
        BadOption{"PerAreaZero", {"sample", "paper", "--per-area", "0", "-o", "x.csv"}, {"--per-area", "0"}},
        BadOption{
            "SeedNegative", {"sample", "paper", "--per-area", "1", "--seed", "-1", "-o", "x.csv"}, {"--seed", "-1"}},
        BadOption{
            "AreasUnknown", {"sample", "paper", "--per-area", "1", "--areas", "9", "-o", "x.csv"}, {"9", "0 to 5"}},
        BadOption{
            "ShardZero", {"sample", "paper", "--per-area", "1", "--shard", "0/2", "-o", "x.csv"}, {"--shard", "0"}},
        BadOption{
            "ShardBeyond", {"sample", "paper", "--per-area", "1", "--shard", "3/2", "-o", "x.csv"}, {"--shard", "3"}},
        BadOption{"ThreeAtOnce",
                  {"sample", "paper", "--touch", "sphere:3", "--at-once", "3", "--count", "1", "-o", "x.csv"},
                  {"--at-once", "3", "1 to 2"}},
        BadOption{"TwoWithoutRoom",
                  {"sample", "paper", "--touch", "sphere:3@9,9,15,15", "--at-once", "2", "--count", "1", "-o", "x.csv"},
                  {"at once: got 2", "12 mm"}},
        BadOption{"ToleranceZero",
                  {"sample", "paper", "--per-area", "1", "--tolerance", "0", "-o", "x.csv"},
                  {"--tolerance", "0"}},
        BadOption{"MaterialMissing", {"material", "fit", "nowhere.csv"}, {"nowhere.csv"}},
        BadOption{"MaterialWithoutFile", {"material", "fit"}, {"got no file", "CSV"}},
        BadOption{"MaterialAction", {"material", "guess", "nowhere.csv"}, {"guess", "fit"}},
        BadOption{"MaterialLaw", {"material", "fit", "nowhere.csv", "--law", "ogden"}, {"--law", "'ogden'", "ogden-1"}},
        BadOption{"MaterialPoisson",
                  {"material", "fit", "nowhere.csv", "--poisson-ratio", "0.6"},
                  {"--poisson-ratio", "0.6", "0 to 0.5"}},
        BadOption{"MergeMissing", {"merge", "nowhere.csv", "-o", "x.csv"}, {"nowhere.csv"}},
        BadOption{"ReproduceUnknown", {"reproduce", "fig99"}, {"fig99"}},
        BadOption{"ReportUnknown", {"report", "fly"}, {"fly", "error-time"}},
        BadOption{"ReportWithoutKind", {"report"}, {"kind"}},
        BadOption{"ReportPerAreaTwo", {"report", "noise", "--per-area", "2"}, {"--per-area", "2", "5 to"}},
        BadOption{"ReportSeedNegative", {"report", "noise", "--seed", "-1"}, {"--seed", "-1", "0 to"}},
        BadOption{"ReportDesignMissing", {"report", "layout", "--design", "nowhere.json"}, {"nowhere.json"}},
        BadOption{"ReportMappedTwoNumbers", {"report", "scenes", "--mapped", "2x2"}, {"--mapped", "2x2", "NxNxN"}},
        BadOption{"ReportMapOfACylinder", {"report", "map", "--touch", "cylinder-x:3"}, {"cylinder-x", "sphere, pin"}},
        BadOption{"ReportMapOfNothing", {"report", "map", "--touch", "ball:3"}, {"ball", "sphere"}},
        BadOption{"ReportMapOfOnePlace",
                  {"report", "map", "--touch", "sphere:3", "--grid", "1x5"},
                  {"positions along x", "got 1", "2 or more"}},
        BadOption{"ReportMapTooFine",
                  {"report", "map", "--touch", "sphere:3", "--grid", "1000x1000"},
                  {"1000 x 1000", "1e5"}},
        BadOption{"ReportMapPulled", {"report", "map", "--touch", "sphere:3", "--force-range", "-3..-1"}, {"-3"}},
        BadOption{"ReportTouchOfAnotherKind", {"report", "noise", "--touch", "sphere:3"}, {"--touch", "map"}},
        BadOption{"ReportIntoAFile", {"report", "scenes", "-o", "/dev/null"}, {"--output", "/dev/null", "folder"}},
        BadOption{"SeedsZero", {"reproduce", "table1", "--seeds", "0"}, {"--seeds", "0"}},
        BadOption{"TrainMissing", {"train", "nowhere.csv", "--input", "displacement", "-o", "n.json"}, {"nowhere.csv"}},
        BadOption{"PredictDesignMissing", {"predict", "n.json", "s.csv", "--design", "nowhere.json"}, {"nowhere.json"}},
        BadOption{"PredictExchanged",
                  {"predict", PALP_SOURCE_DIR "/resources/board/paper-samples.csv", "n.json"},
                  {"paper-samples.csv", "contains samples", "swapped file names"}},
        BadOption{"TrainOnADesign",
                  {"train", PALP_SOURCE_DIR "/resources/paper.json", "-o", "n.json"},
                  {"paper.json", "contains JSON instead of samples"}},
        BadOption{"PredictMissing", {"predict", "nowhere.json", "nowhere.csv"}, {"nowhere.json"}},
        BadOption{"TrainSplit",
                  {"train", PALP_SOURCE_DIR "/resources/board/paper-samples.csv", "--split", "time:1", "-o", "n.json"},
                  {"--split", "time:1", "time:0.7"}},
        BadOption{"SweepWithoutTest", {"sweep", "s.csv"}, {"--test", "neither", "--split"}},
        BadOption{"SweepMissing",
                  {"sweep", "nowhere.csv", "--test", "t.csv", "--input", "displacement", "--spreads", "1"},
                  {"nowhere.csv"}}),
    [](const auto& tested) { return tested.param.name; });

TEST(BadInput, ARefusedReportLeavesNoFolder) {
  const palp::TemporaryFolder folder;
  const std::string output = folder / "out";
  expectRefused(palp::test::palp({"report", "stability", "--mesh-size", "1e-6", "-o", output}), {"mesh size"});
  expectRefused(palp::test::palp({"report", "stability", "--design", "nowhere.json", "-o", output}), {"nowhere.json"});
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST(BadInput, ANameThatTheFileSystemDoesNotTakeIsNamed) {
  const std::string name(300, 'n');
  expectRefused(palp::test::palp({"report", "noise", "-o", name}), {name, "File name too long"});
  expectRefused(palp::test::palp({"study", name, "-o", "out"}), {name, "File name too long"});
  expectRefused(palp::test::palp({"design", "-o", name + "/sensor.json"}), {name, "File name too long"});
  EXPECT_FALSE(std::filesystem::exists("out"));
}

TEST(BadInput, AnOutputThatExistsIsKept) {
  const palp::TemporaryFolder folder;
  const std::string file = folder / "sensor.json";
  writeAll(file, "mine");
  expectRefused(palp::test::palp({"design", "-o", file}), {"sensor.json", "--force"});
  EXPECT_EQ(readAll(file), "mine");
  EXPECT_EQ(palp::test::palp({"design", "-o", file, "--force"}).exit, 0);
  EXPECT_NE(readAll(file), "mine");
}

namespace {

/// Each command that writes a file, up to its name.
const std::vector<std::vector<std::string>>& writingCommands() {
  static const std::vector<std::vector<std::string>> commands{
      {"design", "-o"},
      {"mesh", "paper", "-o"},
      {"solve", "paper", "--load", "0:0,0,-1", "-o"},
      {"render", "paper", "--load", "0:0,0,-1", "-o"},
      {"sample", "paper", "--per-area", "1", "-o"},
      {"material", "fit", "nowhere.csv", "-o"},
      {"merge", "nowhere.csv", "-o"},
      {"import", "nowhere.csv", "--map", "nowhere.json", "-o"},
      {"train", "nowhere.csv", "-o"},
      {"predict", "nowhere.json", "nowhere.csv", "-o"},
      {"calibrate", "nowhere.json", "nowhere.csv", "-o"},
      {"report", "noise", "-o"},
      {"reproduce", "table1", "-o"},
      {"cluster", "sample", "paper", "--per-area", "1", "--shards", "2", "-o"},
      {"listen", "--simulate", "--frames", "1", "--record"}};
  return commands;
}

} // namespace

TEST(Outputs, StandardOutputIsRefusedByEveryCommand) {
  std::size_t turn = 0;
  for (std::vector<std::string> arguments : writingCommands()) {
    arguments.emplace_back(std::array{"-", "/dev/stdout", "/dev/fd/1"}[turn++ % 3]);
    expectRefused(palp::test::palp(arguments), {"'" + arguments.back() + "'", "standard stream", "give a file name"});
  }
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST(Outputs, AFolderThatCannotBeWrittenIsRefusedBeforeTheWork) {
  for (std::vector<std::string> arguments : writingCommands()) {
    arguments.emplace_back("/proc/palp.csv"); // where root cannot write either
    expectRefused(palp::test::palp(arguments), {"/proc/palp.csv", "cannot be"});
  }
}

/// As in a folder that lets nobody in, the system cannot even say what the name is.
TEST(Outputs, ANameThatCannotBeReachedIsRefusedByEveryCommand) {
  const palp::TemporaryFolder folder;
  std::filesystem::create_symlink("b.csv", folder / "a.csv");
  std::filesystem::create_symlink("a.csv", folder / "b.csv");
  std::vector<std::vector<std::string>> commands = writingCommands();
  commands.insert(commands.end(), {{"cluster", "status"}, {"solve", "paper", "--loads"}});
  for (std::vector<std::string> arguments : commands) {
    arguments.emplace_back(folder / "a.csv");
    expectRefused(palp::test::palp(arguments), {"a.csv", "cannot be"});
  }
}
