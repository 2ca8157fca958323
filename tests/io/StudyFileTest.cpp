#include "io/StudyFile.h"

#include "io/AtomicFile.h"
#include "io/StrictJson.h"
#include "model/base/Error.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace palp {
namespace {

StudyPlan planFrom(const TemporaryFolder& folder, const std::string& json) {
  writeFile(folder / "study.json", json, true);
  return loadStudy(folder / "study.json");
}

const std::string kTwoAxes = R"({"palp_study": 1, "design": "paper", "compute": ["bound"],
  "vary": [{"key": "upper_layer.z_mm", "values": [3.5, 4]},
           {"key": "material.c10_MPa", "from": 0.1, "to": 0.4, "count": 3, "scale": "log"}]})";

TEST(StudyFile, AFullFactorialHasEveryCombinationOnce) {
  const TemporaryFolder folder;
  const StudyPlan plan = planFrom(folder, kTwoAxes);
  ASSERT_EQ(plan.designs(), 6U);
  std::set<std::pair<double, double>> seen;
  for (std::size_t i = 0; i < plan.designs(); ++i) {
    const SensorDesign design = plan.at(i);
    seen.emplace(design.upper.z_mm[0][0], std::get<MooneyRivlin>(design.material.law).c10_MPa);
    EXPECT_EQ(design.block_mm, paperDesign().block_mm) << "what does not vary stays";
  }
  const std::set<std::pair<double, double>> wanted{{3.5, 0.1}, {4, 0.1}, {3.5, 0.2}, {4, 0.2}, {3.5, 0.4}, {4, 0.4}};
  ASSERT_EQ(seen.size(), wanted.size());
  auto w = wanted.begin();
  for (const auto& [z, c10] : seen) {
    EXPECT_DOUBLE_EQ(z, w->first);
    EXPECT_DOUBLE_EQ(c10, w->second);
    ++w;
  }
}

TEST(StudyFile, ALatinHypercubeHasOnePointInEachStratumOfEachAxis) {
  const TemporaryFolder folder;
  const std::string json =
      R"({"palp_study": 1, "design": "paper", "compute": ["bound"], "latin_hypercube": 20, "seed": 3,
    "vary": [{"key": "block_mm.2", "from": 4.5, "to": 6.5}, {"key": "material.c10_MPa", "from": 0.1, "to": 10, "scale": "log"},
             {"key": "lower_layer.follows_rubber", "values": [false, true]}]})";
  const StudyPlan plan = planFrom(folder, json);
  ASSERT_EQ(plan.designs(), 20U);
  std::set<int> heights, moduli;
  int follow = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    const SensorDesign design = plan.at(i);
    heights.insert(static_cast<int>((design.block_mm.z() - 4.5) / 2 * 20));
    moduli.insert(static_cast<int>(std::log10(std::get<MooneyRivlin>(design.material.law).c10_MPa / 0.1) / 2 * 20));
    follow += design.lowerFollowsRubber ? 1 : 0;
    EXPECT_EQ(plan.values(i), planFrom(folder, json).values(i)) << "from the plan alone";
  }
  EXPECT_EQ(heights.size(), 20U);
  EXPECT_EQ(moduli.size(), 20U);
  EXPECT_EQ(follow, 10);
  const StudyPlan other = planFrom(folder, std::string(json).replace(json.find("\"seed\": 3"), 9, "\"seed\": 4"));
  EXPECT_NE(plan.values(0), other.values(0));
}

TEST(StudyFile, ReadsItsOwnText) {
  const TemporaryFolder folder;
  const StudyPlan plan = planFrom(folder, kTwoAxes);
  const StudyPlan again = planFrom(folder, toJson(plan));
  EXPECT_EQ(toJson(again), toJson(plan));
  for (std::size_t i = 0; i < plan.designs(); ++i) EXPECT_EQ(again.values(i), plan.values(i));
}

TEST(StudyFile, ReadsADesignBesideItAndOneWithin) {
  const TemporaryFolder folder;
  const std::string within = planFrom(folder, kTwoAxes).design;
  std::filesystem::create_directory(folder / "sub");
  writeFile(folder / "sub" / "d.json", within, true);
  std::string json = kTwoAxes;
  json.replace(json.find("\"paper\""), 7, "\"sub/d.json\"");
  EXPECT_EQ(planFrom(folder, json).design, within);
  json = kTwoAxes;
  json.replace(json.find("\"paper\""), 7, within);
  EXPECT_EQ(planFrom(folder, json).design, within);
}

struct Broken {
  const char *from, *to, *says;
};

class BrokenStudy : public testing::TestWithParam<Broken> {};

