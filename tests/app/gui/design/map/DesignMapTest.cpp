#include "app/gui/design/map/MapWork.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/HeatmapView.h"
#include "app/study/Median.h"
#include "app/study/reports/map/MapQuantities.h"
#include "model/TouchRange.h"
#include "tests/app/gui/WindowFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QTabBar>
#include <QTabWidget>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// The map of the resolution on the Design scene, of a few places.
class DesignMapTest : public WindowFixture {
protected:
  DesignMapTest() {
    Project few = workbench.project();
    few.studies.map.places = 7;
    few.mesh.mapped = {9, 8, 2};
    workbench.edit("few places", few);
    window.showScene("design");
    auto& tabs = find<QTabWidget>("designTabs");
    const int last = tabs.count() - 1;
    QTest::mouseClick(tabs.tabBar(), Qt::LeftButton, {}, tabs.tabBar()->tabRect(last).center());
    EXPECT_EQ(tabs.currentIndex(), last);
    settle();
  }
  bool map() {
    QTest::mouseClick(&find<QPushButton>("mapResolution"), Qt::LeftButton);
    return QTest::qWaitFor([&] { return !window.busy(); }, kPatience_ms);
  }
  QString words(const char* name) { return find<QLabel>(name).text(); }
  const HeatmapSpec& heatmap() { return find<HeatmapView>("resolutionMap").heatmap(); }
  QImage block() {
    settle();
    return find<BlockView>("designBlock").image().copy();
  }
};

TEST_F(DesignMapTest, ShowsTheBoundsOfTheReportsMapOverTheFaceAndTheBlock) {
  const QImage bare = block();
  ASSERT_TRUE(map());
  ASSERT_TRUE(workbench.project().studies.mapped) << words("mapWords").toStdString();
  // The same by the engine of palp report map.
  const SensorDesign& design = workbench.project().design;
  const TouchRange usual = touchesOf(design);
  const HyperelasticProblem problem(design, sensorMesh(design, workbench.project().mesh));
  const auto surfaces = InfluenceSurfaces::find(problem, readingsAtRest(design, 0), 0);
  TouchMapRequest request;
  request.touch.radius_mm = 4.5;
  request.touch.control = Press{{0, 0, -(usual.leastPress_N + usual.mostPress_N) / 2}};
  request.low_mm = usual.low_mm;
  request.high_mm = usual.high_mm;
  request.places = workbench.project().studies.mapped->places;
  request.relativeNoise = workbench.project().view.resistanceNoise;
  const TouchMap wanted = touchMap(*surfaces, request, 0);
  EXPECT_GT(request.places[0], 3);
  EXPECT_LT((heatmap().values - wanted.heldPlace_mm.transpose()).norm(), 1e-5 * wanted.heldPlace_mm.norm())
      << "six digits are kept";
  EXPECT_TRUE(words("mapWords").contains(QString::number(wanted.heldPlace_mm.maxCoeff(), 'g', 3)))
      << words("mapWords").toStdString();
  const std::vector<double> all(wanted.heldPlace_mm.data(), wanted.heldPlace_mm.data() + wanted.heldPlace_mm.size());
  EXPECT_TRUE(words("mapWords").contains(QString::number(median(all), 'g', 3))) << words("mapWords").toStdString();

  const QImage mapped = block();
  EXPECT_NE(mapped, bare) << "it lies over the block";
  QTest::mouseClick(&find<QCheckBox>("mapOnBlock"), Qt::LeftButton, {},
                    {8, find<QCheckBox>("mapOnBlock").height() / 2});
  EXPECT_FALSE(workbench.project().view.mapOnBlock);
  EXPECT_EQ(block(), bare);

  choose("mapQuantity", 0);
  EXPECT_FALSE(window.busy()) << "all quantities are there";
  EXPECT_LT((heatmap().values - wanted.smallestForce_N.transpose()).norm(), 1e-5 * wanted.smallestForce_N.norm());
  EXPECT_EQ(heatmap().colors.unit, "N");
  auto& map = find<HeatmapView>("resolutionMap");
  settle();
  QTest::mouseMove(&map, map.rect().center() - QPoint(20, 0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !map.toolTip().isEmpty(); }, kPatience_ms));
  EXPECT_TRUE(map.toolTip().startsWith("y ")) << map.toolTip().toStdString();
  EXPECT_TRUE(map.toolTip().contains(" mm, x ")) << "places, not wires: " << map.toolTip().toStdString();
  const auto lines = map.table().count('\n');
  EXPECT_EQ(lines, 1 + wanted.heldPlace_mm.size()) << "a line a place, to be exported as other charts";
}

TEST_F(DesignMapTest, IsKeptWithTheProjectAndSaysWhenItIsStale) {
  find<QDoubleSpinBox>("mapRadius").setValue(3);
  choose("mapLaw", 3); // the field, virtual ground
  EXPECT_EQ(workbench.project().studies.map.law, "virtual_ground");
  ASSERT_TRUE(map());
  const auto& mapped = workbench.project().studies.mapped;
  ASSERT_TRUE(mapped) << words("mapWords").toStdString();
  ASSERT_NE(mapped->design.field(), nullptr);
  EXPECT_EQ(mapped->design.field()->readout, Readout::VirtualGround);
  EXPECT_EQ(workbench.project().design.field(), nullptr) << "the design keeps its law";
  EXPECT_EQ(mapped->touch.radius_mm, 3);
  EXPECT_TRUE(find<QLabel>("mapState").isHidden());
  const Project again = parseProject(projectText(workbench.project()), "project.json", {});
  EXPECT_EQ(again.studies, workbench.project().studies);

  find<QDoubleSpinBox>("mapForce").setValue(5);
  EXPECT_TRUE(words("mapState").contains("another touch")) << words("mapState").toStdString();
  choose("mapLaw", 1);
  EXPECT_TRUE(words("mapState").contains("law")) << words("mapState").toStdString();
  choose("mapLaw", 3);
  find<QDoubleSpinBox>("mapForce").setValue(-mapped->touch.press()->force_N.z());
  EXPECT_TRUE(find<QLabel>("mapState").isHidden());
  EXPECT_FALSE(workbench.modification() == Workbench::Modified::Nothing) << "it is to be saved";
}

TEST_F(DesignMapTest, ThatIsStoppedSaysSoAndOneThatCannotBeSaysWhy) {
  QTest::mouseClick(&find<QPushButton>("mapResolution"), Qt::LeftButton);
  ASSERT_TRUE(window.busy());
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  EXPECT_TRUE(words("mapWords").contains("Cancelled")) << words("mapWords").toStdString();
  EXPECT_TRUE(find<QPushButton>("mapResolution").isEnabled());
  EXPECT_FALSE(workbench.project().studies.mapped);
  Project kinked = workbench.project();
  kinked.design.pressureLaw = PressureLaw{};
  workbench.edit("a pressure law", kinked);
  ASSERT_TRUE(map());
  EXPECT_TRUE(words("mapWords").contains("kink")) << words("mapWords").toStdString();
  EXPECT_TRUE(find<QPushButton>("mapResolution").isEnabled());
}

} // namespace
} // namespace palp
