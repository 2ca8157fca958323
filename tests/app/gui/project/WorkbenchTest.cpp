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

TEST(Workbench, AClosedEntryTakesNoMoreEdits) {
  Workbench workbench(exampleProject());
  press(workbench, -1);
  workbench.closeEntry();
  press(workbench, -2);
  EXPECT_EQ(workbench.history().count(), 2);
}

TEST(Workbench, NamesAnEntryAfterWhatChangedWithItsValues) {
  Workbench workbench(exampleProject());
  Project next = workbench.project();
  next.design.block_mm.x() = 45.5;
  workbench.edit("design", next);
  EXPECT_EQ(workbench.history().text(0), "block size along x 30 -> 45.5 mm");
  next.load.areas = {{0, {0, 0, -3}}};
  const Project loaded = next;
  workbench.edit("load", next);
  next.load.areas[0].force_N.x() = 2;
  workbench.closeEntry();
  workbench.edit("load", next);
  EXPECT_EQ(workbench.history().undoText(), "area 0: (0, 0, -3) -> (2, 0, -3) N");
  next.load.areas.push_back({3, {0, 0, -1}});
  workbench.closeEntry();
  workbench.edit("load", next);
  EXPECT_EQ(workbench.history().undoText(), "area 3: load of (0, 0, -1) N");
  next.load.areas = loaded.load.areas;
  next.network.chosenSpread = 2;
  workbench.closeEntry();
  workbench.edit("the network", next);
  EXPECT_EQ(workbench.history().undoText(), "the network") << "several things at once";
}

TEST(Workbench, HowThingsAreShownIsNoPartOfTheHistoryAndStaysWhenAnEditIsUndone) {
  Workbench workbench(exampleProject());
  press(workbench, -1);
  Project next = workbench.project();
  next.view.edges = !next.view.edges;
  const auto view = next.view;
  workbench.edit("view", next);
  EXPECT_EQ(workbench.history().count(), 1);
  workbench.history().undo();
  EXPECT_EQ(workbench.project().view, view);
  EXPECT_FALSE(workbench.modified()) << "a view is nothing to be saved";
}

TEST(Workbench, UndoNeverLeadsBehindAnotherProject) {
  Workbench workbench(exampleProject());
  press(workbench, -1);
  workbench.replace(exampleProject());
  EXPECT_EQ(workbench.project(), exampleProject());
  EXPECT_FALSE(workbench.modified());
  EXPECT_FALSE(workbench.history().canUndo());
  press(workbench, -2);
  workbench.history().undo();
  workbench.history().undo();
  EXPECT_EQ(workbench.project(), exampleProject()) << "the project that was discarded is back";
}

TEST(Workbench, ARecoveredProjectIsUnsavedUntilItIsSaved) {
  Workbench workbench(exampleProject());
  workbench.replaceUnsaved(exampleProject(), "mine.json");
  EXPECT_TRUE(workbench.modified());
  workbench.saved("mine.json");
  EXPECT_FALSE(workbench.modified());
}

TEST(Workbench, AsksWhoAnswersForWhatWouldEndByAnEdit) {
  Workbench workbench(exampleProject());
  QObject board;
  int asked = 0;
  const Project* next = nullptr;
  workbench.lossQuestion().ask(board, [&](const Leaving& leaving) {
    EXPECT_EQ(leaving.way, Leaving::Way::Edit);
    next = leaving.next;
    ++asked;
    return QStringList();
  });
  press(workbench, -1);
  EXPECT_EQ(asked, 1);
  EXPECT_NE(next, nullptr);
}

TEST(LossQuestion, AsksNobodyWhoIsGoneAndJoinsTheOthersAnswers) {
  LossQuestion question;
  QObject stays;
  {
    QObject goes;
    question.ask(goes, [](const Leaving&) { return QStringList("gone"); });
    question.ask(stays, [](const Leaving&) { return QStringList("a recording"); });
  }
  question.ask(stays, [](const Leaving& leaving) {
    return leaving.way == Leaving::Way::Quit ? QStringList("samples") : QStringList();
  });
  EXPECT_EQ(question.losses({Leaving::Way::Quit}), QStringList({"a recording", "samples"}));
  EXPECT_EQ(question.losses({Leaving::Way::OtherProject}), QStringList("a recording"));
  EXPECT_TRUE(acceptsLosses({})) << "without a question";
}

