#include "app/gui/project/Workbench.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

/// An edit of the force on the loaded area; its own kind, unless `what` says otherwise.
void press(Workbench& workbench, double fz_N, const QString& what = "force") {
  Project next = workbench.project();
  next.load.areas[0].force_N.z() = fz_N;
  workbench.edit(what, next);
}

double fz_N(const Workbench& workbench) {
  return workbench.project().load.areas[0].force_N.z();
}

TEST(Workbench, MakesEditsOfOneKindInARowOneEntryOfTheHistory) {
  Workbench workbench(exampleProject());
  const Project before = workbench.project();
  for (const double force : {-1.0, -2.0, -3.0}) press(workbench, force);
  EXPECT_EQ(workbench.history().count(), 1);
  workbench.history().undo();
  EXPECT_EQ(workbench.project(), before) << "before the first of them";
  workbench.history().redo();
  EXPECT_EQ(fz_N(workbench), -3) << "after the last of them";
}

TEST(Workbench, KeepsEditsOfAnotherKindApart) {
  Workbench workbench(exampleProject());
  press(workbench, -1, "force");
  press(workbench, -2, "drag");
  press(workbench, -3, "force");
  EXPECT_EQ(workbench.history().count(), 3);
  for (const double force : {-2.0, -1.0}) {
    workbench.history().undo();
    EXPECT_EQ(fz_N(workbench), force);
  }
}

TEST(Workbench, AnEditAfterAnUndoDropsWhatWasUndone) {
  Workbench workbench(exampleProject());
  press(workbench, -1, "force");
  press(workbench, -2, "drag");
  workbench.history().undo();
  press(workbench, -4, "type");
  EXPECT_FALSE(workbench.history().canRedo());
  EXPECT_EQ(workbench.history().count(), 2);
  workbench.history().undo();
  EXPECT_EQ(fz_N(workbench), -1);
}

TEST(Workbench, AnEditThatChangesNothingIsNoEntry) {
  Workbench workbench(exampleProject());
  workbench.edit("nothing", workbench.project());
  EXPECT_EQ(workbench.history().count(), 0);
}

TEST(Workbench, ThereAndBackAgainLeavesNothingToUndo) {
  Workbench workbench(exampleProject());
  const double start_N = fz_N(workbench);
  press(workbench, -1, "other");
  press(workbench, -2);
  press(workbench, -1);
  EXPECT_EQ(workbench.history().count(), 1) << "the entry of the two is gone";
  EXPECT_EQ(fz_N(workbench), -1);
  workbench.history().undo();
  EXPECT_EQ(fz_N(workbench), start_N);
}

TEST(Workbench, AnotherProjectBeginsAHistoryAnew) {
  Workbench workbench(exampleProject());
  press(workbench, -1);
  workbench.replace("Open", exampleProject());
  EXPECT_FALSE(workbench.history().canUndo());
}

} // namespace
} // namespace palp
