#include "tests/app/cli/Process.h"

#include "io/DesignFile.h"
#include "io/SampleFile.h"
#include "tests/io/TemporaryFolder.h"
#include "tests/io/board/BoardAtRest.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

using nlohmann::json;
using namespace palp::test;

namespace {

palp::SensorDesign restingDesign(palp::Readout readout) {
  palp::SensorDesign design = palp::paperDesign();
  palp::FieldLaw law;
  law.readout = readout;
  design.resistance = law;
  return design;
}

class CalibrateAtRest : public testing::Test {
protected:
  CalibrateAtRest() {
    settings_.disturbance.noise = 1e-4;
    palp::saveDesign(design_, restingDesign(palp::Readout::VirtualGround), false);
  }
  void record(const palp::SensorDesign& design) {
    palp::recordBoard(recording_, settings_, palp::fieldAtRest_ohm(design), 20);
  }
  Outcome calibrate() {
    return palp::test::palp(
        {"calibrate", "--rest", recording_.string(), "--design", design_.string(), "-o", fitted_.string(), "--json"});
  }

  palp::TemporaryFolder folder_;
  std::filesystem::path design_ = folder_ / "design.json";
  std::filesystem::path recording_ = folder_ / "rest.palprec";
  std::filesystem::path fitted_ = folder_ / "fitted.json";
  palp::BoardSettings settings_;
};

TEST_F(CalibrateAtRest, WritesTheDesignWithTheNumbersOfTheBoard) {
  palp::SensorDesign twin = restingDesign(palp::Readout::VirtualGround);
  std::get<palp::FieldLaw>(twin.resistance).electrodeRadius_mm = 0.25;
  std::get<palp::FieldLaw>(twin.resistance).contact_ohm_mm2 = 100;
  record(twin);
  const Outcome outcome = calibrate();
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  const json result = json::parse(outcome.output);
  const double deviation_mm = result.at("electrode_radius_deviation_mm");
  EXPECT_GT(deviation_mm, 0);
  EXPECT_EQ(result.at("why_no_fit"), "");
  const palp::SensorDesign fitted = palp::loadDesign(fitted_);
  EXPECT_NEAR(fitted.field()->electrodeRadius_mm, 0.25, 4 * deviation_mm);
  EXPECT_EQ(fitted.field()->readout, palp::Readout::VirtualGround);
  EXPECT_EQ(fitted.upper, twin.upper);
}

TEST_F(CalibrateAtRest, SaysThatABoardReadsOtherwiseThanTheDesign) {
  record(restingDesign(palp::Readout::Floating));
  Outcome outcome = calibrate();
  EXPECT_EQ(outcome.exit, 1) << outcome.errors;
  EXPECT_NE(outcome.errors.find("read-out floating leaves"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(fitted_));
  settings_.info.readout = palp::Readout::Floating; // now it says so itself
  record(restingDesign(palp::Readout::Floating));
  outcome = calibrate();
  EXPECT_EQ(outcome.exit, 2) << outcome.errors;
  EXPECT_NE(outcome.errors.find("the board has read-out floating, the design virtual_ground"), std::string::npos)
      << outcome.errors;
}

TEST_F(CalibrateAtRest, NamesABrokenWireAndRefusesWhatCannotBe) {
  settings_.faults.openColumns = {12};
  record(restingDesign(palp::Readout::VirtualGround));
  Outcome outcome = calibrate();
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.errors.find("column-wire 12"), std::string::npos) << outcome.errors;
  outcome = palp::test::palp({"calibrate", "--rest", recording_.string(), "-o", fitted_.string()});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.errors.find("give --design"), std::string::npos) << outcome.errors;
  settings_.faults.openColumns.clear();
  record(restingDesign(palp::Readout::VirtualGround));
  palp::saveDesign(design_, palp::paperDesign(), true);
  outcome = calibrate();
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_NE(outcome.errors.find("resistance.law: got pairs"), std::string::npos) << outcome.errors;
}

/// As a load cell gives them, for which a push is positive.
TEST(CalibrateCommand, WritesNoNetworkThatIsTurnedRoundUnlessForced) {
  const palp::TemporaryFolder folder;
  const std::string network = PALP_SOURCE_DIR "/resources/board/paper-network.json";
  const palp::SampleSet samples = palp::loadSamples(PALP_SOURCE_DIR "/resources/board/paper-samples.csv");
  std::vector<Eigen::Index> some;
  for (Eigen::Index i = 0; i < samples.size(); i += 6) some.push_back(i);
  palp::SampleSet frames = palp::samplesAt(samples, some);
  const auto refined = [&](std::vector<std::string> more) {
    palp::saveSamples(folder / "frames.csv", frames, true);
    more.insert(more.begin(), {"calibrate", network, folder / "frames.csv", "-o", folder / "better.json", "--json"});
    return palp::test::palp(more);
  };
  ASSERT_EQ(refined({}).exit, 0);
  std::filesystem::remove(folder / "better.json");
  frames.forces_N.row(2) *= -1;
  const Outcome refused = refined({});
  EXPECT_EQ(refused.exit, 2) << refused.errors;
  EXPECT_NE(refused.errors.find("frames.csv: the labels have the opposite sign of Fz"), std::string::npos)
      << refused.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "better.json"));
  const Outcome forced = refined({"--force"});
  EXPECT_EQ(forced.exit, 0) << forced.errors;
  EXPECT_NE(forced.json().at("warnings").dump().find("opposite sign of Fz"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "better.json"));
}

} // namespace
