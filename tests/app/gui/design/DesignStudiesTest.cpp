#include "app/gui/design/RestFloor.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// Better layouts, sweeps and comparisons on the Design scene.
class DesignStudies : public WindowFixture {
protected:
  DesignStudies() { window.showScene("design"); }
  void open(int tab) {
    find<QTabWidget>("designTabs").setCurrentIndex(tab);
    settle();
  }
  bool done() {
    return QTest::qWaitFor([&] { return !window.busy(); }, 4 * kPatience_ms);
  }
};

TEST_F(DesignStudies, FindABetterLayoutThatIsTakenOverByOneClickAndUndone) {
  open(1);
  auto& take = find<QPushButton>("takeLayout");
  EXPECT_FALSE(take.isEnabled());
  QTest::mouseClick(&find<QPushButton>("findLayout"), Qt::LeftButton);
  ASSERT_TRUE(done());
  EXPECT_EQ(workbench.project().design, paperDesign()) << "finding changes nothing";
  ASSERT_TRUE(take.isEnabled()) << find<QLabel>("layoutWords").text().toStdString();
  EXPECT_TRUE(find<QLabel>("layoutWords").text().contains("found"));
  QTest::mouseClick(&take, Qt::LeftButton);
  EXPECT_NE(workbench.project().design, paperDesign());
  EXPECT_TRUE(check(workbench.project().design).empty());
  EXPECT_FALSE(take.isEnabled());
  workbench.history().undo();
  EXPECT_EQ(workbench.project().design, paperDesign());
  EXPECT_TRUE(take.isEnabled()) << "the result holds for this design";
}

TEST_F(DesignStudies, ASearchThatIsStoppedSaysSoAndChangesNothing) {
  open(1);
  QTest::mouseClick(&find<QPushButton>("findLayout"), Qt::LeftButton);
  ASSERT_TRUE(window.busy());
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(done());
  EXPECT_TRUE(find<QLabel>("layoutWords").text().contains("Stopped"));
  EXPECT_FALSE(find<QPushButton>("takeLayout").isEnabled());
  EXPECT_TRUE(find<QPushButton>("findLayout").isEnabled());
}

TEST_F(DesignStudies, SweepANumberWithTheNoiseFloorAsResult) {
  open(2);
  auto& number = find<QComboBox>("sweepNumber");
  number.setCurrentIndex(number.findData("upper_layer.z_mm"));
  ASSERT_GE(number.currentIndex(), 0);
  find<QDoubleSpinBox>("sweepStart").setValue(3.5);
  find<QDoubleSpinBox>("sweepEnd").setValue(4.5);
  find<QSpinBox>("sweepSteps").setValue(3);
  QTest::mouseClick(&find<QPushButton>("sweepDesign"), Qt::LeftButton);
  ASSERT_TRUE(done());
  const ChartSpec& chart = find<ChartView>("sweepChart").chart();
  ASSERT_EQ(chart.series.size(), 6u) << find<QLabel>("sweepWords").text().toStdString();
  EXPECT_EQ(chart.series[0].x, (std::vector<double>{3.5, 4, 4.5}));
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t at = 0; at < 3; ++at)
      EXPECT_LT(chart.series[k].y[at], chart.series[k + 3].y[at]) << "all row-wires know more than one";
  const QTemporaryDir folder;
  answerFileDialog(folder.filePath("sweep.csv"));
  QTest::mouseClick(&find<QPushButton>("saveSweep"), Qt::LeftButton);
  QFile file(folder.filePath("sweep.csv"));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(file.readAll().count('\n'), 2 + 3) << "two lines of heads and one a value";
}

