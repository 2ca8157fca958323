#include "app/gui/touch/loads/PathPanel.h"

#include "app/gui/project/Command.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/HeatmapView.h"
#include "app/study/touch/TouchPath.h"
#include "io/LoadFile.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(IndenterPath, StepsLieAtEqualDistancesAlongTheLineThatWasDrawn) {
  Eigen::Matrix2Xd corner(2, 3);
  corner << 10, 13, 13, 10, 10, 15; // 3 mm along x, then 5 along y
  const Motion from{0.4, {0.5, 0}};
  const auto steps = stepsAlong(corner, from, 4);
  ASSERT_EQ(steps.size(), 4u);
  const std::array<Eigen::Vector2d, 4> wanted{{{2.5, 0}, {3.5, 1}, {3.5, 3}, {3.5, 5}}}; // beyond the shift that it has
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(std::get<Motion>(steps[k]).depth_mm, 0.4);
    EXPECT_LT((std::get<Motion>(steps[k]).shift_mm - wanted[k]).norm(), 0.01) << k;
  }
  EXPECT_TRUE(stepsAlong(corner.leftCols(1), from, 4).empty());
}

/// A window on hexahedra under a sphere of 8 mm with friction, and its path in sight.
class PathPanelTest : public WindowFixture {
protected:
  PathPanelTest() {
    Project next = workbench.project();
    next.mesh.mapped = {15, 15, 3};
    Indenter ball;
    ball.radius_mm = 8;
    ball.place_mm = {12, 15};
    ball.friction = 0.4;
    ball.control = Press{{0, 0, -1.5}};
    next.load = {{}, {}, {ball}};
    workbench.edit("a coarse mesh", next);
    auto& tabs = find<QTabWidget>("deformationTabs");
    for (int k = 0; k < tabs.count(); ++k)
      if (tabs.tabText(k) == "Path")
        QTest::mouseClick(tabs.tabBar(), Qt::LeftButton, {}, tabs.tabBar()->tabRect(k).center());
    QTest::mouseClick(&find<QAbstractButton>("clickIndenter"), Qt::LeftButton);
  }
  const Project& project() { return workbench.project(); }
  bool drawn() {
    const bool there =
        solved() && QTest::qWaitFor(
                        [&] {
                          const Touch& touch = workbench.touch().touch();
                          return touch.load() == project().load &&
                                 touch.path() == loadsAfter(project().load, project().path, project().design);
                        },
                        kPatience_ms);
    settle();
    static_cast<void>(find<BlockView>("block").image());
    return there;
  }
  QPoint top(double x_mm, double y_mm) { return find<BlockView>("block").placeOf({x_mm, y_mm, 5}).toPoint(); }
  /// Along x, by 3 mm.
  void drawPath() { drag(find<BlockView>("block"), top(12, 15), top(15, 15), Qt::ControlModifier); }
  QString cell(int row, int column) {
    const QTableWidgetItem* its = find<QTableWidget>("pathSteps").item(row, column);
    return its != nullptr ? its->text() : QString();
  }
};

TEST_F(PathPanelTest, DrawnByTheMouseItIsSolvedPlayedAndUndone) {
  ASSERT_TRUE(drawn());
  EXPECT_EQ(workbench.touch().lastPlace(), 100);
  const double depth = -workbench.touch().indenters()[0].translation_mm.z();
  const auto camera = find<BlockView>("block").cameraPosition();
  drawPath();
  EXPECT_EQ(find<BlockView>("block").cameraPosition(), camera) << "drawing does not turn the block";
  ASSERT_TRUE(project().path);
  const std::size_t steps = project().path->steps.size();
  EXPECT_GE(steps, 4u);
  ASSERT_NE(project().load.indenters[0].motion(), nullptr) << "a path is a motion";
  EXPECT_NEAR(project().load.indenters[0].motion()->depth_mm, depth, 6e-4) << "as deep as the force has pressed it";
  EXPECT_NEAR(std::get<Motion>(project().path->steps.back()).shift_mm.x(), 3, 0.6);
  ASSERT_TRUE(drawn());
  const Solution& solution = *workbench.touch().touch().solution();
  EXPECT_TRUE(solution.converged) << solution.stopReason;
  EXPECT_EQ(workbench.touch().lastPlace(), static_cast<int>(100 * (1 + steps)));
  const IndenterState end = solution.state().indenters[0];
  EXPECT_NEAR(end.translation_mm.x(), std::get<Motion>(project().path->steps.back()).shift_mm.x(), 1e-9);
  EXPECT_GT(end.force_N.x(), 0.1) << "friction drags the rubber along";
  // The engine of palp solve --loads.
  StageLog stages;
  std::vector<LoadCase> loads = loadsAfter(project().load, project().path, project().design);
  loads.insert(loads.begin(), project().load);
  const TouchPath wanted = followPath(project().design, loads, project().mesh, {.oneTangent = true}, {}, stages);
  ASSERT_EQ(wanted.steps.size(), loads.size());
  EXPECT_EQ(end.force_N, wanted.steps.back().solution.state().indenters[0].force_N);
  EXPECT_EQ(*workbench.touch().touch().resistances_ohm(), wanted.steps.back().resistances_ohm);
  EXPECT_EQ(find<QTableWidget>("pathSteps").rowCount(), static_cast<int>(1 + steps));
  EXPECT_NEAR(cell(static_cast<int>(steps), 4).toDouble(), end.force_N.x(), 1e-3 * end.force_N.norm());
  EXPECT_FALSE(cell(static_cast<int>(steps), 8).isEmpty()) << "its slip";

  auto& slider = find<QSlider>("increments");
  EXPECT_EQ(slider.maximum(), workbench.touch().lastPlace());
  slider.setValue(250);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().place() == 250; }, kPatience_ms));
  EXPECT_TRUE(find<QLabel>("pathWords").text().contains("step 2 of the path"))
      << find<QLabel>("pathWords").text().toStdString();
  QTest::mouseClick(&find<QToolButton>("playPath"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().place() > 260; }, kPatience_ms));
  QTest::mouseClick(&find<QToolButton>("playPath"), Qt::LeftButton);

  workbench.history().undo();
  EXPECT_FALSE(project().path) << "one entry";
  EXPECT_NE(project().load.indenters[0].press(), nullptr);
}

