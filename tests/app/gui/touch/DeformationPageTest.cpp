#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTabBar>
#include <QTabWidget>
#include <QTableView>
#include <QTemporaryDir>

namespace palp {
namespace {

class DeformationPageTest : public WindowFixture {};

TEST_F(DeformationPageTest, TurnsZoomsAndResetsTheBlockByTheMouse) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  const auto start = block.cameraPosition();
  drag(block, block.rect().center(), block.rect().center() + QPoint(80, 30));
  const auto turned = block.cameraPosition();
  EXPECT_NE(turned, start);
  wheel(block, 120);
  const auto zoomed = block.cameraPosition();
  EXPECT_NE(zoomed, turned);
  QTest::mouseDClick(&block, Qt::LeftButton, {}, block.rect().center());
  settle();
  const auto back = block.cameraPosition();
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], start[k], 1e-6);
}

TEST_F(DeformationPageTest, RendersOnceForManyChangesAndNotAtAllWhileHidden) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  auto& heatmap = find<HeatmapView>("heatmap");
  const int before = block.renderCount();
  const int heatmapBefore = heatmap.renderCount();
  for (int k = 0; k < 50; ++k) block.invalidate();
  settle();
  EXPECT_EQ(block.renderCount(), before + 1);
  EXPECT_EQ(heatmap.renderCount(), heatmapBefore) << "nothing of the heatmap changed";
  window.showScene("network");
  settle();
  const int hidden = block.renderCount();
  for (int k = 0; k < 5; ++k) {
    block.invalidate();
    settle();
  }
  EXPECT_EQ(block.renderCount(), hidden);
}

TEST_F(DeformationPageTest, SolvesAgainAndDrawsAnotherPictureWhenAForceIsTyped) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  const QImage before = block.image().copy();
  const double deep = workbench.touch().fields()->displacement_mm.colwise().norm().maxCoeff();
  auto& force = find<QDoubleSpinBox>("force_z");
  force.setFocus();
  force.selectAll();
  QTest::keyClicks(&force, "-2.5");
  QTest::keyClick(&force, Qt::Key_Return);
  EXPECT_EQ(workbench.project().load.areas[0].force_N.z(), -2.5);
  ASSERT_TRUE(solved());
  settle();
  EXPECT_LT(workbench.touch().fields()->displacement_mm.colwise().norm().maxCoeff(), deep);
  EXPECT_NE(block.image(), before);
  workbench.history().undo();
  EXPECT_EQ(workbench.project().load.areas[0].force_N.z(), -6);
  ASSERT_TRUE(solved());
  EXPECT_NEAR(workbench.touch().fields()->displacement_mm.colwise().norm().maxCoeff(), deep, 1e-12 * deep);
}

TEST_F(DeformationPageTest, ProbesThePointThatWasClicked) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  const Eigen::Vector3d place(10, 22.5, 5); // on the top face, away from the arrow
  QTest::mouseClick(&block, Qt::LeftButton, {}, block.placeOf(place).toPoint());
  const QString words = find<QLabel>("probe").text();
  EXPECT_TRUE(words.contains("Point (")) << words.toStdString();
  EXPECT_TRUE(words.contains(", 5) mm")) << words.toStdString();
  // It is a point of this project: another one, even on the same mesh, begins without it.
  workbench.replace(quickProject());
  EXPECT_FALSE(find<QLabel>("probe").text().contains("Point (")) << find<QLabel>("probe").text().toStdString();
}

TEST_F(DeformationPageTest, LoadsAnAreaByAClickOnItAndOnlyProbesWhenAskedTo) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  const Eigen::Vector2d centre = paperDesign().areaRectangle(5).low_mm + Eigen::Vector2d(5, 7);
  const QPoint place = block.placeOf({centre.x(), centre.y(), 5}).toPoint();
  QTest::mouseClick(&find<QAbstractButton>("clickProbe"), Qt::LeftButton);
  QTest::mouseClick(&block, Qt::LeftButton, {}, place);
  EXPECT_EQ(workbench.project().load.areas.size(), 1u);
  QTest::mouseClick(&find<QAbstractButton>("clickLoad"), Qt::LeftButton);
  QTest::mouseClick(&block, Qt::LeftButton, {}, place);
  ASSERT_EQ(workbench.project().load.areas.size(), 2u);
  EXPECT_EQ(workbench.project().load.areas[1].area, 5);
  ASSERT_TRUE(solved());
}