TEST_F(DesignStudies, SweepTheElectrodesRadiusUnderTheFieldByItsReadout) {
  Project field = workbench.project();
  field.design.resistance = FieldLaw{.readout = Readout::VirtualGround};
  workbench.edit("field", field);
  open(2);
  auto& number = find<QComboBox>("sweepNumber");
  EXPECT_LT(number.findData("resistance.rate_ohm_per_mm"), 0) << "the field has no rate";
  number.setCurrentIndex(number.findData("resistance.electrode_radius_mm"));
  ASSERT_GE(number.currentIndex(), 0);
  find<QDoubleSpinBox>("sweepStart").setValue(0.1);
  find<QDoubleSpinBox>("sweepEnd").setValue(0.3);
  find<QSpinBox>("sweepSteps").setValue(2);
  QTest::mouseClick(&find<QPushButton>("sweepDesign"), Qt::LeftButton);
  ASSERT_TRUE(done());
  const ChartSpec& chart = find<ChartView>("sweepChart").chart();
  ASSERT_EQ(chart.series.size(), 6u) << find<QLabel>("sweepWords").text().toStdString();
  for (std::size_t k = 0; k < 3; ++k) {
    StageLog stages;
    SensorDesign wide = field.design;
    std::get<FieldLaw>(wide.resistance).electrodeRadius_mm = chart.series[k].x[1];
    const auto block = AreaResponse::atRest(wide, field.mesh, 0, stages, {}, {});
    const FieldResponse response(wide, *wide.field(), *block, 0);
    EXPECT_DOUBLE_EQ(chart.series[k].y[1], response.bound(Readout::VirtualGround, -1, field.view.resistanceNoise)
                                               .withPrior()[static_cast<Eigen::Index>(k)]);
  }
  Project pairs = workbench.project();
  pairs.design.resistance = PairsLaw{};
  workbench.edit("pairs", pairs);
  EXPECT_GE(number.findData("resistance.rate_ohm_per_mm"), 0);
  EXPECT_LT(number.findData("resistance.electrode_radius_mm"), 0);
}

TEST_F(DesignStudies, CompareADesignWithItselfUnderTheFieldBothAtRest) {
  open(3);
  QTest::mouseClick(&find<QPushButton>("keepDesign"), Qt::LeftButton);
  Project field = workbench.project();
  field.design.resistance = FieldLaw{.readout = Readout::VirtualGround};
  workbench.edit("field", field);
  QTest::mouseClick(&find<QPushButton>("compareDesigns"), Qt::LeftButton);
  ASSERT_TRUE(done());
  const QString words = find<QLabel>("comparison").text();
  EXPECT_TRUE(words.startsWith("Both at rest.")) << words.toStdString();
  EXPECT_TRUE(words.contains("Cramer-Rao")) << words.toStdString();
  EXPECT_TRUE(words.contains("Not under the conduction field")) << words.toStdString();
  EXPECT_FALSE(find<HeatmapView>("comparisonMap").isVisible());
}

TEST_F(DesignStudies, CompareADesignWithTheOneThatWasKept) {
  open(3);
  auto& compare = find<QPushButton>("compareDesigns");
  EXPECT_FALSE(compare.isEnabled());
  QTest::mouseClick(&find<QPushButton>("keepDesign"), Qt::LeftButton);
  EXPECT_FALSE(compare.isEnabled()) << "with itself there is nothing to compare";
  Project softer = workbench.project();
  softer.design.material.c10_MPa *= 0.5;
  softer.design.material.c01_MPa *= 0.5;
  workbench.edit("softer", softer);
  ASSERT_TRUE(compare.isEnabled());
  QTest::mouseClick(&compare, Qt::LeftButton);
  ASSERT_TRUE(done());
  const QString words = find<QLabel>("comparison").text();
  EXPECT_TRUE(words.contains("Cramer-Rao")) << words.toStdString();
  EXPECT_TRUE(words.contains("Largest displacement")) << words.toStdString();
  const auto& map = find<HeatmapView>("comparisonMap");
  EXPECT_TRUE(map.isVisible());
  EXPECT_GT(map.heatmap().values.cwiseAbs().maxCoeff(), 0) << "softer rubber answers more";
  QTest::mouseClick(&find<QPushButton>("takeKept"), Qt::LeftButton);
  EXPECT_EQ(workbench.project().design, paperDesign());
}

} // namespace
} // namespace palp
