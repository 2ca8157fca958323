#include "app/study/touch/Touch.h"

#include <gtest/gtest.h>

using palp::Stage;
using palp::Touch;

namespace {

Touch coarseTouch() {
  palp::MeshOptions coarse;
  coarse.mapped = std::array<int, 3>{4, 4, 2};
  palp::LoadCase load;
  load.areas.push_back({0, {0.5, 0, -2}});
  return Touch(palp::paperDesign(), load, coarse);
}

} // namespace

TEST(Touch, ComputesNoFartherThanAsked) {
  Touch touch = coarseTouch();
  EXPECT_TRUE(touch.advance(Stage::Design));
  EXPECT_TRUE(touch.stages().counts().empty());
  EXPECT_TRUE(touch.advance(Stage::Mesh));
  EXPECT_EQ(touch.stages().runs("mesh"), 1);
  EXPECT_EQ(touch.stages().runs("solve"), 0);
  EXPECT_EQ(touch.reached(), Stage::Mesh);
  EXPECT_TRUE(touch.advance(Stage::Resistances));
  EXPECT_EQ(touch.stages().runs("mesh"), 1);
  EXPECT_EQ(touch.stages().runs("solve"), 1);
}

TEST(Touch, AskingTwiceComputesOnce) {
  Touch touch = coarseTouch();
  touch.advance(Stage::Resistances);
  touch.advance(Stage::Resistances);
  EXPECT_EQ(touch.stages().runs("mesh"), 1);
  EXPECT_EQ(touch.stages().runs("factorise"), 1);
  EXPECT_EQ(touch.stages().runs("solve"), 1);
}

TEST(Touch, AnotherLoadKeepsTheMeshAndTheProblem) {
  Touch touch = coarseTouch();
  touch.advance(Stage::Resistances);
  palp::LoadCase other;
  other.areas.push_back({3, {0, 0, -1}});
  touch.setLoad(other);
  EXPECT_EQ(touch.reached(), Stage::Mesh);
  touch.advance(Stage::Resistances);
  EXPECT_EQ(touch.stages().runs("mesh"), 1);
  EXPECT_EQ(touch.stages().runs("factorise"), 1);
  EXPECT_EQ(touch.stages().runs("solve"), 2);
}

TEST(Touch, AnotherDiscNeedsAnotherMeshAndAnotherForceOnItDoesNot) {
  palp::LoadCase load;
  load.patches.push_back({{12, 9}, 1.5, {0, 0, -1}});
  Touch touch(palp::paperDesign(), load, {.meshSize_mm = 7, .mapped = {}});
  touch.advance(Stage::Mesh);
  const int nodes = touch.mesh()->nodeCount();
  load.patches[0].force_N.z() = -2;
  touch.setLoad(load);
  EXPECT_EQ(touch.reached(), Stage::Mesh);
  load.patches[0].centre_mm.x() = 20;
  touch.setLoad(load);
  EXPECT_EQ(touch.reached(), Stage::Design);
  touch.setLoad({}); // nothing to be fine for
  touch.advance(Stage::Mesh);
  EXPECT_LT(touch.mesh()->nodeCount(), nodes);
}

TEST(Touch, AnotherMaterialKeepsTheMesh) {
  Touch touch = coarseTouch();
  touch.advance(Stage::Resistances);
  palp::SensorDesign softer = touch.design();
  std::get<MooneyRivlin>(softer.material.law).c10_MPa /= 2;
  touch.setDesign(softer);
  touch.advance(Stage::Resistances);
  EXPECT_EQ(touch.stages().runs("mesh"), 1);
  EXPECT_EQ(touch.stages().runs("solve"), 2);
}

TEST(Touch, AnotherBlockDropsTheMesh) {
  Touch touch = coarseTouch();
  touch.advance(Stage::Mesh);
  palp::SensorDesign thicker = touch.design();
  thicker.block_mm.z() = 6;
  touch.setDesign(thicker);
  EXPECT_EQ(touch.reached(), Stage::Design);
}