TEST_F(DeformationPageTest, SetsTheForceByDraggingItsArrow) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  const auto camera = block.cameraPosition();
  const Eigen::Vector3d before = workbench.project().load.areas[0].force_N;
  const auto grip = block.gripOf(0);
  ASSERT_TRUE(grip.has_value());
  drag(block, grip->toPoint(), grip->toPoint() + QPoint(60, 0));
  const Eigen::Vector3d aside = workbench.project().load.areas[0].force_N;
  EXPECT_EQ(block.cameraPosition(), camera) << "dragging an arrow does not turn the block";
  EXPECT_LT(aside.x(), before.x()) << "the free end of a push went to +x, so that it pushes to -x";
  EXPECT_EQ(find<QDoubleSpinBox>("force_x").value(), aside.x());
  ASSERT_TRUE(solved());
  EXPECT_EQ(workbench.touch().touch().load().areas[0].force_N, aside);
  EXPECT_TRUE(workbench.history().undoText().startsWith("area 1: (")) << workbench.history().undoText().toStdString();
  EXPECT_EQ(workbench.history().count(), 1) << "one entry for the whole drag";
  QTest::qWait(100);
  const auto moved = block.gripOf(0);
  ASSERT_TRUE(moved.has_value());
  drag(block, moved->toPoint(), moved->toPoint() + QPoint(0, 40), Qt::ShiftModifier);
  const Eigen::Vector3d shorter = workbench.project().load.areas[0].force_N;
  EXPECT_LT(shorter.norm(), aside.norm());
  EXPECT_GT(shorter.normalized().dot(aside.normalized()), 1 - 1e-4) << "rounded to 0.01 N";
}

TEST_F(DeformationPageTest, PlotsAlongALineOfTwoClicks) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  QTest::mouseClick(&find<QAbstractButton>("clickLine"), Qt::LeftButton);
  settle();
  const auto& curve = find<ChartView>("linePlot").chart().series;
  ASSERT_EQ(curve.size(), 1u) << "the line that the project begins with";
  QTest::mouseClick(&block, Qt::LeftButton, {}, block.placeOf({10, 2, 5}).toPoint());
  QTest::mouseClick(&block, Qt::LeftButton, {}, block.placeOf({20, 28, 5}).toPoint());
  settle();
  const ViewSettings& view = workbench.project().view;
  EXPECT_NEAR(view.lineFrom_mm[0], 10, 2) << "the nearest node of the coarse mesh";
  EXPECT_NEAR(view.lineTo_mm[1], 28, 2);
  const ChartSpec& chart = find<ChartView>("linePlot").chart();
  ASSERT_EQ(chart.series.size(), 1u) << chart.title;
  // Ends of the line are nodes: the plot begins and ends with their displacements.
  const Mesh& mesh = *workbench.touch().touch().mesh();
  const auto at = [&](const std::array<double, 3>& place) {
    Eigen::Index node = 0;
    (mesh.nodes_mm.colwise() - Eigen::Vector3d(place.data())).colwise().norm().minCoeff(&node);
    return workbench.touch().fields()->displacement_mm.col(node).norm();
  };
  EXPECT_NEAR(chart.series[0].y.front(), at(view.lineFrom_mm), 1e-3 * at(view.lineFrom_mm)) << "rounded to 0.001 mm";
  EXPECT_NEAR(chart.series[0].y.back(), at(view.lineTo_mm), 1e-3 * at(view.lineTo_mm));
}

