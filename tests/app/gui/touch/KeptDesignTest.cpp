#include "app/gui/jobs/MatchedLoad.h"
#include "app/gui/jobs/ReferenceTouch.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapView.h"
#include "solver/PointProbe.h"
#include "tests/app/gui/WindowFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>

#include <gtest/gtest.h>

namespace palp {
namespace {

SensorDesign softer() {
  SensorDesign design = paperDesign();
  design.material.law = timesStress(design.material.law, 0.5);
  return design;
}

Touch solvedTouch(const SensorDesign& design, const std::array<int, 3>& mapped) {
  MeshOptions mesh;
  mesh.mapped = mapped;
  Touch touch(design, exampleProject().load, mesh);
  EXPECT_TRUE(touch.advance(Stage::Resistances));
  return touch;
}

TEST(ReferencePath, OfTheSameDesignIsTheSameFieldToRounding) {
  const Touch shown = solvedTouch(paperDesign(), {6, 6, 2});
  const NodalFields own = shown.problem()->fields(shown.solution()->state());
  const NodalFields kept = referencePath(paperDesign(), shown, {}).at(1).fields;
  const double largest = own.displacement_mm.cwiseAbs().maxCoeff();
  EXPECT_LT((kept.displacement_mm - own.displacement_mm).cwiseAbs().maxCoeff(), 1e-9 * largest);
  EXPECT_LT((kept.cauchy_MPa - own.cauchy_MPa).cwiseAbs().maxCoeff(), 1e-9 * own.cauchy_MPa.cwiseAbs().maxCoeff());
  EXPECT_LT((kept.volumeRatio - own.volumeRatio).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ReferencePath, OfABlockOfAnotherSizeIsReadAtTheSameSharesOfItsSides) {
  SensorDesign thicker = paperDesign();
  thicker.block_mm.z() = 8;
  const Touch shown = solvedTouch(thicker, {6, 6, 2}), alone = solvedTouch(paperDesign(), {6, 6, 2});
  const ReferencePath path = referencePath(paperDesign(), shown, {});
  const NodalFields own = alone.problem()->fields(alone.solution()->state());
  // Both meshes are the same lattice of shares: node by node.
  EXPECT_LT((path.at(1).fields.displacement_mm - own.displacement_mm).cwiseAbs().maxCoeff(),
            1e-9 * own.displacement_mm.cwiseAbs().maxCoeff());
  EXPECT_TRUE(path.at(1).electrodes.upper_mm.isApprox(alone.displacements()->upper_mm, 1e-12));
}

TEST(ReferencePath, OfABlockOfAnotherSizeIsPressedAtTheSameSharesOfItsSides) {
  SensorDesign wide = paperDesign();
  wide.block_mm = {40, 45, 8};
  LoadCase load;
  load.patches.push_back({{20, 30}, 5, {1, 0, -3}});
  const LoadCase matched = matchedLoad(load, wide, paperDesign());
  ASSERT_EQ(matched.patches.size(), 1u);
  EXPECT_TRUE(matched.patches[0].centre_mm.isApprox(Eigen::Vector2d(15, 20), 1e-12));
  EXPECT_EQ(matched.patches[0].radius_mm, 5) << "it is the same stamp";
  EXPECT_EQ(matched.patches[0].force_N, load.patches[0].force_N);
  EXPECT_EQ(matchedLoad(load, wide, wide), load);
  MeshOptions mesh;
  mesh.mapped = {8, 8, 2};
  Touch shown(wide, load, mesh);
  ASSERT_TRUE(shown.advance(Stage::Resistances));
  const ReferencePath path = referencePath(paperDesign(), shown, {});
  EXPECT_EQ(path.load, matched);
  // Both sink most at the same share of their sides: nothing is left of one that is pressed elsewhere.
  const auto deepest = [&](const NodalFields& fields) {
    Eigen::Index node = 0;
    fields.displacement_mm.row(2).minCoeff(&node);
    return Eigen::Vector3d(shown.mesh()->nodes_mm.col(node).cwiseQuotient(wide.block_mm));
  };
  EXPECT_LT((deepest(path.at(1).fields) - deepest(shown.problem()->fields(shown.solution()->state()))).norm(),
            1.5 / 8); // a cell of the mesh
}

TEST(ReferencePath, IsRefusedInASentenceWhereItsLoadAreasAreOtherPlaces) {
  const Touch shown = solvedTouch(paperDesign(), {6, 6, 2});
  SensorDesign four = paperDesign();
  four.areas = {2, 2};
  try {
    referencePath(four, shown, {});
    FAIL() << "area 1 is another place there";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("another position"), std::string::npos) << error.what();
  }
}

TEST(ReferencePath, IsRefusedInASentenceWhereTheKeptDesignHasNoSuchArea) {
  const Touch shown = solvedTouch(paperDesign(), {6, 6, 2});
  SensorDesign one = paperDesign();
  one.areas = {1, 1};
  try {
    referencePath(one, shown, {});
    FAIL() << "the load is on area 1";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("reference design"), std::string::npos) << error.what();
  }
}

class KeptDesign : public WindowFixture {
protected:
  /// Keeps the paper's design by its button and softens the rubber.
  void keepAndSoften() {
    window.showScene("design");
    find<QTabWidget>("designTabs").setCurrentIndex(3);
    QTest::mouseClick(&find<QPushButton>("keepDesign"), Qt::LeftButton);
    Project next = workbench.project();
    next.design = softer();
    workbench.edit("softer", next);
  }
  bool compared() {
    return QTest::qWaitFor([&] { return solved() && workbench.referencePath() != nullptr && !window.busy(); },
                           kPatience_ms);
  }
  double largestDifference(Quantity quantity) {
    const auto path = workbench.referencePath();
    const std::vector<double> values = quantityValues(quantity, *workbench.touch().fields(), path->at(1).fields);
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return largest;
  }
};

TEST_F(KeptDesign, IsSubtractedFromTheBlockOnTheDeformationScene) {
  ASSERT_TRUE(solved());
  EXPECT_FALSE(find<QCheckBox>("lessKept").isEnabled()) << "nothing is kept";
  keepAndSoften();
  EXPECT_EQ(workbench.referencePath(), nullptr) << "what no scene shows is not computed";
  QTest::mouseClick(&find<QPushButton>("keptFields"), Qt::LeftButton);
  EXPECT_EQ(window.currentScene().objectName(), "deformation");
  ASSERT_TRUE(compared());
  EXPECT_TRUE(find<QCheckBox>("lessKept").isChecked());
  auto& block = find<BlockView>("block");
  const double u = largestDifference(Quantity::Displacement);
  EXPECT_GT(u, 0.01) << "softer rubber gives way";
  EXPECT_NEAR(block.colorRange()[1], u, 1e-9);
  EXPECT_EQ(block.colorRange()[0], -block.colorRange()[1]) << "of both signs";
  const QString words = find<QLabel>("difference").text();
  EXPECT_TRUE(words.contains("differs most at")) << words.toStdString();
  find<QComboBox>("quantity").setCurrentIndex(static_cast<int>(Quantity::StressZZ));
  settle();
  EXPECT_NEAR(block.colorRange()[1], largestDifference(Quantity::StressZZ), 1e-9);
  find<QTabWidget>("deformationTabs").setCurrentIndex(3);
  settle();
  const ChartSpec& line = find<ChartView>("linePlot").chart();
  ASSERT_EQ(line.series.size(), 2u) << "beside each other along the line";
  EXPECT_NE(line.series[0].y, line.series[1].y);
  find<QCheckBox>("lessKept").click();
  settle();
  EXPECT_TRUE(find<QLabel>("difference").isHidden());
  EXPECT_EQ(find<ChartView>("linePlot").chart().series.size(), 1u);
}

TEST_F(KeptDesign, FollowsTheLoad) {
  keepAndSoften();
  QTest::mouseClick(&find<QPushButton>("keptFields"), Qt::LeftButton);
  ASSERT_TRUE(compared());
  const double before = largestDifference(Quantity::Displacement);
  Project next = workbench.project();
  next.load.areas[0].force_N *= 0.25;
  workbench.edit("less", next);
  EXPECT_TRUE(QTest::qWaitFor([&] { return workbench.touch().upToDate(); }, kPatience_ms));
  ASSERT_TRUE(compared());
  EXPECT_LT(largestDifference(Quantity::Displacement), 0.5 * before);
  EXPECT_NEAR(find<BlockView>("block").colorRange()[1], largestDifference(Quantity::Displacement), 1e-9);
}

TEST_F(KeptDesign, IsSavedWithTheProjectAndStandsInNoHistory) {
  keepAndSoften();
  QTest::mouseClick(&find<QPushButton>("keptFields"), Qt::LeftButton);
  const Project again = parseProject(projectText(workbench.project()), "x.json", {});
  EXPECT_EQ(again.kept, paperDesign());
  EXPECT_EQ(again, workbench.project());
  workbench.history().undo();
  EXPECT_EQ(workbench.project().design, paperDesign());
  EXPECT_FALSE(workbench.history().canUndo());
  EXPECT_EQ(workbench.project().kept, paperDesign());
  EXPECT_TRUE(window.isWindowModified()) << "the file does not hold it";
  workbench.history().redo();
  const Project earlier = workbench.project();
  workbench.history().undo(); // undo, keep, redo: the design before is kept
  find<QPushButton>("keepDesign").click();
  ASSERT_TRUE(workbench.history().canRedo());
  workbench.history().redo();
  EXPECT_EQ(workbench.project().kept, paperDesign());
  EXPECT_EQ(workbench.project().design, earlier.design);
}

TEST_F(KeptDesign, ThatCannotBearTheLoadIsSaidBesideTheResult) {
  Project next = workbench.project();
  next.kept = paperDesign();
  next.kept->areas = {1, 1};
  next.view.lessReference = true;
  workbench.edit("one area", next);
  ASSERT_TRUE(solved());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !workbench.kept().problem().isEmpty(); }, kPatience_ms));
  settle();
  const QString words = find<QLabel>("difference").text();
  EXPECT_TRUE(words.contains("reference design")) << words.toStdString();
  EXPECT_TRUE(words.contains("area 1")) << words.toStdString();
}

