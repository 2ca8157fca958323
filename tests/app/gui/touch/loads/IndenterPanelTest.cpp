#include "app/gui/touch/loads/IndenterPanel.h"

#include "app/gui/project/Command.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/views/BlockView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// A window on hexahedra that a sphere of 8 mm touches with some dozen nodes, nothing pressed yet.
class IndenterPanelTest : public WindowFixture {
protected:
  IndenterPanelTest() {
    Project next = workbench.project();
    next.mesh.mapped = {15, 15, 3};
    next.load = {};
    workbench.edit("a coarse mesh", next);
  }
  [[nodiscard]] const LoadCase& load() const { return workbench.project().load; }
  [[nodiscard]] const Indenter& indenter(std::size_t k = 0) const { return load().indenters.at(k); }
  BlockView& block() { return find<BlockView>("block"); }
  bool drawn() {
    const bool there =
        solved() && QTest::qWaitFor([&] { return workbench.touch().touch().load() == load(); }, kPatience_ms);
    settle();
    static_cast<void>(block().image());
    return there;
  }
  QPoint top(double x_mm, double y_mm) { return block().placeOf({x_mm, y_mm, 5}).toPoint(); }
  QString words(const char* name) { return find<QLabel>(name).text(); }
};

TEST_F(IndenterPanelTest, PressesMovesSizesAndTakesAwayByTheMouse) {
  ASSERT_TRUE(drawn());
  QTest::keyClick(&window, Qt::Key_I);
  ASSERT_TRUE(QTest::qWaitFor([&] { return find<QAbstractButton>("clickIndenter").isChecked(); }, kPatience_ms));
  settle();
  QTest::mouseClick(&block(), Qt::LeftButton, {}, top(12, 16));
  ASSERT_EQ(load().indenters.size(), 1u);
  EXPECT_NEAR(indenter().place_mm.x(), 12, 0.6) << "a pixel or two";
  EXPECT_NEAR(indenter().place_mm.y(), 16, 0.6);
  ASSERT_TRUE(drawn());
  EXPECT_TRUE(words("result").contains("Indenter 0")) << words("result").toStdString();
  EXPECT_TRUE(words("result").contains("contact radius"));
  ASSERT_EQ(workbench.touch().indenters().size(), 1u);
  EXPECT_NEAR(workbench.touch().indenters()[0].force_N.z(), indenter().press()->force_N.z(), 1e-6);
  EXPECT_GT(workbench.touch().fields()->contactTraction_MPa.cols(), 0);

  const auto camera = block().cameraPosition();
  const Eigen::Vector2d from = indenter().place_mm;
  drag(block(), top(from.x(), from.y()), top(from.x() + 4, from.y() - 3));
  EXPECT_NEAR(indenter().place_mm.x(), from.x() + 4, 0.5);
  EXPECT_NEAR(indenter().place_mm.y(), from.y() - 3, 0.5);
  EXPECT_EQ(block().cameraPosition(), camera) << "dragging it does not turn the block";
  ASSERT_TRUE(drawn());
  const Indenter moved = indenter();
  drag(block(), top(moved.place_mm.x() + moved.radius_mm, moved.place_mm.y()),
       top(moved.place_mm.x() + moved.radius_mm + 2, moved.place_mm.y()));
  EXPECT_NEAR(indenter().radius_mm, moved.radius_mm + 2, 0.5);
  EXPECT_EQ(indenter().place_mm, moved.place_mm);
  ASSERT_TRUE(drawn());
  const Indenter sized = indenter();
  QTest::mouseClick(&block(), Qt::LeftButton, Qt::ShiftModifier, top(sized.place_mm.x(), sized.place_mm.y()));
  EXPECT_TRUE(load().indenters.empty());
  workbench.history().undo();
  ASSERT_EQ(load().indenters.size(), 1u) << "one entry of the history each";
  EXPECT_EQ(indenter(), sized);
}

TEST_F(IndenterPanelTest, KeepsItsNewSizeWhereItIsMovedBeforeThatIsSolved) {
  QTest::mouseClick(&find<QPushButton>("addIndenter"), Qt::LeftButton);
  QTest::keyClick(&window, Qt::Key_I);
  ASSERT_TRUE(QTest::qWaitFor([&] { return find<QAbstractButton>("clickIndenter").isChecked(); }, kPatience_ms));
  ASSERT_TRUE(drawn());
  const Indenter before = indenter();
  setNumber("indenterRadius", 8); // the picture still shows one of 5 mm
  drag(block(), top(before.place_mm.x(), before.place_mm.y()), top(before.place_mm.x() + 3, before.place_mm.y()));
  EXPECT_NEAR(indenter().place_mm.x(), before.place_mm.x() + 3, 0.5);
  EXPECT_EQ(indenter().radius_mm, 8);
}

