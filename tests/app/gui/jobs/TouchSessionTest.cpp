#include "tests/app/gui/WindowFixture.h"

#include <QLabel>
#include <QLineEdit>

namespace palp {
namespace {

class TouchSessionTest : public WindowFixture {};

TEST_F(TouchSessionTest, SolvesWhatWasEditedOnAnotherSceneWhileASolveRan) {
  ASSERT_TRUE(solved());
  Project heavy = workbench.project();
  heavy.mesh = {1.2, {}}; // solved for so long that the clicks below come first
  workbench.edit("finer", heavy);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().runner().running(); }, kPatience_ms));
  window.showScene("design");
  auto& height = find<QLineEdit>("block_mm[2]");
  height.setFocus();
  height.selectAll();
  QTest::keyClicks(&height, "6");
  Project light = workbench.project();
  ASSERT_EQ(light.design.block_mm.z(), 6);
  light.mesh = quickProject().mesh;
  workbench.edit("coarser", light);
  ASSERT_TRUE(workbench.touch().runner().running()) << "the solve of the old inputs ended before the edit";
  window.showScene("deformation");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !workbench.touch().runner().running(); }, kPatience_ms));
  EXPECT_TRUE(workbench.touch().upToDate()) << "nothing runs, and what is shown is of the old inputs";
  EXPECT_EQ(workbench.touch().touch().design().block_mm.z(), 6);
}

TEST_F(TouchSessionTest, ComputesWhatIsNeededAgainWhereOnlyAnEstimateRuns) {
  ASSERT_TRUE(solved());
  workbench.touch().estimateError();
  window.showScene("design");
  Project next = workbench.project();
  next.load.areas[0].force_N.z() = -2;
  workbench.edit("force", next);
  window.showScene("deformation");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !workbench.touch().runner().running(); }, kPatience_ms));
  EXPECT_TRUE(workbench.touch().upToDate());
}

TEST_F(TouchSessionTest, KeepsTheLastGoodResultAfterACancel) {
  ASSERT_TRUE(solved());
  const Solution* good = workbench.touch().touch().solution();
  Project heavy = workbench.project();
  heavy.mesh = {1.2, {}};
  workbench.edit("finer", heavy);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().runner().running(); }, kPatience_ms));
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  EXPECT_EQ(workbench.touch().touch().solution(), good);
  EXPECT_FALSE(workbench.touch().upToDate());
}

TEST_F(TouchSessionTest, WhatIsShownHoldsAgainAtOnceWhereAChangeIsUndone) {
  ASSERT_TRUE(solved());
  ASSERT_TRUE(idle());
  const TouchSession& touch = workbench.touch();
  for (const char* scene : {"design", "deformation"}) { // nothing is solved on the first, the second is at it
    window.showScene(scene);
    Project other = workbench.project();
    other.design.upper.z_mm[0][0] -= 0.5;
    workbench.edit("another layout", other);
    EXPECT_FALSE(touch.upToDate());
    workbench.history().undo();
    EXPECT_TRUE(touch.upToDate()) << scene;
    EXPECT_FALSE(touch.missing());
  }
  ASSERT_TRUE(idle());
  settle();
  EXPECT_TRUE(find<QWidget>("staleNote").isHidden());
  EXPECT_FALSE(find<QLabel>("result").text().contains("Outdated"));
  EXPECT_EQ(touch.stages().runs("solve"), 1) << "nothing was solved again";
}

} // namespace
} // namespace palp
