#include "io/DesignFile.h"

#include "io/StrictJson.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <limits>

namespace palp {
namespace {

/// The paper's design as text, with one piece replaced.
std::string paperWith(const std::string& piece, const std::string& replacement) {
  std::string json = toJson(paperDesign());
  const std::size_t at = json.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return json.replace(at, piece.size(), replacement);
}

SensorDesign detailedDesign() {
  SensorDesign design = paperDesign();
  design.material.poissonRatio = 1.0 / 3.0;
  design.lowerFollowsRubber = true;
  design.pressureLaw = PressureLaw{0.1, 0.7};
  design.lower.along_mm.assign(30, {5, 15, 25});
  design.lower.along_mm[7] = {4.9, 15.1, 25};
  design.lower.z_mm.assign(30, {1, 1.5, 2});
  design.forceRange.low_N = {-0.1, -0.2, -0.3};
  return design;
}

SensorDesign fieldDesign() {
  SensorDesign design = detailedDesign();
  design.resistance = FieldLaw{1234.5, 0.15, 1.0 / 3, 2.5, Readout::RowsGrounded};
  return design;
}

TEST(DesignFile, ReadsBackTheDesignThatItWrote) {
  for (const SensorDesign& design : {paperDesign(), detailedDesign(), fieldDesign()})
    EXPECT_EQ(parseDesign(toJson(design), "x.json"), design);
}

TEST(DesignFile, ReadsBackEveryLawOfTheRubber) {
  for (const RubberLaw& law : {RubberLaw(NeoHooke{1.0 / 3}), RubberLaw(Yeoh{0.2, -0.03, 1e-5}),
                               RubberLaw(Gent{0.4, 12.5}), RubberLaw(Ogden{{0.4, 0.02, -0.1}, {2, 5, -1.5}})}) {
    SensorDesign design = paperDesign();
    design.material.law = law;
    EXPECT_EQ(parseDesign(toJson(design), "x.json"), design);
    EXPECT_NE(designFingerprint(design), designFingerprint(paperDesign()));
  }
}

TEST(DesignFile, MooneyRivlinNeedNotBeSaidAndIsNotWritten) {
  const std::string piece = "\"material\": { ";
  EXPECT_EQ(parseDesign(paperWith(piece, piece + "\"law\": \"mooney-rivlin\", "), "x"), paperDesign());
  EXPECT_NE(toJson(paperDesign())
                .find("\"material\": { \"c10_MPa\": 0.3286, \"c01_MPa\": 0.08215, \"poisson_ratio\": 0.499, "
                      "\"density_t_per_mm3\": 1e-09 },\n"),
            std::string::npos);
}

TEST(DesignFile, RefusesKeysOfAnotherLaw) {
  const std::string piece = "\"material\": { ";
  const auto refused = [&](const std::string& law) {
    return refusal([&] { (void)parseDesign(paperWith(piece, piece + "\"law\": \"" + law + "\", "), "x.json"); });
  };
  EXPECT_NE(refused("yeoh").find("unknown key material.c01_MPa"), std::string::npos) << refused("yeoh");
  EXPECT_NE(refused("arruda-boyce").find("mooney-rivlin, neo-hooke, yeoh, gent or ogden"), std::string::npos)
      << refused("arruda-boyce");
  const std::string missing = refusal([&] {
    (void)parseDesign(paperWith("\"c10_MPa\": 0.3286, \"c01_MPa\": 0.08215", "\"law\": \"ogden\", \"mu_MPa\": [1]"),
                      "x");
  });
  EXPECT_NE(missing.find("material.alpha is missing"), std::string::npos) << missing;
}

TEST(DesignFile, WritesTheShortFormWhereTheDesignHasIt) {
  EXPECT_NE(toJson(paperDesign()).find("\"electrode_y_mm\": [5, 15, 25]"), std::string::npos);
  EXPECT_NE(toJson(paperDesign()).find("\"z_mm\": 4,"), std::string::npos);
  EXPECT_NE(toJson(detailedDesign()).find("[4.9, 15.1, 25]"), std::string::npos);
}

TEST(DesignFile, PairsNeedNotBeSaidAndAreNotWritten) {
  const std::string piece = "\"resistance\": { ";
  EXPECT_EQ(parseDesign(paperWith(piece, piece + "\"law\": \"pairs\", "), "x"), paperDesign());
  EXPECT_EQ(toJson(paperDesign()).find("law\": \"pairs"), std::string::npos);
}

TEST(DesignFile, WritesTheFieldWithAllOfItsNumbers) {
  EXPECT_NE(toJson(fieldDesign())
                .find("\"resistance\": { \"law\": \"field\", \"resistivity_ohm_mm\": 1234.5, "
                      "\"electrode_radius_mm\": 0.15, \"contact_ohm_mm2\": 0.3333333333333333, \"wire_ohm\": 2.5, "
                      "\"readout\": \"rows_grounded\", \"pressure_law\": { "),
            std::string::npos)
      << toJson(fieldDesign());
}

TEST(DesignFile, StandsWithinAnotherFileUnderEitherLaw) {
  for (const SensorDesign& design : {paperDesign(), fieldDesign()}) {
    const Json json = parseJson(toJson(design), "x");
    EXPECT_EQ(readDesign(JsonPlace(json, "x")), design);
  }
}

TEST(DesignFile, SavesAndLoads) {
  const TemporaryFolder folder;
  saveDesign(folder / "a.json", detailedDesign(), false);
  EXPECT_EQ(loadDesign(folder / "a.json"), detailedDesign());
  EXPECT_FALSE(refusal([&] { saveDesign(folder / "a.json", paperDesign(), false); }).empty());
}

TEST(DesignFile, RefusesADesignThatCannotBeBuilt) {
  const TemporaryFolder folder;
  put(folder / "a.json", paperWith("\"poisson_ratio\": 0.499", "\"poisson_ratio\": 0.7"));
  const std::string sentence = refusal([&] { loadDesign(folder / "a.json"); });
  for (const char* part : {"a.json", "material.poisson_ratio", "0.7", "0 to 0.5"})
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  SensorDesign design = paperDesign();
  design.block_mm.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refusal([&] { saveDesign(folder / "b.json", design, false); }).empty());
  EXPECT_FALSE(std::filesystem::exists(folder / "b.json"));
}

TEST(DesignFile, FingerprintFollowsTheDesignAndNothingElse) {
  const std::string paper = designFingerprint(paperDesign());
  EXPECT_EQ(paper, "c0ef9caa8fec76b8"); // files of samples carry it: a change of the writer must not change it
  EXPECT_EQ(designFingerprint(parseDesign(toJson(paperDesign()), "x")), paper);
  SensorDesign design = paperDesign();
  design.upper.wire_mm[3] = std::nextafter(design.upper.wire_mm[3], 100.0);
  EXPECT_NE(designFingerprint(design), paper);
  design = paperDesign();
  design.resistance = FieldLaw{};
  const std::string field = designFingerprint(design);
  EXPECT_NE(field, paper);
  design.resistance = FieldLaw{.readout = Readout::VirtualGround}; // another board
  EXPECT_NE(designFingerprint(design), field);
}

struct Slip {
  const char* piece;
  const char* replacement;
  std::vector<const char*> sentence; ///< what the refusal must say
};

void PrintTo(const Slip& slip, std::ostream* out) {
  *out << slip.piece << " -> " << slip.replacement;
}

class DesignFileSlip : public testing::TestWithParam<Slip> {};

TEST_P(DesignFileSlip, IsRefusedInOneSentence) {
  const std::string json = paperWith(GetParam().piece, GetParam().replacement);
  const std::string sentence = refusal([&] { parseDesign(json, "sensor.json"); });
  EXPECT_EQ(sentence.find('\n'), std::string::npos);
  EXPECT_EQ(sentence.rfind("sensor.json: ", 0), 0U) << sentence;
  for (const char* part : GetParam().sentence) EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
}

INSTANTIATE_TEST_SUITE_P(
    Each, DesignFileSlip,
    testing::Values(
        Slip{"\"palp_design\": 1", "\"palp_design\": 2", {"palp_design", "2", "newer"}},
        Slip{"\"palp_design\": 1", "\"palp_design\": 0", {"palp_design", "0", "1"}},
        Slip{"\"palp_design\": 1", "\"palp_design\": \"1\"", {"palp_design", "\"1\"", "whole number"}},
        Slip{"\"palp_design\": 1,", "", {"palp_design is missing"}},
        Slip{"\"block_mm\"", "\"blok_mm\"", {"unknown key blok_mm", "block_mm"}},
        Slip{"\"block_mm\": [30, 30, 5],", "", {"block_mm is missing"}},
        Slip{"[30, 30, 5]", "[30, 30]", {"block_mm", "[30,30]", "3 numbers"}},
        Slip{"[30, 30, 5]", "[30, \"a\", 5]", {"block_mm[1]", "\"a\"", "a number"}},
        Slip{"[30, 30, 5]", "7", {"block_mm: got 7", "list of numbers"}},
        Slip{"[30, 30, 5]", "[30, 30, NaN]", {"not valid JSON", "line 2"}},
        Slip{"[30, 30, 5]", "[30, 30, Infinity]", {"not valid JSON", "line 2"}},
        Slip{"[30, 30, 5]", "[30, 30, 1e999]", {"not valid JSON", "1e999"}},
        Slip{"0.499", "\"0.499\"", {"material.poisson_ratio", "\"0.499\"", "a number"}},
        Slip{"0.499", "null", {"material.poisson_ratio: got null", "a number"}},
        Slip{"\"poisson_ratio\": 0.499", "\"nu\": 0.499", {"unknown key material.nu", "poisson_ratio"}},
        Slip{"\"columns\": 3", "\"columns\": 2.5", {"areas.columns: got 2.5", "whole number"}},
        Slip{"\"columns\": 3", "\"columns\": 1e20", {"areas.columns", "whole number"}},
        Slip{"\"z_mm\": 4", "\"z_mm\": [4]", {"upper_layer.z_mm", "[4]", "one depth"}},
        Slip{"\"z_mm\": 1", "\"z_mm\": [[1], 2]", {"lower_layer.z_mm[1]", "list of numbers"}},
        Slip{"[5, 15, 25]", "[[5, 15, 25], [5, true]]", {"lower_layer.electrode_y_mm[1][1]: got true"}},
        Slip{"\"follows_rubber\": false", "\"follows_rubber\": 0", {"lower_layer.follows_rubber", "true or false"}},
        Slip{"\"pressure_law\": null", "\"pressure_law\": {}", {"resistance.pressure_law.p0_MPa is missing"}},
        Slip{"{ \"rate_ohm_per_mm\"",
             "{ \"law\": \"eq1\", \"rate_ohm_per_mm\"",
             {"resistance.law", "\"eq1\"", "pairs or field"}},
        Slip{"{ \"rate_ohm_per_mm\"", "{ \"law\": 2, \"rate_ohm_per_mm\"", {"resistance.law: got 2", "a text"}},
        Slip{"{ \"rate_ohm_per_mm\"",
             "{ \"readout\": \"floating\", \"rate_ohm_per_mm\"",
             {"unknown key resistance.readout"}},
        Slip{"{ \"rate_ohm_per_mm\"",
             "{ \"law\": \"field\", \"rate_ohm_per_mm\"",
             {"unknown key resistance.rate_ohm_per_mm"}},
        Slip{"\"rate_ohm_per_mm\": 1000", "\"law\": \"field\"", {"resistance.resistivity_ohm_mm is missing"}},
        Slip{"\"rate_ohm_per_mm\": 1000",
             "\"law\": \"field\", \"resistivity_ohm_mm\": 1, \"electrode_radius_mm\": 0.2, \"contact_ohm_mm2\": 0, "
             "\"wire_ohm\": 0, \"readout\": \"grounded\"",
             {"resistance.readout: got \"grounded\"", "virtual_ground"}},
        Slip{"\"x\": [-1, 1]", "\"x\": [-1]", {"force_range_N.x", "2 numbers"}},
        Slip{"\"rows\": 2", "\"rows\": 2, \"rows\": 3", {"\"rows\" appears twice"}},
        Slip{"] } }\n", "", {"not valid JSON"}}));

TEST(DesignFile, RefusesEveryTruncation) {
  const std::string whole = toJson(paperDesign());
  for (std::size_t length = 0; length + 2 < whole.size(); ++length)
    EXPECT_FALSE(refusal([&] { parseDesign(whole.substr(0, length), "x"); }).empty()) << length;
}

TEST(DesignFile, RefusesWhatIsNoObject) {
  for (const char* json : {"[]", "3", "\"x\"", "{}", "null"})
    EXPECT_NE(refusal([&] { parseDesign(json, "x"); }).find("not a design file"), std::string::npos) << json;
}

} // namespace
} // namespace palp