TEST_F(IndenterPanelTest, IsSetByNumbersAndSaysWhatCannotBe) {
  QTest::mouseClick(&find<QPushButton>("addIndenter"), Qt::LeftButton);
  ASSERT_EQ(load().indenters.size(), 1u);
  EXPECT_EQ(indenter().place_mm, Eigen::Vector2d(15, 15));
  EXPECT_EQ(workbench.history().undoText(), "indenter 0: sphere 5 mm (0, 0, -1) N");
  setNumber("indenterRadius", 8);
  EXPECT_EQ(workbench.history().undoText(), "indenter 0: sphere 5 mm (0, 0, -1) N -> sphere 8 mm (0, 0, -1) N");
  setNumber("indenterX", 12);
  EXPECT_EQ(workbench.history().undoText(), "indenter 0: position (15, 15) -> (12, 15) mm");
  setNumber("force_x", 0.3);
  EXPECT_TRUE(words("loadProblem").contains("friction")) << words("loadProblem").toStdString();
  EXPECT_TRUE(find<QLabel>("loadProblem").isVisible());
  setNumber("indenterFriction", 0.5);
  EXPECT_FALSE(find<QLabel>("loadProblem").isVisible());
  EXPECT_EQ(indenter().friction, 0.5);
  setNumber("force_x", 0);

  choose("indenterShape", static_cast<int>(IndenterShape::Flat));
  EXPECT_EQ(indenter().shape, IndenterShape::Flat);
  EXPECT_GT(indenter().rim_mm, 0);
  EXPECT_TRUE(find<QDoubleSpinBox>("indenterRim").isVisible());
  choose("indenterShape", static_cast<int>(IndenterShape::Sphere));
  EXPECT_EQ(indenter().rim_mm, 0);
  EXPECT_FALSE(find<QDoubleSpinBox>("indenterRim").isVisible());

  choose("indenterControl", 1);
  ASSERT_NE(indenter().motion(), nullptr);
  setNumber("indenterDepth", 0.35);
  setNumber("indenterFriction", 0);
  EXPECT_EQ(indenter().motion()->depth_mm, 0.35);
  EXPECT_FALSE(find<QDoubleSpinBox>("force_z").isVisible()) << "the solve finds it";
  ASSERT_TRUE(drawn());
  EXPECT_NEAR(workbench.touch().indenters()[0].translation_mm.z(), -0.35, 1e-12);
  EXPECT_LT(workbench.touch().indenters()[0].force_N.z(), -0.1);
  EXPECT_TRUE(words("result").contains("-0.35)"));
  QTest::mouseClick(&find<QPushButton>("clearLoad"), Qt::LeftButton);
  EXPECT_TRUE(load().indenters.empty());
}

TEST_F(IndenterPanelTest, IsDrawnAndSaidHalfOfTheWay) {
  Project next = workbench.project();
  next.load.indenters = {{IndenterShape::Sphere, 8, 0, {15, 15}, 0, Motion{0.4, {0, 0}}}};
  workbench.edit("a sphere", next);
  ASSERT_TRUE(drawn());
  TouchSession& touch = workbench.touch();
  const double pressed_MPa = -touch.fields()->contactTraction_MPa.row(2).minCoeff();
  EXPECT_GT(pressed_MPa, 0.01);
  touch.showPlace(50);
  ASSERT_TRUE(QTest::qWaitFor([&] { return touch.place() == 50; }, kPatience_ms));
  ASSERT_EQ(touch.indenters().size(), 1u);
  EXPECT_NEAR(touch.indenters()[0].translation_mm.z(), -0.2, 0.01);
  const double half_MPa = -touch.fields()->contactTraction_MPa.row(2).minCoeff();
  EXPECT_GT(half_MPa, 0);
  EXPECT_LT(half_MPa, pressed_MPa);
  settle();
  EXPECT_FALSE(block().image().isNull());
}

TEST_F(IndenterPanelTest, IsSavedAndOpenedAndSaidAsACommand) {
  const QTemporaryDir folder;
  Project project = workbench.project();
  project.load.indenters = {{IndenterShape::Flat, 4, 0.3, {12, 13}, 0.4, Press{{0.5, 0, -2.5}}},
                            {IndenterShape::CylinderY, 6, 0, {20, 15}, 0.2, Motion{0.2, {0.1, 0}}},
                            {IndenterShape::Plane, 5, 0, {15, 15}, 0, Motion{0.1, {0, 0}}}};
  const auto file = std::filesystem::path(folder.filePath("touch.json").toStdString());
  saveProject(file, project);
  EXPECT_EQ(loadProject(file, exampleProject()).load, project.load);

  const QStringList options = solveCommands(project, "d.json").split(" --indenter ");
  ASSERT_EQ(options.size(), 7) << "of solve and of render";
  EXPECT_EQ(options[1], "flat:4,0.3@12,13:press=0.5,0,-2.5:mu=0.4");
  EXPECT_EQ(options[2], "cylinder-y:6@20,15:depth=0.2,0.1,0:mu=0.2");
  EXPECT_EQ(options[3].split(' ')[0], "plane@15,15:depth=0.1");
}

} // namespace
} // namespace palp
