#include "app/gui/design/DesignFields.h"
#include "app/gui/live/LiveBoards.h"
#include "app/gui/live/LiveTwin.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapView.h"
#include "app/study/Resources.h"
#include "tests/app/gui/WindowFixture.h"

#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QSlider>
#include <QSpinBox>
#include <QSplitter>
#include <QStatusBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QTimer>

namespace palp {
namespace {

class Window : public WindowFixture {};

TEST_F(Window, OpensOnTheDeformationSceneAndSolvesByItself) {
  EXPECT_EQ(window.currentScene().objectName(), "deformation");
  ASSERT_TRUE(solved());
  EXPECT_TRUE(workbench.touch().touch().solution()->converged);
  EXPECT_GT(find<BlockView>("block").warpFactor(), 1);
}

TEST_F(Window, LooksAtTheDesignWithoutAMeshAndAtTheMeshWithoutASolve) {
  Workbench fresh(quickProject());
  NetworkSession noNetwork;
  MainWindow other(fresh, noNetwork);
  other.showScene("design");
  other.show();
  settle();
  EXPECT_TRUE(fresh.touch().stages().counts().empty());
  const int solves = 0;
  Project changed = fresh.project();
  changed.design.block_mm.z() = 6;
  fresh.edit("height", changed);
  settle();
  EXPECT_FALSE(fresh.touch().runner().running());
  EXPECT_EQ(fresh.touch().stages().runs("solve"), solves);
  auto* showMesh = other.findChild<QAbstractButton*>("showMesh");
  showMesh->click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return fresh.touch().upToDate() && fresh.touch().touch().mesh() != nullptr; },
                              kPatience_ms));
  EXPECT_EQ(fresh.touch().touch().reached(), Stage::Mesh);
  EXPECT_EQ(fresh.touch().stages().runs("solve"), solves);
}

TEST_F(Window, GoesThroughAllScenesAndSolvesOnce) {
  ASSERT_TRUE(solved());
  for (int round = 0; round < 2; ++round)
    for (const QString& name : window.sceneNames()) {
      window.showScene(name);
      settle();
      ASSERT_TRUE(idle());
    }
  EXPECT_EQ(workbench.touch().stages().runs("mesh"), 1);
  EXPECT_EQ(workbench.touch().stages().runs("solve"), 1);
}