TEST_F(DeformationPageTest, RefusesALineThatLeavesTheBlock) {
  ASSERT_TRUE(solved());
  find<QTabWidget>("deformationTabs").setCurrentIndex(3);
  auto& end = find<QLineEdit>("lineTo");
  end.setFocus();
  end.selectAll();
  QTest::keyClicks(&end, "99, 0, 0");
  QTest::keyClick(&end, Qt::Key_Return);
  settle();
  EXPECT_TRUE(find<ChartView>("linePlot").chart().series.empty());
  EXPECT_NE(find<ChartView>("linePlot").chart().title.find("leaves the block"), std::string::npos);
  end.selectAll();
  QTest::keyClicks(&end, "1,5, 2"); // and not x 1, y 5, z 2
  QTest::keyClick(&end, Qt::Key_Return);
  EXPECT_NE(find<ChartView>("linePlot").chart().title.find("three numbers"), std::string::npos);
}

TEST_F(DeformationPageTest, WritesTheLoadPathAsASeriesOfPictures) {
  ASSERT_TRUE(solved());
  ASSERT_TRUE(idle());
  const QTemporaryDir folder;
  window.animate(folder.path(), {.gif = false, .pictures = 4, .width_px = 300, .seconds = 1});
  const QString last = folder.filePath("load-003.png");
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(last); }, kPatience_ms));
  const QImage rest(folder.filePath("load-000.png"));
  EXPECT_EQ(rest.size(), QSize(300, filmHeight_px(300, find<BlockView>("block").size())));
  EXPECT_NE(QImage(last), rest);
  EXPECT_EQ(workbench.touch().stages().runs("solve"), 1) << "nothing is solved again";
}

TEST_F(DeformationPageTest, ALineThatWasNotChosenYetGoesThroughTheMiddleOfThePresentBlock) {
  Project next = workbench.project();
  next.design.block_mm = {40, 36, 8};
  workbench.edit("another block", next);
  ASSERT_TRUE(solved());
  find<QTabWidget>("deformationTabs").setCurrentIndex(3);
  settle();
  EXPECT_EQ(find<QLineEdit>("lineFrom").text(), "0, 18, 8");
  EXPECT_EQ(find<QLineEdit>("lineTo").text(), "40, 18, 8");
  EXPECT_EQ(find<ChartView>("linePlot").chart().series.size(), 1u) << find<ChartView>("linePlot").chart().title;
}

TEST_F(DeformationPageTest, TheColoursOfTheResistancesHoldOnTheWholeLoadPath) {
  ASSERT_TRUE(solved());
  settle();
  const ColorScale full = find<HeatmapView>("heatmap").heatmap().colors;
  workbench.touch().showPlace(30);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().place() == 30; }, kPatience_ms));
  settle();
  const HeatmapSpec& partly = find<HeatmapView>("heatmap").heatmap();
  EXPECT_EQ(partly.colors.low, full.low);
  EXPECT_EQ(partly.colors.high, full.high);
  EXPECT_LT(partly.values.cwiseAbs().maxCoeff(), 0.6 * full.high) << "the change itself grows with the load";
}

TEST_F(DeformationPageTest, AllOfTheBlockStaysInSightWhereAPanelOpensBesideIt) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  const double before = Eigen::Vector3d(block.cameraPosition().data()).norm();
  window.resize(window.width() - 250, window.height());
  settle();
  EXPECT_GT(Eigen::Vector3d(block.cameraPosition().data()).norm(), before) << "seen from farther away";
  QWheelEvent nearer({200, 200}, block.mapToGlobal(QPointF(200, 200)), {}, {0, 120}, Qt::NoButton, {},
                     Qt::NoScrollPhase, false);
  QApplication::sendEvent(&block, &nearer);
  settle();
  const auto chosen = block.cameraPosition();
  window.resize(window.width() + 100, window.height());
  settle();
  EXPECT_EQ(block.cameraPosition(), chosen) << "a look of the user's own stays";
}