TEST(Touch, TheSameDesignAndLoadAgainChangeNothing) {
  Touch touch = coarseTouch();
  touch.advance(Stage::Resistances);
  touch.setDesign(palp::paperDesign());
  touch.setLoad(palp::LoadCase(touch.load()));
  EXPECT_EQ(touch.reached(), Stage::Resistances);
}

TEST(Touch, ACopyAdvancesAlone) {
  const Touch touch = coarseTouch();
  Touch copy = touch;
  copy.advance(Stage::Resistances);
  EXPECT_EQ(touch.reached(), Stage::Design);
  EXPECT_EQ(copy.reached(), Stage::Resistances);
}

TEST(Touch, TheFieldOfLowerElectrodesThatFollowHasAMeshOfItsOwn) {
  palp::SensorDesign design = palp::paperDesign();
  design.lowerFollowsRubber = true;
  Touch touch(design, {{{0, {0.5, 0, -2}}}, {}}, {}); // a mapped mesh, or a very coarse one, would stay as it is
  ASSERT_TRUE(touch.advance(Stage::Mesh));
  const int nodes = touch.mesh()->nodeCount();
  design.resistance = palp::FieldLaw{};
  touch.setDesign(design);
  EXPECT_EQ(touch.reached(), Stage::Design);
  ASSERT_TRUE(touch.advance(Stage::Mesh));
  const int following = touch.mesh()->nodeCount();
  EXPECT_GT(following, nodes);
  design.pressureLaw = palp::PressureLaw{};
  touch.setDesign(design);
  ASSERT_TRUE(touch.advance(Stage::Mesh));
  EXPECT_GT(touch.mesh()->nodeCount(), following) << "under a pressure law";
}

TEST(Touch, AnotherLawKeepsTheDeformationAndAnotherReadoutTheField) {
  Touch touch = coarseTouch();
  ASSERT_TRUE(touch.advance(Stage::Resistances));
  const palp::Solution* solution = touch.solution();
  const Eigen::MatrixXd pairs = *touch.resistances_ohm();
  palp::SensorDesign field = palp::paperDesign();
  field.resistance = palp::FieldLaw{.readout = palp::Readout::VirtualGround};
  touch.setDesign(field);
  EXPECT_EQ(touch.reached(), Stage::Displacements);
  ASSERT_TRUE(touch.advance(Stage::Resistances));
  EXPECT_EQ(touch.stages().runs("field"), 1);
  std::get<palp::FieldLaw>(field.resistance).readout = palp::Readout::Floating;
  touch.setDesign(field);
  ASSERT_TRUE(touch.advance(Stage::Resistances));
  EXPECT_EQ(touch.stages().runs("field"), 1) << "all read-outs are read of one field";
  const Eigen::MatrixXd floating = *touch.resistances_ohm();
  std::get<palp::FieldLaw>(field.resistance).electrodeRadius_mm = 0.25;
  touch.setDesign(field);
  ASSERT_TRUE(touch.advance(Stage::Resistances));
  EXPECT_EQ(touch.stages().runs("field"), 2) << "thicker electrodes are another field";
  touch.setDesign(palp::paperDesign());
  ASSERT_TRUE(touch.advance(Stage::Resistances));
  EXPECT_EQ(*touch.resistances_ohm(), pairs);
  EXPECT_EQ(touch.solution(), solution);
  EXPECT_EQ(touch.stages().runs("solve"), 1);
  EXPECT_EQ(touch.stages().runs("factorise"), 1);

  std::get<palp::FieldLaw>(field.resistance).electrodeRadius_mm = 0.2;
  Touch fresh(field, touch.load(), touch.meshOptions());
  ASSERT_TRUE(fresh.advance(Stage::Resistances));
  EXPECT_EQ(*fresh.resistances_ohm(), floating) << "the same as of a touch that never had another law";
  EXPECT_EQ(fresh.design(), fresh.problem()->design());
}