TEST_F(Window, TurnsZoomsAndResetsTheBlockByTheMouse) {
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

TEST_F(Window, RendersOnceForManyChangesAndNotAtAllWhileHidden) {
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

TEST(DesignFields, WriteEvenlySpacedPlacesInShortAndReadThemBackExactly) {
  const auto field = std::find_if(designFields().begin(), designFields().end(),
                                  [](const DesignField& each) { return each.key == "lower_layer.column_wire_x_mm"; });
  ASSERT_NE(field, designFields().end());
  SensorDesign design = paperDesign();
  EXPECT_EQ(field->text(design), "0.5, 1.5, ..., 29.5");
  SensorDesign again = design;
  again.lower.wire_mm = {1};
  EXPECT_EQ(field->set(again, field->text(design)), QString());
  EXPECT_EQ(again.lower.wire_mm, design.lower.wire_mm);
  design.lower.wire_mm[7] += 0.25;
  EXPECT_EQ(field->text(design).count(','), 29) << "what is not evenly spaced is written out";
  EXPECT_EQ(field->set(again, "1, 2, ..., 5, 7"), QString());
  EXPECT_EQ(again.lower.wire_mm, (std::vector<double>{1, 2, 3, 4, 5, 7}));
  for (const char* wrong : {"...", "1, ..., 5", "1, 2, ...", "1, 2, ..., 4.5", "1, 2, ..., 2", "1, 1, ..., 5",
                            "0, 1e-9, ..., 30", "5, 4, ..., 9", "1, 2, ..., x", "1, 2, ..., nan"})
    EXPECT_NE(field->set(again, wrong), QString()) << wrong;
}

TEST_F(Window, SolvesAgainAndDrawsAnotherPictureWhenAForceIsTyped) {
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

TEST_F(Window, ProbesThePointThatWasClicked) {
  ASSERT_TRUE(solved());
  settle();
  auto& block = find<BlockView>("block");
  const Eigen::Vector3d place(10, 22.5, 5); // on the top face, away from the arrow
  QTest::mouseClick(&block, Qt::LeftButton, {}, block.placeOf(place).toPoint());
  const QString words = find<QLabel>("probe").text();
  EXPECT_TRUE(words.contains("Point (")) << words.toStdString();
  EXPECT_TRUE(words.contains(", 5) mm")) << words.toStdString();
  // It is a point of this project: another one, even on the same mesh, begins without it.
  workbench.replace("another", quickProject());
  EXPECT_FALSE(find<QLabel>("probe").text().contains("Point (")) << find<QLabel>("probe").text().toStdString();
}

TEST_F(Window, LoadsAnAreaByAClickOnItAndOnlyProbesWhenAskedTo) {
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

TEST_F(Window, SetsTheForceByDraggingItsArrow) {
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

TEST_F(Window, PlotsAlongALineOfTwoClicks) {
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

TEST_F(Window, RefusesALineThatLeavesTheBlock) {
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
}

TEST_F(Window, WritesTheLoadPathAsASeriesOfPictures) {
  ASSERT_TRUE(solved());
  ASSERT_TRUE(idle());
  const QTemporaryDir folder;
  window.animate(folder.path());
  const QString last = folder.filePath("load-024.png");
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(last); }, kPatience_ms));
  const QImage rest(folder.filePath("load-000.png"));
  EXPECT_EQ(rest.size(), QSize(1200, 800));
  EXPECT_NE(QImage(last), rest);
  EXPECT_EQ(workbench.touch().stages().runs("solve"), 1) << "nothing is solved again";
}

TEST_F(Window, LightsTheElectrodesOfAClickedCell) {
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
  EXPECT_NE(find<BlockView>("block").image(), before);
}

TEST_F(Window, ScrubsThroughTheLoadIncrementsDownToRest) {
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

TEST_F(Window, ShowsARowWireAndTheTableOfElectrodes) {
  ASSERT_TRUE(solved());
  auto& tabs = find<QTabWidget>("deformationTabs");
  tabs.setCurrentIndex(1);
  settle();
  EXPECT_EQ(find<ChartView>("rowWire").chart().series.front().x.size(), 10u);
  EXPECT_EQ(find<ChartView>("rowWireShape").chart().series.size(), 2u) << "before and under the load";
  tabs.setCurrentIndex(2);
  settle();
  EXPECT_EQ(find<QTableWidget>("electrodeTable").rowCount(), 100);
}

TEST_F(Window, SolvesWhatWasEditedOnAnotherSceneWhileASolveRan) {
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

TEST_F(Window, ComputesWhatIsNeededAgainWhereOnlyAnEstimateRuns) {
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

TEST_F(Window, ShowsAProjectsOwnNumbersAndKeepsThemWhenOthersAreEdited) {
  window.showScene("design");
  Project project = workbench.project();
  project.mesh = {0.333, {}}; // finer than the box offers, and with more digits
  project.view.resistanceNoise = 5e-7;
  project.network.noise = 2.5e-8;
  project.network.spread = 0.0012345;
  project.network.automaticSpread = false;
  workbench.replace("another", project);
  EXPECT_EQ(find<QDoubleSpinBox>("meshSize").value(), 0.333);
  EXPECT_NEAR(find<QDoubleSpinBox>("resistanceNoise").value(), 5e-5, 1e-18);
  EXPECT_EQ(find<QDoubleSpinBox>("spread").value(), 0.0012345);
  // The panel hands over all of its boxes: one that showed another number would change the project.
  window.showScene("network");
  find<QSpinBox>("centers").setValue(17);
  EXPECT_EQ(workbench.project().network.centers, 17);
  EXPECT_NEAR(workbench.project().network.noise, 2.5e-8, 1e-22) << "a factor of 100 there and back";
  EXPECT_EQ(workbench.project().network.spread, 0.0012345);
  EXPECT_EQ(workbench.project().mesh.meshSize_mm, 0.333);
}

TEST_F(Window, MeasuresTheMeshAndTheNoiseFloorOffTheWindowsThreadAndOnlyWhileSeen) {
  ASSERT_TRUE(solved());
  network.setDesign(workbench.project().design);
  network.generate(workbench.project().samples, workbench.project().mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
  auto& words = find<QLabel>("meshWords");
  auto& floor = find<QLabel>("noiseFloor");
  Project next = workbench.project();
  next.view.mesh = true;
  workbench.edit("mesh", next); // not seen: nothing is measured
  EXPECT_FALSE(window.busy());
  EXPECT_FALSE(words.text().contains("dihedral")) << words.text().toStdString();
  EXPECT_FALSE(floor.text().contains("Cramer-Rao"));
  window.showScene("design");
  EXPECT_FALSE(floor.text().contains("Cramer-Rao")) << "computed while the window waited";
  ASSERT_TRUE(QTest::qWaitFor([&] { return words.text().contains("dihedral") && floor.text().contains("Cramer-Rao"); },
                              kPatience_ms));
  find<QDoubleSpinBox>("resistanceNoise").setValue(1);
  EXPECT_FALSE(floor.text().contains("Cramer-Rao")) << "the bound of another noise stays";
  EXPECT_TRUE(QTest::qWaitFor([&] { return floor.text().contains("Cramer-Rao"); }, kPatience_ms));
}

TEST_F(Window, ShowsAndCancelsTheWorkOfTheLiveScene) {
  ASSERT_TRUE(solved());
  Project heavy = workbench.project();
  heavy.mesh = {1.2, {}}; // solved for so long that the strip is seen
  workbench.edit("finer", heavy);
  window.showScene("live");
  workbench.touch().cancel();
  auto& page = static_cast<LiveBoards&>(window.currentScene()).page();
  auto& twin = find<LiveTwin>("liveTwin");
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return page.complete() && page.host().history().lastValid() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.busy(); }, kPatience_ms));
  twin.solve(heavy.design, heavy.load, heavy.mesh, {});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        const auto strips = window.statusBar()->findChildren<QPushButton*>("cancel");
        return std::any_of(strips.begin(), strips.end(), [](const QPushButton* cancel) { return cancel->isVisible(); });
      },
      kPatience_ms));
  EXPECT_TRUE(window.busy());
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.busy(); }, kPatience_ms));
  EXPECT_EQ(twin.touch(), nullptr);
  EXPECT_TRUE(find<QLabel>("twinWords").text().contains("on demand"));
}

