#include "app/study/decoding/RestRecording.h"

#include "model/RestFit.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"
#include "tests/io/board/BoardAtRest.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

SensorDesign restDesign() {
  SensorDesign design = paperDesign();
  FieldLaw law;
  law.readout = Readout::VirtualGround;
  design.resistance = law;
  return design;
}

BoardSettings boardWith(double noise) {
  BoardSettings settings;
  settings.disturbance.noise = noise;
  settings.info.readout = Readout::VirtualGround;
  return settings;
}

TEST(RestRecording, IsTheMeanOfItsFramesWithTheirNoise) {
  const TemporaryFolder folder;
  const Eigen::MatrixXd truth_ohm = fieldAtRest_ohm(restDesign());
  recordBoard(folder / "rest.palprec", boardWith(1e-4), truth_ohm, 25);
  const RestRecording rest = readRest(folder / "rest.palprec");
  EXPECT_GE(rest.frames, 24);
  EXPECT_TRUE(rest.faults.empty());
  EXPECT_EQ(rest.info.readout, Readout::VirtualGround);
  EXPECT_NEAR(rest.noise, 1e-4 / std::sqrt(rest.frames), 0.1 * rest.noise);
  EXPECT_LT((rest.resistances_ohm.array() / truth_ohm.array() - 1).abs().maxCoeff(), 6 * rest.noise);
}

TEST(RestRecording, OfATwinGivesItsNumbersBack) {
  const TemporaryFolder folder;
  SensorDesign twin = restDesign();
  FieldLaw truth = *twin.field();
  truth.electrodeRadius_mm = 0.24;
  truth.resistivity_ohm_mm = 1700;
  truth.contact_ohm_mm2 = 90;
  twin.resistance = truth;
  recordBoard(folder / "rest.palprec", boardWith(1e-4), fieldAtRest_ohm(twin), 20);
  const RestRecording rest = readRest(folder / "rest.palprec");
  const RestFit fit = fitAtRest(restDesign(), rest.resistances_ohm, rest.noise);
  EXPECT_NEAR(fit.law.electrodeRadius_mm, 0.24, 4 * fit.radiusDeviation_mm);
  EXPECT_NEAR(fit.law.resistivity_ohm_mm, 1700, 4 * fit.resistivityDeviation_ohm_mm);
  EXPECT_NEAR(fit.law.contact_ohm_mm2, 90, 4 * fit.contactDeviation_ohm_mm2);
}

TEST(RestRecording, NamesBrokenWires) {
  const TemporaryFolder folder;
  BoardSettings settings = boardWith(1e-4);
  settings.faults.openRows = {4};
  recordBoard(folder / "rest.palprec", settings, fieldAtRest_ohm(restDesign()), 15);
  const RestRecording rest = readRest(folder / "rest.palprec");
  ASSERT_EQ(rest.faults.size(), 1U);
  EXPECT_NE(rest.faults[0].find("row-wire 4"), std::string::npos);
  EXPECT_TRUE(rest.resistances_ohm.row(4).array().isNaN().all());
  EXPECT_FALSE(rest.resistances_ohm.row(5).array().isNaN().any());
}

TEST(RestRecording, RefusesWhatIsNotAtRestOrTooShort) {
  const TemporaryFolder folder;
  const Eigen::MatrixXd rest_ohm = fieldAtRest_ohm(restDesign());
  recordBoard(folder / "short.palprec", boardWith(1e-4), rest_ohm, 5);
  EXPECT_NE(refusal([&] { readRest(folder / "short.palprec"); }).find("at least 10"), std::string::npos);
  recordBoard(folder / "moving.palprec", boardWith(1e-5), rest_ohm, 40,
              [&](double time_s, Eigen::MatrixXd& now_ohm) { now_ohm = rest_ohm * (1 + 1e-3 * std::sin(8 * time_s)); });
  EXPECT_NE(refusal([&] { readRest(folder / "moving.palprec"); }).find("not at rest"), std::string::npos);
}

} // namespace
} // namespace palp