TEST_F(KeptDesign, IsSubtractedFromTheHeatmapOfTheResistances) {
  window.showScene("resistance");
  ASSERT_TRUE(solved());
  auto& kind = find<QComboBox>("resistanceKind");
  const auto less = static_cast<int>(ResistanceKind::LessReference);
  EXPECT_FALSE(kind.model()->flags(kind.model()->index(less, 0)).testFlag(Qt::ItemIsEnabled)) << "nothing is kept";
  keepAndSoften();
  window.showScene("resistance");
  ASSERT_TRUE(solved());
  kind.setCurrentIndex(less);
  ASSERT_TRUE(compared());
  settle();
  const auto share = [](const SensorDesign& design, const ElectrodeDisplacements& moved) -> Eigen::MatrixXd {
    const Eigen::MatrixXd rest = rowColumnResistances(design, ElectrodeDisplacements::atRest(design));
    return 100 * (rowColumnResistances(design, moved) - rest).cwiseQuotient(rest);
  };
  const Eigen::MatrixXd wanted = share(softer(), *workbench.touch().electrodes()) -
                                 share(paperDesign(), workbench.referencePath()->at(1).electrodes);
  const Eigen::MatrixXd& shown = find<HeatmapView>("resistanceHeatmap").heatmap().values;
  ASSERT_EQ(shown.rows(), wanted.rows());
  EXPECT_LT((shown - wanted).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(wanted.cwiseAbs().maxCoeff(), 0.01);
}

TEST_F(KeptDesign, ARangeThatIsKeptIsThereAgainAfterTheDifference) {
  keepAndSoften();
  window.showScene("deformation");
  ASSERT_TRUE(solved());
  find<QCheckBox>("keepRange").setChecked(true);
  find<QDoubleSpinBox>("rangeTo").setValue(0.25);
  find<QDoubleSpinBox>("rangeFrom").setValue(-0.04);
  const std::array<double, 2> range{-0.04, 0.25};
  ASSERT_EQ(find<BlockView>("block").colorRange(), range);
  window.showScene("design");
  QTest::mouseClick(&find<QPushButton>("keptFields"), Qt::LeftButton);
  ASSERT_TRUE(compared());
  settle();
  EXPECT_FALSE(find<QCheckBox>("keepRange").isChecked()) << "a difference has a range of its own";
  EXPECT_NE(find<BlockView>("block").colorRange(), range);
  find<QCheckBox>("lessKept").click();
  settle();
  EXPECT_TRUE(find<QCheckBox>("keepRange").isChecked());
  EXPECT_EQ(find<BlockView>("block").colorRange(), range);
}

} // namespace
} // namespace palp