TEST_F(Window, KeepsTheLastGoodResultAfterACancel) {
  ASSERT_TRUE(solved());
  const Solution* good = workbench.touch().touch().solution();
  Project heavy = workbench.project();
  heavy.mesh = {1.2, {}};
  workbench.edit("finer", heavy);
  QTest::qWait(100);
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  EXPECT_EQ(workbench.touch().touch().solution(), good);
  EXPECT_FALSE(workbench.touch().upToDate());
}

TEST_F(Window, HowThingsAreShownIsNoEntryOfTheHistory) {
  ASSERT_TRUE(solved());
  find<QComboBox>("quantity").setCurrentIndex(4);
  EXPECT_EQ(workbench.project().view.quantity, Quantity::Pressure);
  EXPECT_FALSE(workbench.history().canUndo());
  EXPECT_TRUE(workbench.touch().upToDate()) << "a view computes nothing";
}

TEST_F(Window, GivesTheKeysToTheSceneThatIsChosen) {
  find<QDoubleSpinBox>("force_z").setFocus();
  QTest::keyClick(&window, Qt::Key_5, Qt::ControlModifier);
  ASSERT_EQ(window.currentScene().objectName(), "live");
  auto& page = static_cast<LiveBoards&>(window.currentScene()).page();
  EXPECT_EQ(QApplication::focusWidget(), &page) << "and to none of its fields";
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Space);
  EXPECT_TRUE(page.host().paused());
}

TEST_F(Window, KeepsWhatItSaidInALog) {
  window.showMessage("First.");
  window.showMessage("Second.");
  const QString lines = find<QPlainTextEdit>("messageLines").toPlainText();
  EXPECT_TRUE(lines.contains("First.")) << lines.toStdString();
  EXPECT_LT(lines.indexOf("First."), lines.indexOf("Second."));
}

TEST_F(Window, TakesAPreset) {
  window.showScene("design");
  auto& presets = find<QComboBox>("presets");
  emit presets.activated(2);
  EXPECT_EQ(workbench.project().design.material.poissonRatio, 0.5);
  workbench.history().undo();
  EXPECT_EQ(workbench.project().design, paperDesign());
}

TEST_F(Window, SaysEveryScenesCommand) {
  for (const QString& name : window.sceneNames()) {
    window.showScene(name);
    EXPECT_TRUE(window.currentScene().commands(workbench.project(), "s.json").startsWith("palp "))
        << name.toStdString();
  }
}

TEST_F(Window, HelpsWithEverySceneAndItsPicture) {
  QTest::keyClick(&window, Qt::Key_F1);
  auto* help = window.findChild<QDialog*>("help");
  ASSERT_NE(help, nullptr);
  const QString page = help->findChild<QTextBrowser*>()->toHtml();
  for (const QString& name : window.sceneNames()) {
    EXPECT_TRUE(page.contains("name=\"" + name + "\"")) << name.toStdString() << " has no chapter";
    EXPECT_TRUE(page.contains("screenshots/" + name + ".png")) << name.toStdString();
    EXPECT_FALSE(
        QImage(QString::fromStdString(resource(("screenshots/" + name + ".png").toStdString()).string())).isNull());
  }
}

