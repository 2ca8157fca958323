#include "tests/app/gui/WindowFixture.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QSpinBox>
#include <QStatusBar>

namespace palp {
namespace {

class Undo : public WindowFixture {
protected:
  void type(QWidget& field, const QString& text) {
    field.setFocus();
    QTest::keyClick(&field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(&field, text);
  }
  static void undo(QWidget& where) { QTest::keyClick(&where, Qt::Key_Z, Qt::ControlModifier); }
  double fz_N() { return workbench.project().load.areas[0].force_N.z(); }
};

TEST_F(Undo, TakesTheLastEditBackWhileABoxHasTheFocus) {
  const double before_N = fz_N();
  auto& force = find<QDoubleSpinBox>("force_z");
  type(force, "-2.5");
  QTest::keyClick(&force, Qt::Key_Return);
  ASSERT_EQ(fz_N(), -2.5);
  undo(force);
  EXPECT_EQ(fz_N(), before_N);
  EXPECT_EQ(force.value(), before_N);
  QTest::keyClick(&force, Qt::Key_Y, Qt::ControlModifier);
  EXPECT_EQ(fz_N(), -2.5);
}

TEST_F(Undo, TakesTypingThatWasNotAppliedBackFirst) {
  auto& force = find<QDoubleSpinBox>("force_z");
  type(force, "-2.5");
  QTest::keyClick(&force, Qt::Key_Return);
  type(force, "-7");
  undo(force);
  EXPECT_EQ(fz_N(), -2.5) << "only the typing went";
  EXPECT_EQ(force.cleanText().toDouble(), -2.5);
}

TEST_F(Undo, TakesAnEditOfTheDesignBackWhileItsFieldHasTheFocus) {
  window.showScene("design");
  auto& width = find<QLineEdit>("block_mm[0]");
  type(width, "45.5");
  ASSERT_EQ(workbench.project().design.block_mm.x(), 45.5);
  EXPECT_EQ(workbench.history().undoText(), "block size along x 30 -> 45.5 mm") << "one entry for all its keys";
  undo(width);
  EXPECT_EQ(workbench.project().design, paperDesign());
  EXPECT_EQ(width.text(), "30");
  EXPECT_FALSE(workbench.history().canUndo());
}

TEST_F(Undo, TakesTextThatCannotBeAppliedBackAndNoEditBeforeIt) {
  window.showScene("design");
  auto& width = find<QLineEdit>("block_mm[0]");
  type(width, "45");
  type(width, "-3");
  ASSERT_EQ(workbench.project().design.block_mm.x(), 45);
  undo(width);
  EXPECT_EQ(workbench.project().design.block_mm.x(), 45);
  EXPECT_EQ(width.text(), "45");
  undo(width);
  EXPECT_EQ(workbench.project().design.block_mm.x(), 30);
}

TEST_F(Undo, AnotherFieldIsAnotherEntry) {
  window.showScene("design");
  type(find<QLineEdit>("block_mm[0]"), "40");
  type(find<QLineEdit>("block_mm[1]"), "41");
  type(find<QLineEdit>("block_mm[0]"), "42");
  EXPECT_EQ(workbench.history().count(), 3);
}

TEST_F(Undo, ShowsTheSceneOfWhatItUndoesAndSaysWhat) {
  auto& force = find<QDoubleSpinBox>("force_z");
  type(force, "-2.5");
  QTest::keyClick(&force, Qt::Key_Return);
  window.showScene("reports");
  undo(window);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.currentScene().objectName() == "deformation"; }, kPatience_ms));
  EXPECT_TRUE(window.statusBar()->currentMessage().startsWith("Undone: area 1: ("))
      << window.statusBar()->currentMessage().toStdString();
  EXPECT_TRUE(window.statusBar()->currentMessage().endsWith(", in the scene Deformation"))
      << window.statusBar()->currentMessage().toStdString();
}

TEST_F(Undo, StaysOnASceneThatShowsTheChangeAlsoAcrossOtherSteps) {
  window.showScene("design");
  type(find<QLineEdit>("block_mm[0]"), "40");
  window.showScene("deformation");
  auto& force = find<QDoubleSpinBox>("force_z");
  type(force, "-2.5");
  QTest::keyClick(&force, Qt::Key_Return);
  window.showScene("design");
  workbench.history().setIndex(0); // a click on the first line of the history
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.statusBar()->currentMessage().startsWith("Undone"); }, kPatience_ms));
  EXPECT_EQ(window.currentScene().objectName(), "design");
  window.showScene("resistance");
  workbench.history().setIndex(2);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.statusBar()->currentMessage().startsWith("Redone"); }, kPatience_ms));
  EXPECT_EQ(window.currentScene().objectName(), "resistance");
}

TEST_F(Undo, NamesASizeOfTheBlockWithItsValuesAlsoWhereTheWiresGoWithIt) {
  window.showScene("design");
  find<QCheckBox>("scaleWires").setChecked(true);
  type(find<QLineEdit>("block_mm[0]"), "40");
  EXPECT_EQ(workbench.history().undoText(), "block size along x 30 -> 40 mm, and the wires with it");
}

TEST_F(Undo, LeavesTheLiveSettingsAlone) {
  auto& force = find<QDoubleSpinBox>("force_z");
  type(force, "-2.5");
  QTest::keyClick(&force, Qt::Key_Return);
  Project next = workbench.project();
  next.live.simulation.openColumn = 7;
  workbench.edit("broken column-wire", next);
  undo(window);
  EXPECT_EQ(workbench.project().live.simulation.openColumn, 7);
  EXPECT_FALSE(workbench.history().canUndo());
}

} // namespace
} // namespace palp