TEST_P(BrokenStudy, IsRefusedInOneLineWithWhatIsAllowed) {
  const TemporaryFolder folder;
  std::string json = kTwoAxes;
  const std::string from = GetParam().from;
  ASSERT_NE(json.find(from), std::string::npos);
  json.replace(json.find(from), from.size(), GetParam().to);
  const std::string said = refusal([&] { planFrom(folder, json); });
  EXPECT_NE(said.find(GetParam().says), std::string::npos) << said;
  EXPECT_NE(said.find("study.json"), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

INSTANTIATE_TEST_SUITE_P(
    Each, BrokenStudy,
    testing::Values(Broken{"upper_layer.z_mm", "upper_layer.depth", "a key of the design"},
                    Broken{"upper_layer.z_mm", "upper_layer", "a key of the design"},
                    Broken{"upper_layer.z_mm", "block_mm.3", "a key of the design"},
                    Broken{"material.c10_MPa", "upper_layer.z_mm", "each key once"},
                    Broken{"[3.5, 4]", "[]", "at least one value"}, Broken{"\"count\": 3", "\"count\": 1", "count"},
                    Broken{"\"count\": 3", "\"count\": 100000000", "count"},
                    Broken{"\"from\": 0.1", "\"from\": -0.1", "above 0"}, Broken{"\"log\"", "\"exp\"", "linear or log"},
                    Broken{"\"from\": 0.1", "\"from\": 1e-320", "below 1e308"},
                    Broken{"[3.5, 4]}",
                           "[3.5]}, {\"key\": \"block_mm.2\", \"from\": -1e308, \"to\": 1e308, \"count\": 3}",
                           "below 1e308"},
                    Broken{"[\"bound\"]", "[\"bound\", \"bound\"]", "each once"},
                    Broken{"\"compute\"", "\"decoders\": [\"gp\", \"gp\"], \"compute\"", "each once"},
                    Broken{"\"bound\"", "\"beauty\"", "beauty"}, Broken{"[\"bound\"]", "[]", "compute"},
                    Broken{"\"palp_study\": 1", "\"palp_study\": 2", "palp_study"},
                    Broken{"\"compute\"", "\"weight\": 1, \"compute\"", "weight"},
                    Broken{"\"compute\"", "\"noise\": 0, \"compute\"", "noise"},
                    Broken{"\"compute\"", "\"decoders\": [\"touch\"], \"compute\"", "areas"},
                    Broken{"\"compute\"", "\"mapped\": [0, 2, 2], \"compute\"", "mapped"}));

TEST(StudyFile, AnIllegalValueIsARowsProblemNotTheFiles) {
  const TemporaryFolder folder;
  std::string json = kTwoAxes;
  json.replace(json.find("[3.5, 4]"), 8, "[3.5, \"deep\"]");
  const StudyPlan plan = planFrom(folder, json);
  EXPECT_NO_THROW(static_cast<void>(plan.at(0)));
  EXPECT_THROW(static_cast<void>(plan.at(1)), Error);
}

TEST(StudyFile, AxesAreWrittenInWordsAndReadAgain) {
  for (const std::string words :
       {"3..6 x 4", "0.1..10 x 5 log", "-1..1.5", "1e-3..1e3 log", "3, 4.5, 6", "true, false"})
    EXPECT_EQ(studyWords(studyAxis("k", words)), words == "1e-3..1e3 log" ? "0.001..1000 log"
                                                 : words == "true, false" ? "true, false"
                                                                          : words);
  EXPECT_EQ(studyAxis("k", " 3 .. 6x4 log ").count, 4);
  EXPECT_EQ(studyAxis("k", "[1, 2], [1, 3]").values.size(), 2U);
  for (const char* broken : {"3..", "..6", "3..6 x", "3..6 x -2", "3..6 y 4", "", "1,,2", "abc", "3..6 x 99999999"})
    EXPECT_THROW(studyAxis("k", broken), Error) << broken;
}

TEST(StudyFile, OffersTheNumbersOfADesign) {
  const std::vector<std::string> keys = studyKeys(paperDesign());
  for (const char* wanted : {"block_mm.2", "material.c10_MPa", "upper_layer.z_mm", "lower_layer.column_wire_x_mm.29"})
    EXPECT_NE(std::find(keys.begin(), keys.end(), wanted), keys.end()) << wanted;
  EXPECT_EQ(studyNumber(paperDesign(), "block_mm.2"), 5);
  EXPECT_THROW(studyNumber(paperDesign(), "lower_layer.follows_rubber"), Error);
}

} // namespace
} // namespace palp