/// Lets a file fall on the window; what asks something meanwhile is closed, and its words are returned.
QString drop(MainWindow& window, const QString& file) {
  QString said;
  QTimer closer;
  QObject::connect(&closer, &QTimer::timeout, &closer, [&said] {
    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
      said = box->text();
      box->close();
    }
  });
  closer.start(20);
  dropOn(window, file);
  return said;
}

TEST_F(Window, OpensADroppedProjectInItsScene) {
  ASSERT_TRUE(solved());
  const QTemporaryDir folder;
  Project project = quickProject();
  project.load.areas[0].force_N = {0, 0, -2};
  project.view.scene = "resistance";
  project.view.cell = {2, 7};
  const std::string file = folder.filePath("p.json").toStdString();
  saveProject(file, project);
  EXPECT_EQ(drop(window, QString::fromStdString(file)), "");
  EXPECT_EQ(workbench.project(), project);
  EXPECT_EQ(window.currentScene().objectName(), "resistance");
  ASSERT_TRUE(solved());
  settle();
  EXPECT_EQ(find<HeatmapView>("resistanceHeatmap").heatmap().selected, (std::array{2, 7}));
}

TEST_F(Window, RefusesABrokenFileWithASentenceAndGoesOnWithWhatItHad) {
  ASSERT_TRUE(solved());
  const Project before = workbench.project();
  const QTemporaryDir folder;
  const QString file = folder.filePath("p.json");
  saveProject(file.toStdString(), before);
  QFile text(file);
  ASSERT_TRUE(text.open(QIODevice::ReadWrite));
  ASSERT_TRUE(text.resize(text.size() / 3));
  text.close();
  const QString said = drop(window, file);
  EXPECT_TRUE(said.contains("no valid JSON: parse error at line")) << said.toStdString();
  EXPECT_TRUE(said.contains("stays as it is")) << said.toStdString();
  EXPECT_EQ(workbench.project(), before);
  EXPECT_TRUE(workbench.touch().upToDate());
}

TEST_F(Window, KeepsSplittersAndTabsForTheNextStart) {
  auto& splitter = find<QSplitter>("deformationSplitter");
  settle();
  splitter.setSizes({300, 420});
  find<QTabWidget>("deformationTabs").setCurrentIndex(2);
  const QList<int> sizes = splitter.sizes();
  window.close();
  Workbench again{quickProject()};
  NetworkSession none;
  MainWindow next{again, none};
  next.resize(1300, 800);
  next.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&next));
  EXPECT_EQ(next.findChild<QSplitter*>("deformationSplitter")->sizes(), sizes);
  EXPECT_EQ(next.findChild<QTabWidget*>("deformationTabs")->currentIndex(), 2);
}

TEST_F(Window, ExplainsAWrongValueInPlaceAndKeepsTheDesign) {
  window.showScene("design");
  auto& ratio = find<QLineEdit>("material.poisson_ratio");
  ratio.setFocus();
  ratio.selectAll();
  QTest::keyClicks(&ratio, "7");
  EXPECT_EQ(workbench.project().design, paperDesign());
  bool explained = false;
  for (const QLabel* label : window.currentScene().findChildren<QLabel*>())
    explained = explained || (label->isVisible() && label->text().contains("0 to 0.5"));
  EXPECT_TRUE(explained);
  ratio.selectAll();
  QTest::keyClicks(&ratio, "0.49");
  EXPECT_EQ(workbench.project().design.material.poissonRatio, 0.49);
}

TEST_F(Window, GeneratesTrainsAndSweepsFromTheNetworkScene) {
  window.showScene("network");
  EXPECT_FALSE(find<QPushButton>("train").isEnabled());
  QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
  EXPECT_EQ(network.samples()->training.size(), 36);
  EXPECT_NE(network.samples()->training.forces_N, network.samples()->test.forces_N);
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(idle());
  const NetworkFit* first = network.fit();
  find<QDoubleSpinBox>("spread").setValue(2.5); // the error follows
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != first; }, kPatience_ms));
  EXPECT_EQ(network.fit()->decoder.report.spread, 2.5);
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("sweep"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sweepPoints().size() == 3; }, kPatience_ms));
}

} // namespace
} // namespace palp