TEST(Workbench, KnowsWhetherTheFileHoldsAllThatWasSet) {
  Workbench workbench(exampleProject());
  EXPECT_FALSE(workbench.modified());
  press(workbench, -1);
  EXPECT_TRUE(workbench.modified());
  workbench.saved("mine.json");
  EXPECT_EQ(workbench.file(), "mine.json");
  EXPECT_FALSE(workbench.modified());
  workbench.history().undo();
  EXPECT_TRUE(workbench.modified()) << "the file holds the force";
  workbench.history().redo();
  EXPECT_FALSE(workbench.modified());
}

TEST(Workbench, WhatLivePlaysIsNothingToBeSavedButItsSettingsAre) {
  Workbench workbench(exampleProject());
  Project next = workbench.project();
  next.live.source = LiveSourceKind::Recording;
  next.live.recording = "touch.palprec";
  next.live.simulation.held = true;
  workbench.edit("recording", next);
  EXPECT_EQ(workbench.modification(), Workbench::Modified::Nothing);
  next.live.alarmOn = !next.live.alarmOn;
  workbench.edit("alarm", next);
  EXPECT_EQ(workbench.modification(), Workbench::Modified::LiveSettings);
  press(workbench, -1);
  EXPECT_EQ(workbench.modification(), Workbench::Modified::Project);
}

TEST(Workbench, LeadsBackToTheSceneWhereTheEditWasMade) {
  Workbench workbench(exampleProject());
  QStringList scenes;
  QObject::connect(&workbench, &Workbench::wentBack,
                   [&](const QString& scene, const QString&, const Project&) { scenes << scene; });
  workbench.setPlace("deformation");
  press(workbench, -1);
  workbench.setPlace("reports");
  workbench.history().undo();
  workbench.setPlace("live");
  workbench.history().redo();
  EXPECT_EQ(scenes, QStringList({"deformation", "deformation"}));
}

/// The block's size along x.
void widen(Workbench& workbench, double size_mm) {
  Project next = workbench.project();
  next.design.block_mm.x() = size_mm;
  workbench.closeEntry();
  workbench.edit("wider", next);
}

TEST(EarlierDesigns, AreThoseOfTheHistoryTheLatestFirstAndEachOnce) {
  Workbench workbench(exampleProject());
  EXPECT_TRUE(workbench.earlierDesigns().empty());
  widen(workbench, 32);
  press(workbench, -1); // no other design
  widen(workbench, 34);
  widen(workbench, 32);
  widen(workbench, 36);
  const std::vector<EarlierDesign> earlier = workbench.earlierDesigns();
  ASSERT_EQ(earlier.size(), 3u);
  EXPECT_EQ(earlier[0].design.block_mm.x(), 32);
  EXPECT_EQ(earlier[0].change, "block size along x 32 -> 36 mm");
  EXPECT_EQ(earlier[1].design.block_mm.x(), 34);
  EXPECT_EQ(earlier[2].design.block_mm.x(), 30);
  for (const EarlierDesign& each : earlier) {
    EXPECT_TRUE(each.when.isValid());
    EXPECT_FALSE(each.undone);
  }
}

TEST(EarlierDesigns, KnowWhatWasUndoneAndNothingOfAnotherProject) {
  Workbench workbench(exampleProject());
  widen(workbench, 32);
  workbench.history().undo();
  ASSERT_EQ(workbench.earlierDesigns().size(), 1u);
  EXPECT_TRUE(workbench.earlierDesigns()[0].undone);
  EXPECT_EQ(workbench.earlierDesigns()[0].design.block_mm.x(), 32);
  workbench.history().redo();
  Project other = exampleProject();
  other.design.block_mm.z() = 9;
  workbench.replace(other);
  EXPECT_TRUE(workbench.earlierDesigns().empty());
}

} // namespace
} // namespace palp