TEST_F(PathPanelTest, IsSetByNumbersKeptInTheFileAndRefusedInWords) {
  QTest::mouseClick(&find<QPushButton>("addStep"), Qt::LeftButton);
  ASSERT_TRUE(project().path) << "of forces, as the load is";
  ASSERT_TRUE(drawn());
  auto& table = find<QTableWidget>("pathSteps");
  table.item(1, 1)->setText("0.5");
  EXPECT_EQ(std::get<Press>(project().path->steps[0]).force_N, Eigen::Vector3d(0.5, 0, -1.5));
  table.item(1, 3)->setText("2");
  EXPECT_EQ(std::get<Press>(project().path->steps[0]).force_N.z(), -1.5) << "a pull";
  EXPECT_TRUE(find<QLabel>("pathHint").text().startsWith("Not applied"))
      << find<QLabel>("pathHint").text().toStdString();
  table.item(1, 1)->setText("abc");
  EXPECT_EQ(std::get<Press>(project().path->steps[0]).force_N.x(), 0.5);
  EXPECT_EQ(parseProject(projectText(project()), "project.json", {}).path, project().path);
  EXPECT_TRUE(solveCommands(project(), "sensor.json").contains("--loads path.json"));
  const std::vector<LoadCase> read =
      parseLoadPath(loadFile(project().load, *project().path, project().design), "path.json");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].indenters, project().load.indenters);
  EXPECT_EQ(std::vector<LoadCase>(read.begin() + 1, read.end()),
            loadsAfter(project().load, project().path, project().design));
  QTest::mouseClick(&find<QPushButton>("clearPath"), Qt::LeftButton);
  EXPECT_FALSE(project().path);
  workbench.history().undo();
  ASSERT_TRUE(project().path);
  QTest::mouseClick(&find<QPushButton>("clearLoad"), Qt::LeftButton);
  EXPECT_FALSE(project().path) << "it goes with its indenter";
}

TEST_F(PathPanelTest, ATouchIsComparedWithItsForceUniform) {
  ASSERT_TRUE(drawn());
  QTest::mouseClick(&find<QPushButton>("compareUniform"), Qt::LeftButton);
  EXPECT_TRUE(project().view.lessReference && project().view.uniform);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.referencePath() != nullptr; }, kPatience_ms));
  const Touch& shown = workbench.touch().touch();
  const IndenterState& ball = shown.solution()->state().indenters[0];
  // The ball lies over the border of two areas: rounding of its motion decides.
  const Eigen::Vector2d place = project().load.indenters[0].place_mm + ball.translation_mm.head<2>();
  LoadCase uniform{{{areaUnder(project().design, place), ball.force_N}}, {}, {}};
  Touch alone(project().design, uniform, project().mesh);
  ASSERT_TRUE(alone.advance(Stage::Resistances));
  const NodalFields wanted = alone.problem()->fields(alone.solution()->state());
  const ReferencePath& path = *workbench.referencePath();
  EXPECT_EQ(path.load, uniform);
  EXPECT_LT((path.at(1).fields.displacement_mm - wanted.displacement_mm).norm(), 1e-6 * wanted.displacement_mm.norm());
  EXPECT_TRUE(find<QLabel>("difference").text().contains("Difference from uniform load"));
  window.showScene("resistance");
  auto& kind = find<QComboBox>("resistanceKind");
  kind.setCurrentIndex(static_cast<int>(ResistanceKind::LessReference));
  settle();
  const auto changes = [&](const Touch& touch) {
    const Eigen::MatrixXd rest = resistancesAtRest_ohm(touch.design());
    return (100 * (*touch.resistances_ohm() - rest).cwiseQuotient(rest)).eval();
  };
  const Eigen::MatrixXd difference = changes(shown) - changes(alone);
  const HeatmapSpec& map = find<HeatmapView>("resistanceHeatmap").heatmap();
  ASSERT_EQ(map.values.size(), difference.size()) << map.title;
  EXPECT_LT((map.values - difference).norm(), 1e-6 * difference.norm());
  EXPECT_NE(map.title.find("uniform"), std::string::npos);
  window.showScene("deformation");
  QTest::mouseClick(&find<QPushButton>("compareUniform"), Qt::LeftButton);
  EXPECT_FALSE(project().view.lessReference);
}

} // namespace
} // namespace palp
