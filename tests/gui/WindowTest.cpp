#include "app/gui/BlockView.h"
#include "app/gui/ChartView.h"
#include "app/gui/HeatmapView.h"
#include "app/gui/MainWindow.h"
#include "app/gui/NetworkSession.h"
#include "app/gui/Workbench.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableWidget>
#include <QTest>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <iostream>
#include <random>

namespace palp {
namespace {

/// Generous: the machine may be busy with other tests.
constexpr int kPatience_ms = 60000;

/// A coarse mesh, so that the tests are about the window.
Project quickProject() {
  Project project = exampleProject();
  project.mesh.mapped = {9, 8, 2};
  project.samples.perArea = 6;
  project.network.sweepCount = 3;
  return project;
}

class Window : public testing::Test {
protected:
  Window() {
    window.resize(1300, 800);
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
  }
  bool idle() {
    return QTest::qWaitFor([&] { return !workbench.touch().runner().running() && !network.runner().running(); },
                           kPatience_ms);
  }
  bool solved() {
    return QTest::qWaitFor([&] { return workbench.touch().fields() != nullptr && workbench.touch().upToDate(); },
                           kPatience_ms);
  }
  template <class Widget> Widget& find(const char* name) {
    auto* widget = window.findChild<Widget*>(name);
    EXPECT_NE(widget, nullptr) << name;
    return *widget;
  }
  static void settle() { QTest::qWait(80); }

  Workbench workbench{quickProject()};
  NetworkSession network;
  MainWindow window{workbench, network};
};

void drag(QWidget& widget, QPoint from, QPoint to) {
  QTest::mousePress(&widget, Qt::LeftButton, {}, from);
  for (int k = 1; k <= 5; ++k) QTest::mouseMove(&widget, from + (to - from) * k / 5);
  QTest::mouseRelease(&widget, Qt::LeftButton, {}, to);
}

void wheel(QWidget& widget, int angle) {
  const QPointF place = widget.rect().center();
  QWheelEvent event(place, widget.mapToGlobal(place), {}, {0, angle}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&widget, &event);
}

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

TEST_F(Window, LoadsAnAreaByItsButtonAndTakesTheLoadAway) {
  ASSERT_TRUE(solved());
  QTest::mouseClick(&find<QPushButton>("area_4"), Qt::LeftButton);
  ASSERT_EQ(workbench.project().load.areas.size(), 2u);
  EXPECT_EQ(workbench.project().load.areas[1].area, 4);
  QTest::mouseClick(&find<QPushButton>("clearLoad"), Qt::LeftButton);
  ASSERT_EQ(workbench.project().load.areas.size(), 1u);
  EXPECT_EQ(workbench.project().load.areas[0].area, 1);
  EXPECT_TRUE(solved());
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
  const int last = workbench.touch().increment();
  ASSERT_GT(last, 0);
  find<QSlider>("increments").setValue(0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().increment() == 0; }, kPatience_ms));
  EXPECT_EQ(workbench.touch().loadFraction(), 0);
  EXPECT_EQ(workbench.touch().fields()->displacement_mm.cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(workbench.touch().stages().runs("solve"), 1) << "nothing is solved again";
  find<QSlider>("increments").setValue(last);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().increment() == last; }, kPatience_ms));
}

TEST_F(Window, ShowsARowWireAndTheTableOfElectrodes) {
  ASSERT_TRUE(solved());
  auto& tabs = find<QTabWidget>("deformationTabs");
  tabs.setCurrentIndex(1);
  settle();
  EXPECT_EQ(find<ChartView>("rowWire").chart().series.front().x.size(), 10u);
  tabs.setCurrentIndex(2);
  settle();
  EXPECT_EQ(find<QTableWidget>("electrodeTable").rowCount(), 100);
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

TEST_F(Window, StaysFreeWhileItSolvesAndSamples) {
  ASSERT_TRUE(solved());
  window.showScene("network");
  settle();
  QElapsedTimer clock;
  clock.start();
  qint64 last = 0;
  qint64 worst = 0;
  QTimer beat;
  QObject::connect(&beat, &QTimer::timeout, &beat, [&] {
    worst = std::max(worst, clock.elapsed() - last);
    last = clock.elapsed();
  });
  beat.start(5);
  Project project = workbench.project();
  project.samples.perArea = 20;
  workbench.edit("more", project);
  QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
  std::cout << "worst heartbeat gap: " << worst << " ms\n";
  // Far above the 50 ms that it is built for: other tests may share the cores.
  EXPECT_LT(worst, 1000);
}

TEST_F(Window, SurvivesRandomActions) {
  ASSERT_TRUE(solved());
  std::mt19937 random(20130911);
  const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto any = [&]<class Widget>(const QList<Widget*>& all) -> Widget* {
    QList<Widget*> usable;
    for (Widget* widget : all)
      if (widget->isVisible() && widget->isEnabled()) usable << widget;
    return usable.isEmpty() ? nullptr : usable[upTo(static_cast<int>(usable.size()))];
  };
  for (int action = 0; action < 300; ++action) {
    QWidget& scene = window.currentScene();
    switch (upTo(10)) {
    case 0:
      window.showScene(window.sceneNames()[upTo(static_cast<int>(window.sceneNames().size()))]);
      break;
    case 1:
      if (auto* spin = any(scene.findChildren<QDoubleSpinBox*>())) spin->stepBy(upTo(7) - 3);
      break;
    case 2:
      if (auto* slider = any(scene.findChildren<QSlider*>())) slider->setValue(upTo(slider->maximum() + 1));
      break;
    case 3:
      if (auto* box = any(scene.findChildren<QComboBox*>()))
        QTest::keyClick(box, upTo(2) == 0 ? Qt::Key_Down : Qt::Key_Up);
      break;
    case 4:
    case 5:
      if (auto* view = any(scene.findChildren<VtkView*>()))
        drag(*view, {upTo(view->width()), upTo(view->height())}, {upTo(view->width()), upTo(view->height())});
      break;
    case 6:
      if (auto* view = any(scene.findChildren<VtkView*>())) wheel(*view, 120 * (upTo(3) - 1));
      break;
    case 7:
      upTo(2) == 0 ? workbench.history().undo() : workbench.history().redo();
      break;
    case 8:
      window.setTheme(upTo(2) == 0 ? Theme::Light : Theme::Dark);
      break;
    case 9: {
      const QString name = upTo(2) == 0 ? QString("area_%1").arg(upTo(6)) : QString("clearLoad");
      auto* button = window.findChild<QPushButton*>(name);
      if (button != nullptr && button->isVisible()) QTest::mouseClick(button, Qt::LeftButton);
      break;
    }
    }
    if (upTo(8) == 0) QTest::keyClick(&window, Qt::Key_Escape);
    QApplication::processEvents();
  }
  workbench.replace(quickProject());
  window.showScene("deformation");
  workbench.touch().resume();
  EXPECT_TRUE(solved()) << "after all that it computes as at the start";
}

} // namespace
} // namespace palp
