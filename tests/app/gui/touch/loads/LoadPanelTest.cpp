#include "app/gui/touch/loads/LoadPanel.h"

#include "app/gui/views/BlockView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>

#include <gtest/gtest.h>

namespace palp {
namespace {

class LoadPanelTest : public WindowFixture {
protected:
  [[nodiscard]] const LoadCase& load() const { return workbench.project().load; }
  BlockView& block() { return find<BlockView>("block"); }
  /// The load as it was set is solved and drawn.
  bool drawn() {
    const bool there =
        solved() && QTest::qWaitFor([&] { return workbench.touch().touch().load() == load(); }, kPatience_ms);
    settle();
    static_cast<void>(block().image());
    return there;
  }
  /// Where a place of the top face lies in the view.
  QPoint top(double x_mm, double y_mm) { return block().placeOf({x_mm, y_mm, 5}).toPoint(); }
  /// By its key, which presses the button for a moment.
  void chooseTool(Qt::Key key, const char* button) {
    QTest::keyClick(&window, key);
    EXPECT_TRUE(QTest::qWaitFor([&] { return find<QAbstractButton>(button).isChecked(); }, kPatience_ms));
    settle();
  }
};

TEST_F(LoadPanelTest, MakesMovesSizesAndTakesAwayADiscByTheMouse) {
  ASSERT_TRUE(drawn());
  chooseTool(Qt::Key_D, "clickDisc");
  QTest::mouseClick(&block(), Qt::LeftButton, {}, top(6, 22)); // beside the arrow
  ASSERT_EQ(load().patches.size(), 1u);
  EXPECT_NEAR(load().patches[0].centre_mm.x(), 6, 0.6) << "a pixel or two, and the block is dented";
  EXPECT_NEAR(load().patches[0].centre_mm.y(), 22, 0.6);
  EXPECT_LT(load().patches[0].force_N.z(), 0);
  ASSERT_TRUE(drawn());
  const auto camera = block().cameraPosition();
  const PatchLoad made = load().patches[0];

  const QPoint middle = top(made.centre_mm.x(), made.centre_mm.y());
  drag(block(), middle, top(made.centre_mm.x() - 1, made.centre_mm.y() - 8));
  const PatchLoad moved = load().patches[0];
  EXPECT_NEAR(moved.centre_mm.y(), made.centre_mm.y() - 8, 0.5);
  EXPECT_EQ(moved.radius_mm, made.radius_mm);
  EXPECT_EQ(block().cameraPosition(), camera) << "dragging a disc does not turn the block";
  ASSERT_TRUE(drawn());

  const QPoint rim = top(moved.centre_mm.x() + moved.radius_mm, moved.centre_mm.y());
  drag(block(), rim, top(moved.centre_mm.x() + moved.radius_mm + 2, moved.centre_mm.y()));
  const PatchLoad sized = load().patches[0];
  EXPECT_EQ(sized.centre_mm, moved.centre_mm);
  EXPECT_NEAR(sized.radius_mm, moved.radius_mm + 2, 0.4);
  ASSERT_TRUE(drawn());

  QTest::mouseClick(&block(), Qt::LeftButton, Qt::ShiftModifier, top(sized.centre_mm.x(), sized.centre_mm.y()));
  EXPECT_TRUE(load().patches.empty());
  workbench.history().undo();
  ASSERT_EQ(load().patches.size(), 1u);
  EXPECT_EQ(load().patches[0], sized) << "one entry of the history each";
}

TEST_F(LoadPanelTest, SetsADiscByNumbersAndKeepsItOnTheFace) {
  ASSERT_TRUE(solved());
  QTest::mouseClick(&find<QPushButton>("addDisc"), Qt::LeftButton);
  ASSERT_EQ(load().patches.size(), 1u);
  EXPECT_EQ(load().patches[0].centre_mm, Eigen::Vector2d(15, 15));
  EXPECT_EQ(workbench.history().undoText(), "disc 0: load of (0, 0, -3) N at (15, 15) mm");
  setNumber("discRadius", 5);
  EXPECT_EQ(workbench.history().undoText(), "disc 0: radius 2.5 -> 5 mm");
  setNumber("force_z", -3);
  setNumber("force_x", 1);
  EXPECT_EQ(load().patches[0], (PatchLoad{{15, 15}, 5, {1, 0, -3}}));
  setNumber("discX", 29);
  EXPECT_EQ(load().patches[0].centre_mm.x(), 25) << "5 mm from the edge, and no further";
  EXPECT_EQ(find<QDoubleSpinBox>("discX").value(), 25);
  EXPECT_FALSE(whyInvalid(load(), workbench.project().design));
  ASSERT_TRUE(solved());
  EXPECT_EQ(find<QComboBox>("loads").count(), 2);
  EXPECT_TRUE(find<QLabel>("loadTitle").text().contains("disc 0"));
  QTest::mouseClick(&find<QPushButton>("clearLoad"), Qt::LeftButton);
  EXPECT_TRUE(load().patches.empty());
  EXPECT_EQ(workbench.history().undoText(), "disc 0: removed");
  EXPECT_EQ(load().areas.size(), 1u);
}

TEST_F(LoadPanelTest, AStrayClickOnTheBlockLoadsNothing) {
  ASSERT_TRUE(drawn());
  const LoadCase before = load();
  for (const double x : {4.0, 12.0, 25.0}) QTest::mouseClick(&block(), Qt::LeftButton, {}, top(x, 24));
  EXPECT_EQ(load(), before);
  EXPECT_FALSE(workbench.history().canUndo());
  chooseTool(Qt::Key_A, "clickLoad");
  QTest::mouseClick(&block(), Qt::LeftButton, {}, top(25, 24));
  EXPECT_EQ(load().areas.size(), before.areas.size() + 1) << "with the tool that presses";
}

TEST_F(LoadPanelTest, ChoosesAndLoadsAreasOnThePlanByTheMouseAndByKeys) {
  ASSERT_TRUE(solved());
  auto& plan = find<AreaPlan>("areaPlan");
  QTest::mouseClick(&plan, Qt::LeftButton, {}, plan.placeOf({LoadKind::Area, 4}));
  ASSERT_EQ(load().areas.size(), 2u);
  EXPECT_EQ(load().areas[1].area, 4);
  QTest::mouseClick(&plan, Qt::LeftButton, Qt::ShiftModifier, plan.placeOf({LoadKind::Area, 4}));
  ASSERT_EQ(load().areas.size(), 1u);
  plan.setFocus();
  QTest::keyClick(&plan, Qt::Key_Right); // from area 1
  QTest::keyClick(&plan, Qt::Key_Up);
  QTest::keyClick(&plan, Qt::Key_Space);
  ASSERT_EQ(load().areas.size(), 2u);
  EXPECT_EQ(load().areas[1].area, 5);
  QTest::keyClick(&plan, Qt::Key_Delete);
  EXPECT_EQ(load().areas.size(), 1u);
}

TEST_F(LoadPanelTest, SaysAllLoadsThatActWhereADiscIsAddedToAnArea) {
  ASSERT_EQ(load().areas.size(), 1u);
  auto& together = find<QLabel>("loadsTogether");
  EXPECT_TRUE(together.isHidden()) << "one load stands in the list";
  find<QPushButton>("addDisc").click();
  EXPECT_FALSE(together.isHidden());
  EXPECT_EQ(together.text(), QString("2 loads act together: area %1, disc 0").arg(load().areas[0].area));
  for (int k = 0; k < 6; ++k) find<QPushButton>("addDisc").click();
  EXPECT_TRUE(together.text().endsWith("disc 4, 2 more")) << together.text().toStdString();
  for (int k = 0; k < 7; ++k) find<QPushButton>("clearLoad").click();
  EXPECT_TRUE(together.isHidden());
}

TEST_F(LoadPanelTest, FiftyColumnsOfAreasStayInThePanel) {
  Project many = workbench.project();
  many.design.areas = {50, 12};
  workbench.edit("areas", many);
  settle();
  auto& force = find<QDoubleSpinBox>("force_z");
  QScrollArea* panel = nullptr;
  for (QWidget* up = &force; up != nullptr && panel == nullptr; up = up->parentWidget())
    panel = qobject_cast<QScrollArea*>(up);
  ASSERT_NE(panel, nullptr);
  EXPECT_LE(panel->widget()->width(), panel->viewport()->width()) << "what is wider cannot be reached";
  const QRect seen = panel->viewport()->rect();
  const QRect box(force.mapTo(panel->viewport(), QPoint()), force.size());
  EXPECT_GE(box.left(), seen.left());
  EXPECT_LE(box.right(), seen.right());
  auto& plan = find<AreaPlan>("areaPlan");
  QTest::mouseClick(&plan, Qt::LeftButton, {}, plan.placeOf({LoadKind::Area, 599}));
  EXPECT_EQ(load().areas.back().area, 599);
}

TEST(DiscHandle, MovesADiscInsideAndSizesItAtItsRim) {
  const Eigen::Vector3d block(30, 30, 5);
  const std::vector<PatchLoad> discs{{{10, 10}, 3, {0, 0, -1}}};
  DiscHandle handle;
  EXPECT_FALSE(handle.take(discs, {14, 10}, 0.5));
  ASSERT_TRUE(handle.take(discs, {10.5, 10}, 0.5));
  EXPECT_FALSE(handle.sizes());
  EXPECT_EQ(handle.draggedTo({10.5, 10}, block), discs[0]);
  EXPECT_EQ(handle.draggedTo({12.5, 11}, block).centre_mm, Eigen::Vector2d(12, 11));
  EXPECT_EQ(handle.draggedTo({99, 10}, block).centre_mm, Eigen::Vector2d(27, 10)) << "stays on the face";
  ASSERT_TRUE(handle.take(discs, {13.2, 10}, 0.5));
  EXPECT_TRUE(handle.sizes());
  EXPECT_NEAR(handle.draggedTo({15.2, 10}, block).radius_mm, 5, 1e-12);
  EXPECT_EQ(handle.draggedTo({29, 10}, block).radius_mm, 10) << "as far as the nearest edge";
  EXPECT_EQ(handle.draggedTo({29, 10}, block).centre_mm, discs[0].centre_mm);
  EXPECT_GE(handle.draggedTo({10, 10}, block).radius_mm, kSmallestDisc_mm);
}

} // namespace
} // namespace palp