TEST_F(DeformationPageTest, LightsTheElectrodesOfAClickedCell) {
  ASSERT_TRUE(solved());
  settle();
  auto& heatmap = find<HeatmapView>("heatmap");
  const QImage before = find<BlockView>("block").image().copy();
  const QPoint place(heatmap.width() / 2, heatmap.height() / 2);
  const auto cell = heatmap.cellAt(place);
  ASSERT_TRUE(cell.has_value());
  QTest::mouseClick(&heatmap, Qt::LeftButton, {}, place);
  EXPECT_EQ(heatmap.heatmap().selected, cell);
  settle();
  auto& block = find<BlockView>("block");
  EXPECT_NE(block.image(), before);
  const SensorDesign& design = workbench.project().design;
  const int electrode = (*cell)[1] * design.electrodesPerColumnWire() + 1;
  const QPointF ball = block.placeOf(design.lowerElectrodes_mm().col(electrode)); // it is held
  EXPECT_GT(workbench.touch().electrodes()->lower_mm.col(electrode).norm(), 0) << "the rubber around it moves";
  const auto words = QString("column-wire %1, electrode 1: of the selected resistance").arg((*cell)[1]);
  EXPECT_EQ(block.tipAt(ball), words) << "among balls that mark other things";
  EXPECT_EQ(block.tipAt(QPointF(2, 2)), QString());
  ViewSettings view = workbench.project().view;
  view.cut = CutPlane{1, 29.9};
  Project next = workbench.project();
  next.view = view;
  workbench.edit("cut", next);
  settle();
  static_cast<void>(block.image());
  EXPECT_NE(block.tipAt(ball), words) << "it is cut away";
}

TEST_F(DeformationPageTest, AClickedCellSaysItsResistancesAndIsTheChosenOneOfTheResistanceScene) {
  ASSERT_TRUE(solved());
  settle();
  auto& heatmap = find<HeatmapView>("heatmap");
  const QPoint place(heatmap.width() / 4, heatmap.height() / 2);
  const auto cell = heatmap.cellAt(place);
  ASSERT_TRUE(cell.has_value());
  ASSERT_NE(*cell, workbench.project().view.cell);
  QTest::mouseMove(&heatmap, place);
  QTest::mouseClick(&heatmap, Qt::LeftButton, {}, place);
  const auto resistances = workbench.resistances();
  ASSERT_TRUE(resistances.has_value());
  QTest::keyClick(&heatmap, Qt::Key_Space); // reads the cell, and takes its light away: it stays the chosen one
  const QString tip = heatmap.toolTip();
  const double rest = resistances->rest_ohm((*cell)[0], (*cell)[1]), now = resistances->now_ohm((*cell)[0], (*cell)[1]);
  EXPECT_TRUE(
      tip.contains(QString("R = %1 ohm at rest, %2 ohm under the load").arg(rest, 0, 'g', 6).arg(now, 0, 'g', 6)))
      << tip.toStdString();
  window.showScene("resistance");
  settle();
  EXPECT_EQ(find<HeatmapView>("resistanceHeatmap").heatmap().selected, cell);
}

TEST_F(DeformationPageTest, ScrubsThroughTheLoadIncrementsDownToRest) {
  ASSERT_TRUE(solved());
  ASSERT_TRUE(idle());
  const int last = workbench.touch().place();
  ASSERT_GT(last, 0);
  find<QSlider>("increments").setValue(0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().place() == 0; }, kPatience_ms));
  EXPECT_EQ(workbench.touch().loadFraction(), 0);
  EXPECT_EQ(workbench.touch().fields()->displacement_mm.cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(workbench.touch().stages().runs("solve"), 1) << "nothing is solved again";
  find<QSlider>("increments").setValue(last);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().place() == last; }, kPatience_ms));
}

