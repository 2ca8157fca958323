#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>

using nlohmann::json;
using namespace palp::test;

namespace {

json sphere(double depth_mm, double shift_mm) {
  return {{"shape", "sphere"}, {"radius_mm", 12},      {"place_mm", {15, 15}},
          {"friction", 0.5},   {"depth_mm", depth_mm}, {"shift_mm", {shift_mm, 0}}};
}

json path(const std::vector<json>& indenters) {
  json steps = json::array();
  for (const json& indenter : indenters) steps.push_back({{"indenters", {indenter}}});
  return steps;
}

Outcome solved(const palp::TemporaryFolder& folder, const std::string& content) {
  writeAll(folder / "path.json", content);
  return palp::test::palp({"solve", "paper", "--loads", folder / "path.json", "--mapped", "12x12x3", "--json"});
}

TEST(SolvePath, GivesARowAStepEachGoingOnFromTheOneBefore) {
  const palp::TemporaryFolder folder;
  const json result = solved(folder, path({sphere(0.3, 0), sphere(0.3, 0.1), sphere(0.3, 0)}).dump()).json();
  ASSERT_TRUE(result.at("converged").get<bool>());
  const json& steps = result.at("steps");
  ASSERT_EQ(steps.size(), 3U);
  for (const json& step : steps) {
    EXPECT_TRUE(step.at("converged").get<bool>());
    EXPECT_NEAR(step.at("indenters")[0].at("translation_mm")[2].get<double>(), -0.3, 1e-12);
    EXPECT_EQ(step.at("resistances_ohm").size(), 10U);
    EXPECT_EQ(step.at("displacements_mm").size(), 10U);
  }
  const auto aside_N = [&](int step) { return steps[step].at("indenters")[0].at("force_N")[0].get<double>(); };
  EXPECT_GT(aside_N(1), 0.01);
  EXPECT_LT(aside_N(2), 0) << "what slid on the way there pulls on the way back";
}

TEST(SolvePath, ABrokenFileIsRefusedInOneLine) {
  const palp::TemporaryFolder folder;
  json larger = sphere(0.3, 0.1), both = sphere(0.3, 0), unknown = both, off = both, nothing = both, text = both;
  larger["radius_mm"] = 13;
  both["force_N"] = {0, 0, -1};
  unknown["colour"] = "red";
  off["place_mm"] = {40, 15};
  nothing.erase("depth_mm");
  nothing.erase("shift_mm");
  text["depth_mm"] = "deep";
  json noIndenters = json::array({{{"indenters", json::array()}}});
  const std::vector<std::pair<std::string, std::string>> broken{
      {path({sphere(0.3, 0), larger}).dump(), "step 1 of the path"},
      {path({both}).dump(), "either force_N or depth_mm"},
      {path({nothing}).dump(), "either force_N or depth_mm"},
      {path({unknown}).dump(), "colour"},
      {path({off}).dump(), "(40, 15)"},
      {path({text}).dump(), "deep"},
      {path({sphere(-1, 0)}).dump(), "-1"},
      {noIndenters.dump(), "indenters: got 0"},
      {"[]", "steps of the path: got 0"},
      {"{}", "a list"},
      {"[{\"indenters\": [", "not valid JSON"},
      {"[{\"indenters\": [{\"shape\": \"sphere\", \"radius_mm\": NaN}]}]", "not valid JSON"}};
  for (const auto& [content, word] : broken) {
    SCOPED_TRACE(content);
    const Outcome outcome = solved(folder, content);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find(word), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("path.json"), std::string::npos) << outcome.errors;
  }
  const Outcome beside = palp::test::palp(
      {"solve", "paper", "--loads", folder / "path.json", "--indenter", "sphere:5@15,15:press=0,0,-1"});
  EXPECT_EQ(beside.exit, 2);
  EXPECT_NE(beside.errors.find("--indenter"), std::string::npos) << beside.errors;
}

} // namespace
