#include "app/gui/design/BoundWords.h"
#include "app/gui/design/RestFloor.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <algorithm>

#include <limits>

namespace palp {
namespace {

/// Better layouts, sweeps and comparisons on the Design scene.
class DesignStudies : public WindowFixture {
protected:
  DesignStudies() { window.showScene("design"); }
  void soften() {
    Project softer = workbench.project();
    softer.design.material.law = timesStress(softer.design.material.law, 0.5);
    workbench.edit("softer", softer);
  }
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
  EXPECT_TRUE(find<QLabel>("layoutWords").text().contains("Cancelled"));
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
  ASSERT_EQ(chart.series.size(), 6u)
      << find<QTabWidget>("designTabs").findChild<QLabel*>("sweepWords")->text().toStdString();
  EXPECT_EQ(chart.series[0].x, (std::vector<double>{3.5, 4, 4.5}));
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t at = 0; at < 3; ++at)
      EXPECT_LT(chart.series[k].y[at], chart.series[k + 3].y[at]) << "all row-wires know more than one";
  const QTemporaryDir folder;
  answerFileDialog(folder.filePath("sweep.csv"));
  QTest::mouseClick(&find<QPushButton>("saveSweep"), Qt::LeftButton);
  QFile file(folder.filePath("sweep.csv"));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const QList<QByteArray> lines = file.readAll().trimmed().split('\n');
  EXPECT_TRUE(lines.contains("# up to date when it was saved"));
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), [](const QByteArray& line) { return !line.startsWith('#'); }),
            1 + 3)
      << "the heads and one line a value";
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
  ASSERT_EQ(chart.series.size(), 6u)
      << find<QTabWidget>("designTabs").findChild<QLabel*>("sweepWords")->text().toStdString();
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
  EXPECT_TRUE(words.contains("Both at rest.")) << words.toStdString();
  EXPECT_TRUE(words.contains("Cramer-Rao")) << words.toStdString();
  // The changes of each by its own law.
  const auto changes = [&](const SensorDesign& design) {
    Touch touch(design, field.load, field.mesh);
    EXPECT_TRUE(touch.advance(Stage::Resistances));
    const Eigen::MatrixXd rest = resistancesAtRest_ohm(design);
    return (100 * (*touch.resistances_ohm() - rest).cwiseQuotient(rest)).eval();
  };
  const auto& map = find<HeatmapView>("comparisonMap");
  ASSERT_TRUE(map.isVisible());
  const Eigen::MatrixXd wanted = changes(field.design) - changes(*field.kept);
  EXPECT_LT((map.heatmap().values - wanted).norm(), 1e-9 * wanted.norm());
}

TEST_F(DesignStudies, CompareADesignWithTheOneThatWasKept) {
  open(3);
  auto& compare = find<QPushButton>("compareDesigns");
  EXPECT_FALSE(compare.isEnabled());
  QTest::mouseClick(&find<QPushButton>("keepDesign"), Qt::LeftButton);
  EXPECT_FALSE(compare.isEnabled()) << "with itself there is nothing to compare";
  soften();
  ASSERT_TRUE(compare.isEnabled());
  QTest::mouseClick(&compare, Qt::LeftButton);
  ASSERT_TRUE(done());
  const QString words = find<QLabel>("comparison").text();
  EXPECT_TRUE(words.contains("Cramer-Rao")) << words.toStdString();
  EXPECT_TRUE(words.contains("largest displacement")) << words.toStdString();
  const auto& map = find<HeatmapView>("comparisonMap");
  EXPECT_TRUE(map.isVisible());
  EXPECT_GT(map.heatmap().values.cwiseAbs().maxCoeff(), 0) << "softer rubber answers more";
  QTest::mouseClick(&find<QPushButton>("takeKept"), Qt::LeftButton);
  EXPECT_EQ(workbench.project().design, paperDesign());
}

TEST_F(DesignStudies, CompareADesignAtOnceWithTheOneBeforeTheLastChange) {
  soften();
  Project pressed = workbench.project();
  pressed.load.areas[0].force_N.z() = -2; // a load is no other design
  workbench.edit("press", pressed);
  Project next = workbench.project();
  next.design.material.poissonRatio = 0.48;
  workbench.edit("squeezable", next);
  open(3);
  auto& with = find<QComboBox>("compareWith");
  ASSERT_EQ(with.count(), 2);
  EXPECT_EQ(with.currentIndex(), 0);
  EXPECT_TRUE(with.currentText().contains("before change: rubber")) << with.currentText().toStdString();
  EXPECT_TRUE(with.currentText().contains("-> 0.48")) << with.currentText().toStdString();
  const int entries = workbench.history().count();
  QTest::mouseClick(&find<QPushButton>("compareDesigns"), Qt::LeftButton);
  ASSERT_TRUE(done());
  ASSERT_TRUE(workbench.project().studies.compared);
  EXPECT_EQ(workbench.project().studies.compared->earlier, pressed.design);
  EXPECT_EQ(workbench.project().studies.compared->now, next.design);
  EXPECT_EQ(workbench.history().count(), entries) << "neither undone nor done again";
  EXPECT_TRUE(find<QLabel>("comparisonState").isHidden());
  // Another one of the list, by hand.
  with.setCurrentIndex(1);
  emit with.activated(1);
  EXPECT_FALSE(find<QLabel>("comparisonState").isHidden()) << "the table is of the other one";
  QTest::mouseClick(&find<QPushButton>("keptFields"), Qt::LeftButton);
  EXPECT_EQ(workbench.project().kept, paperDesign());
  EXPECT_TRUE(workbench.project().view.lessReference);
  EXPECT_EQ(window.currentScene().objectName(), "deformation");
}

