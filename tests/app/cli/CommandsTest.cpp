#include "model/base/Text.h"
#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

using nlohmann::json;
using namespace palp::test;

namespace {

bool hasStage(const json& result, const std::string& stage) {
  return result.at("stages").contains(stage);
}

/// The commands that `palp --help` lists: the lines below "Subcommands:" up to an empty one.
std::vector<std::string> commandsInHelp() {
  std::istringstream help(palp::test::palp({"--help"}).output);
  std::vector<std::string> commands;
  bool below = false;
  for (std::string line; std::getline(help, line);) {
    if (below && line.empty()) break;
    std::istringstream words(line);
    if (below) words >> commands.emplace_back();
    below = below || line == "Subcommands:";
  }
  return commands;
}

} // namespace

TEST(Commands, LookingAtTheDesignStartsNoMesh) {
  const json result = palp::test::palp({"design", "--json"}).json();
  EXPECT_EQ(result.at("command"), "design");
  EXPECT_TRUE(result.at("stages").empty());
  EXPECT_GT(result.at("peak_memory_MB").get<double>(), 0);
}

TEST(Commands, MaterialFitFindsALawAndWritesTheMaterialThatADesignTakes) {
  const palp::TemporaryFolder folder;
  std::string csv = "strain,stress_kPa\n"; // of Yeoh's law with c10 0.02, c20 0.001, c30 0 MPa
  for (const double l : {0.6, 0.7, 0.8, 0.9, 1.1, 1.2, 1.4, 1.6, 1.8, 2.0}) {
    const double s = l * l + 2 / l - 3, stress = 2e3 * (l - 1 / (l * l)) * (0.02 + 2 * 0.001 * s);
    csv += palp::text(l - 1) + "," + palp::text(stress) + "\n";
  }
  writeAll(folder / "test.csv", csv);
  const Outcome outcome =
      palp::test::palp({"material", "fit", folder / "test.csv", "--law", "yeoh", "-o", folder / "curve.csv", "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  const json result = outcome.json();
  EXPECT_EQ(result.at("material").at("law"), "yeoh");
  EXPECT_NEAR(result.at("material").at("c10_MPa").get<double>(), 0.02, 1e-9);
  EXPECT_NEAR(result.at("material").at("c20_MPa").get<double>(), 0.001, 1e-9);
  EXPECT_EQ(result.at("fits").at(0).at("covariance").size(), 3U);
  EXPECT_TRUE(std::filesystem::exists(folder / "curve.csv"));
  json design = palp::test::palp({"design", "--json"}).json().at("design");
  design["material"] = result.at("material");
  writeAll(folder / "yeoh.json", design.dump());
  const json checked = palp::test::palp({"design", "--check", folder / "yeoh.json", "--json"}).json();
  EXPECT_EQ(checked.at("rubber_law"), "yeoh");
  EXPECT_NEAR(checked.at("shear_modulus_MPa").get<double>(), 0.04, 1e-8);
}

TEST(Commands, AProgramThatWasMovedWithItsFolderFindsWhatShipsWithIt) {
  const palp::TemporaryFolder folder;
  const std::filesystem::path moved = folder / "moved", program = moved / "build" / "bin" / "palp";
  std::filesystem::create_directories(program.parent_path());
  std::filesystem::copy_file(palpProgram(), program);
  std::filesystem::create_directories(moved / "resources" / "docs");
  writeAll(moved / "resources" / "docs" / "architecture.md", "moved too");
  const std::string help = palpAt(program, {"--help"}).output;
  EXPECT_NE(help.find("Pages: " + (moved / "resources" / "docs").string()), std::string::npos) << help;
}

TEST(Commands, AFileWhoseNameIsNotUtf8IsWrittenAndTheJsonIsWhole) {
  const palp::TemporaryFolder folder;
  const Outcome outcome = palp::test::palp({"design", "--json", "-o", folder / "m\xe4rz.json"});
  EXPECT_EQ(outcome.exit, 0) << outcome.errors;
  EXPECT_EQ(outcome.json().at("command"), "design");
}

TEST(Commands, LookingAtTheMeshStartsNoSolve) {
  const json result = palp::test::palp({"mesh", "paper", "--json"}).json();
  EXPECT_EQ(result.at("stages").at("mesh").at("runs"), 1);
  EXPECT_EQ(result.at("stages").size(), 1U);
  EXPECT_GT(result.at("elements").get<int>(), 100);
  EXPECT_GT(result.at("min_dihedral_deg").get<double>(), 1);
  EXPECT_LT(result.at("max_dihedral_deg").get<double>(), 179);
}

/// The paper's design under the field, virtual ground, in a file of this folder.
std::string fieldDesign(const palp::TemporaryFolder& folder) {
  json design = json::parse(palp::test::palp({"design"}).output);
  design["resistance"] = {
      {"law", "field"}, {"resistivity_ohm_mm", 2000},  {"electrode_radius_mm", 0.2}, {"contact_ohm_mm2", 0},
      {"wire_ohm", 0},  {"readout", "virtual_ground"}, {"pressure_law", nullptr}};
  const std::string file = folder / "field.json";
  std::ofstream(file) << design;
  return file;
}

TEST(Commands, SolveUnderTheFieldSaysItsLawReadOutAndError) {
  const palp::TemporaryFolder folder;
  std::vector<std::string> words{"solve", fieldDesign(folder), "--load", "0:0,0,-3", "--mapped", "8x8x4", "--json"};
  if (PALP_PICTURES != 0) words.insert(words.end(), {"--current", "4,15", "-o", folder / "field.vtu"}); // by VTK
  const Outcome outcome = palp::test::palp(words);
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  const json result = outcome.json();
  EXPECT_EQ(result.at("resistance_law"), "field");
  EXPECT_EQ(result.at("readout"), "virtual_ground");
  EXPECT_GT(result.at("resistance_error_estimate").get<double>(), 0);
  // the closed form of the box, monopoles and dipoles, times the resistivity
  EXPECT_NEAR(result.at("resistances_at_rest_ohm")[4][15].get<double>(), 2000 * 3.37106704, 0.01);
  EXPECT_NE(result.at("resistances_ohm")[4][15], result.at("resistances_at_rest_ohm")[4][15]);
  if (PALP_PICTURES == 0) return;
  std::ifstream file(folder / "field.vtu");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  for (const char* array : {"potential_V", "current_density_A_per_mm2", "power_density_W_per_mm3"})
    EXPECT_NE(text.find(array), std::string::npos) << array;
}

TEST(Commands, SamplesOfTheFieldTrainANetwork) {
  const palp::TemporaryFolder folder;
  const std::string samples = folder / "samples.csv", network = folder / "network.json", design = fieldDesign(folder);
  const Outcome made = palp::test::palp({"sample", design, "--per-area", "40", "--areas", "0", "--mapped", "6x6x3",
                                         "--surrogate", "-o", samples, "--json"});
  ASSERT_EQ(made.exit, 0) << made.errors;
  EXPECT_LT(made.json().at("measured_error_relative").get<double>(), 1e-2);
  for (const char* decoder : {"linear", "two-step-gn"}) { // the second inverts the design's field
    const Outcome trained = palp::test::palp({"train", samples, "--input", "resistance", "--rows", "all", "--decoder",
                                              decoder, "--design", design, "--force", "-o", network, "--json"});
    ASSERT_EQ(trained.exit, 0) << trained.errors;
    const Outcome predicted = palp::test::palp({"predict", network, samples, "--json"});
    ASSERT_EQ(predicted.exit, 0) << predicted.errors;
    const json said = predicted.json();
    for (const json& percent : said.at("error").at("rmse_percent_of_range")) EXPECT_LT(percent.get<double>(), 5);
  }
}

TEST(Commands, SolveSaysAllThatToolsRelyOn) {
  const Outcome outcome = palp::test::palp({"solve", "paper", "--load", "0:1,0,-6", "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  const json result = outcome.json();
  EXPECT_TRUE(result.at("converged").get<bool>());
  EXPECT_EQ(result.at("reached_load_fraction"), 1.0);
  EXPECT_GE(result.at("newton").size(), 2U);
  for (const char* key : {"load_fraction", "iteration", "relative_residual"})
    EXPECT_TRUE(result.at("newton")[0].contains(key)) << key;
  ASSERT_EQ(result.at("displacements_mm").size(), 10U);
  ASSERT_EQ(result.at("displacements_mm")[4].size(), 10U);
  ASSERT_EQ(result.at("displacements_mm")[4][0].size(), 3U);
  ASSERT_EQ(result.at("resistances_ohm").size(), 10U);
  ASSERT_EQ(result.at("resistances_ohm")[4].size(), 30U);
  ASSERT_EQ(result.at("resistances_at_rest_ohm").size(), 10U);
  EXPECT_GT(result.at("dof").get<int>(), 1000);
  EXPECT_TRUE(result.contains("elements") && result.contains("element_type"));
  EXPECT_LT(result.at("max_volume_error").get<double>(), 0.2);
  EXPECT_GT(result.at("error_estimate_relative").get<double>(), 0);
  EXPECT_TRUE(result.at("error_estimate_method").is_string());
  for (const char* stage : {"mesh", "factorise", "solve"}) EXPECT_TRUE(hasStage(result, stage)) << stage;
  // The paper's pressed corner moves down by some hundredths of a millimetre (converged: 0.0344 mm).
  EXPECT_NEAR(result.at("displacements_mm")[4][0][2].get<double>(), -0.034354, 0.05 * 0.034354);
}

TEST(Commands, SolveWithAnIndenterSaysForceWayAndContact) {
  const json result =
      palp::test::palp({"solve", "paper", "--indenter", "sphere:12@15,9:press=0,0,-3", "--mapped", "15x15x4", "--json"})
          .json();
  ASSERT_TRUE(result.at("converged").get<bool>());
  ASSERT_EQ(result.at("indenters").size(), 1U);
  const json& sphere = result.at("indenters")[0];
  EXPECT_EQ(sphere.at("shape"), "sphere");
  EXPECT_NEAR(sphere.at("force_N")[2].get<double>(), -3, 1e-6);
  EXPECT_LT(sphere.at("translation_mm")[2].get<double>(), 0);
  for (const char* key : {"contact_area_mm2", "contact_radius_mm", "centre_pressure_MPa"})
    EXPECT_GT(sphere.at(key).get<double>(), 0) << key;
  EXPECT_EQ(sphere.at("slip_share").get<double>(), 1) << "without friction nothing sticks";
  ASSERT_EQ(result.at("warnings").size(), 1U) << "hexahedra of 2 mm are too coarse for it";
  EXPECT_NE(result.at("warnings")[0].get<std::string>().find("nodes of the mesh touch"), std::string::npos);
}

TEST(Commands, SolveOnThePapersMappedMesh) {
  const json result =
      palp::test::palp({"solve", "paper", "--load", "0:1,0,-6", "--mapped", "10x10x5", "--json"}).json();
  EXPECT_TRUE(result.at("converged").get<bool>());
  EXPECT_EQ(result.at("elements"), 500);
  EXPECT_EQ(result.at("dof"), 3 * 11 * 11 * 5);
}

TEST(Commands, LoadsActTogether) {
  const json one = palp::test::palp({"solve", "paper", "--load", "1:0,0,-6", "--mapped", "6x6x3", "--json"}).json();
  const json two =
      palp::test::palp({"solve", "paper", "--load", "1:0,0,-3", "--load", "1:0,0,-3", "--mapped", "6x6x3", "--json"})
          .json();
  const double a = one.at("displacements_mm")[4][4][2];
  EXPECT_NEAR(two.at("displacements_mm")[4][4][2].get<double>(), a,
              1e-9 * std::abs(a)); // same load, Newton's tolerance
}

TEST(Commands, AnHonestEndIsExitOneWithTheFractionReached) {
  const Outcome outcome =
      palp::test::palp({"solve", "paper", "--load", "1:10,-10,-2000", "--mapped", "6x6x3", "--json"});
  EXPECT_EQ(outcome.exit, 1) << outcome.errors;
  const json result = outcome.json();
  EXPECT_FALSE(result.at("converged").get<bool>());
  EXPECT_LT(result.at("reached_load_fraction").get<double>(), 1);
  EXPECT_FALSE(result.at("stop_reason").get<std::string>().empty());
}

TEST(Commands, EveryCommandHasHelpWithAnExample) {
  const std::vector<std::string> commands = commandsInHelp();
  ASSERT_GT(commands.size(), 10U);
  for (const std::string& command : commands) {
    const Outcome outcome = palp::test::palp({command, "--help"});
    EXPECT_EQ(outcome.exit, 0) << command;
    EXPECT_NE(outcome.output.find("Example: palp " + command), std::string::npos) << command;
  }
}

TEST(Commands, HelpNamesThePagesThatAreThere) {
  const std::string help = palp::test::palp({"--help"}).output;
  const std::string begin = "Pages: ";
  const std::size_t start = help.find(begin);
  ASSERT_NE(start, std::string::npos) << help;
  const std::filesystem::path folder = help.substr(start + begin.size(), help.find('\n', start) - start - begin.size());
  int pages = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".md") continue;
    ++pages;
    EXPECT_NE(help.find(entry.path().filename().string(), start), std::string::npos) << entry.path();
  }
  EXPECT_GT(pages, 0);
  const std::string ofACommand = palp::test::palp({"mesh", "--help"}).output;
  EXPECT_EQ(ofACommand.find(begin), std::string::npos) << "a command's help has its example there";
}

TEST(Commands, ReproduceSetsThePapersNumbersBesideOurs) {
  const palp::TemporaryFolder folder;
  const Outcome outcome =
      palp::test::palp({"reproduce", "table1", "--mesh-size", "6", "-o", folder / "paper", "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  const json table = outcome.json().at("table1");
  ASSERT_EQ(table.at("default").at("rows").size(), 5U);
  EXPECT_EQ(table.at("paper").at("rows")[4].at("published_percent")[2], 3.44);
  EXPECT_EQ(table.at("linear").at("rows").size(), 1U);
  for (const json& row : table.at("default").at("rows"))
    for (int f = 0; f < 3; ++f)
      EXPECT_LE(row.at("eq13_percent")[f].get<double>(), row.at("published_percent")[f].get<double>());
  const std::string page = readAll(folder / "paper" / "report.html");
  EXPECT_NE(page.find("<table>"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos); // opens with no network
  EXPECT_TRUE(std::filesystem::exists(folder / "paper" / "errors.csv"));
}
