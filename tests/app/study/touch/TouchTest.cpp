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
  softer.material.c10_MPa /= 2;
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