TEST_F(DesignStudies, TheSizesOfABlockThatAreTypedOneByOneAreOneChange) {
  Project softer = workbench.project();
  std::get<MooneyRivlin>(softer.design.material.law).c10_MPa *= 0.9;
  workbench.edit("softer", softer);
  find<QCheckBox>("scaleWires").setChecked(true);
  for (const auto& [name, size] : {std::pair{"block_mm[0]", "40"}, {"block_mm[1]", "40"}, {"block_mm[2]", "8"}}) {
    auto& field = find<QLineEdit>(name);
    field.setFocus();
    field.selectAll();
    QTest::keyClicks(&field, size);
  }
  open(3);
  auto& with = find<QComboBox>("compareWith");
  EXPECT_EQ(with.count(), 4);
  EXPECT_TRUE(with.currentText().contains("size along x 30 -> 40 mm")) << with.currentText().toStdString();
  EXPECT_TRUE(with.itemData(with.currentIndex(), Qt::ToolTipRole).toString().contains("30 x 30 x 5"));
}

TEST_F(DesignStudies, AComparisonThatIsStoppedSaysSoAndKeepsTheOneBefore) {
  soften();
  open(3);
  auto& compare = find<QPushButton>("compareDesigns");
  QTest::mouseClick(&compare, Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("comparison").text().contains("%"); }, kPatience_ms))
      << "how far it is";
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(done());
  EXPECT_TRUE(find<QLabel>("comparison").text().contains("Cancelled"));
  EXPECT_FALSE(workbench.project().studies.compared);
  EXPECT_TRUE(compare.isEnabled());
}

TEST_F(DesignStudies, AreKeptByTheProjectAndFaintWhereTheDesignIsAnotherOne) {
  Project next = workbench.project();
  const SensorDesign before = next.design;
  std::get<MooneyRivlin>(next.design.material.law).c10_MPa *= 0.5;
  SensorDesign layout = next.design;
  layout.upper.z_mm = {{3.5}};
  const BoundSummary bounds{{11.1, 21, 15}, {19.3, 67.2, 61.1}, {2, 1.7, 2.1}, {2, 1.7, 2.1}};
  next.studies.scaleWires = true;
  next.studies.sweep = {"upper_layer.z_mm", 3, 4, 5, false};
  next.studies.found = FoundLayout{next.design, layout, bounds, bounds, 640};
  next.studies.curve = DesignSweepCurve{next.design, "upper_layer.z_mm", 1e-4, {{3, bounds}, {4, bounds}}, 1};
  next.studies.compared = DesignsCompared{
      before, next.design, "12:00, before: softer", next.load, 1e-4, bounds, bounds, "words", 1, 2, {0.5, -0.25}};
  const Project again = parseProject(projectText(next), "x.json", {});
  EXPECT_EQ(again.studies, next.studies);
  workbench.replace(again, "x.json");
  open(1);
  EXPECT_TRUE(find<QPushButton>("takeLayout").isEnabled()) << "a layout that was found is not lost";
  EXPECT_TRUE(find<QLabel>("layoutWords").text().contains("640"));
  open(2);
  EXPECT_TRUE(find<QCheckBox>("scaleWires").isChecked());
  EXPECT_EQ(find<QComboBox>("sweepNumber").currentData().toString(), "upper_layer.z_mm");
  EXPECT_EQ(find<QDoubleSpinBox>("sweepStart").value(), 3);
  EXPECT_EQ(find<QSpinBox>("sweepSteps").value(), 5);
  EXPECT_EQ(find<ChartView>("sweepChart").chart().series.size(), 6u);
  const QString best = find<QTabWidget>("designTabs").findChild<QLabel*>("sweepWords")->text();
  EXPECT_TRUE(best.contains("Lowest at 3 mm")) << best.toStdString();
  EXPECT_TRUE(best.contains(" N ")) << best.toStdString();
  EXPECT_TRUE(find<QLabel>("designSweepState").isHidden());
  open(3);
  EXPECT_TRUE(find<QLabel>("comparison").text().contains("before: softer"));
  EXPECT_TRUE(find<HeatmapView>("comparisonMap").isVisible());
  EXPECT_TRUE(find<QLabel>("comparisonState").isHidden()) << find<QLabel>("comparisonState").text().toStdString();
  Project other = workbench.project();
  std::get<MooneyRivlin>(other.design.material.law).c01_MPa *= 0.5;
  workbench.edit("softer", other);
  EXPECT_FALSE(find<QLabel>("comparisonState").isHidden());
  EXPECT_FALSE(find<QLabel>("designSweepState").isHidden());
  EXPECT_FALSE(find<QPushButton>("takeLayout").isEnabled());
  workbench.history().undo();
  EXPECT_TRUE(find<QLabel>("designSweepState").isHidden()) << "the same design again";
}

TEST(BoundWords, GiveTheThreeForcesOneNumberOfDecimals) {
  EXPECT_EQ(boundPercents({1.2, 0.971, 1.24}), "1.20 / 0.97 / 1.24 %");
  EXPECT_EQ(boundPercents({19.31, 67.2, 6.11}), "19.3 / 67.2 / 6.1 %");
  EXPECT_EQ(boundPercents({1, 120.4, std::numeric_limits<double>::infinity()}), "1 / 120 / - %");
  EXPECT_EQ(boundNewtons({2, 1.7, 2.1}, {}), "0.040 / 0.034 / 0.126 N") << "of 2, 2 and 6 N";
}

} // namespace
} // namespace palp