TEST_F(DeformationPageTest, ShowsARowWireAndTheTableOfElectrodes) {
  ASSERT_TRUE(solved());
  auto& tabs = find<QTabWidget>("deformationTabs");
  tabs.setCurrentIndex(1);
  settle();
  EXPECT_EQ(find<ChartView>("rowWire").chart().series.front().x.size(), 10u);
  EXPECT_EQ(find<ChartView>("rowWireShape").chart().series.size(), 2u) << "before and under the load";
  tabs.setCurrentIndex(2);
  settle();
  const QAbstractItemModel& table = *find<QTableView>("electrodeTable").model();
  const auto cell = [&](int row, int column) { return table.index(row, column).data().toString(); };
  ASSERT_EQ(table.rowCount(), 100 + 90) << "both layers";
  EXPECT_EQ(cell(13, 0), "upper");
  EXPECT_EQ(cell(13, 1) + "," + cell(13, 2), "1,3");
  EXPECT_EQ(cell(100 + 25, 0), "lower, fixed");
  EXPECT_EQ(cell(100 + 25, 1) + "," + cell(100 + 25, 2), "8,1");
  const Eigen::Vector3d moved = workbench.touch().electrodes()->upper_mm.col(13);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(cell(13, 6 + axis), QString::number(moved(axis), 'g', 6));
    EXPECT_EQ(cell(100 + 25, 6 + axis), "0") << "what is held does not move";
  }
  Project next = workbench.project();
  next.design.lowerFollowsRubber = true;
  workbench.edit("lower electrodes", next);
  const auto follows = [&] { return cell(100 + 25, 0) == "lower" && cell(100 + 25, 8).toDouble() != 0; };
  EXPECT_TRUE(QTest::qWaitFor(follows, kPatience_ms)) << cell(100 + 25, 8).toStdString();
}

TEST_F(DeformationPageTest, ReactionAndDisplacementStandAgainstTheLoad) {
  ASSERT_TRUE(solved());
  auto& tabs = find<QTabWidget>("deformationTabs");
  for (int k = 0; k < tabs.count(); ++k)
    if (tabs.tabText(k) == "Along the load")
      QTest::mouseClick(tabs.tabBar(), Qt::LeftButton, {}, tabs.tabBar()->tabRect(k).center());
  settle();
  const Touch& touch = workbench.touch().touch();
  const Solution& solution = *touch.solution();
  const ChartSpec reaction = find<ChartView>("reactionCurve").chart();
  ASSERT_EQ(reaction.series.size(), 3);
  for (std::size_t d = 0; d < 3; ++d) {
    ASSERT_EQ(reaction.series[d].x.size(), solution.increments.size());
    EXPECT_EQ(reaction.series[d].y.front(), 0) << "at rest";
    // The solve sums internal forces, the curve the loads: they differ by the residual, 1e-8 of the load at most.
    EXPECT_NEAR(reaction.series[d].y.back(), solution.reaction_N(static_cast<Eigen::Index>(d)),
                1e-7 * touch.load().totalForce_N().norm());
  }
  const ChartSpec way = find<ChartView>("forceDisplacement").chart();
  ASSERT_EQ(way.series.size(), 1);
  EXPECT_NEAR(way.series[0].x.back(), workbench.touch().endFields()->displacement_mm.colwise().norm().maxCoeff(), 1e-9);
  EXPECT_NEAR(way.series[0].y.back(), touch.load().totalForce_N().norm(), 1e-12);
  EXPECT_TRUE(find<ChartView>("forceDisplacement").table().startsWith("series,displacement [mm],force [N]"));
  Project next = workbench.project();
  Indenter ball;
  ball.place_mm = {15, 15};
  ball.control = Press{{0, 0, -1}};
  next.load = {{}, {}, {ball}};
  next.mesh.mapped = {15, 15, 3};
  workbench.edit("an indenter", next);
  ASSERT_TRUE(solved());
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto& series = find<ChartView>("forceDisplacement").chart().series;
        return series.size() == 1 && series[0].name.starts_with("indenter");
      },
      kPatience_ms));
  const ChartSeries depth = find<ChartView>("forceDisplacement").chart().series[0];
  EXPECT_NEAR(depth.y.back(), 1, 1e-3);
  EXPECT_GT(depth.x.back(), 0);
}

TEST_F(DeformationPageTest, HowThingsAreShownIsNoEntryOfTheHistory) {
  ASSERT_TRUE(solved());
  find<QComboBox>("quantity").setCurrentIndex(4);
  EXPECT_EQ(workbench.project().view.quantity, Quantity::Pressure);
  EXPECT_FALSE(workbench.history().canUndo());
  EXPECT_TRUE(workbench.touch().upToDate()) << "a view computes nothing";
}

} // namespace
} // namespace palp
