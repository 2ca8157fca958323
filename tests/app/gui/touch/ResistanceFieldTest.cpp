#include "app/gui/views/BlockView.h"
#include "app/gui/views/HeatmapView.h"
#include "app/study/reports/readout/CurrentPaths.h"
#include "model/FieldAtRest.h"
#include "solver/ConductionField.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QRegularExpression>
#include <QTabWidget>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// The Resistance scene of a design under the field, in the window.
class ResistanceField : public WindowFixture {
protected:
  ResistanceField() {
    Project next = workbench.project();
    next.design.resistance = FieldLaw{.readout = Readout::VirtualGround};
    workbench.edit("field", next);
  }
  const HeatmapSpec& map(const char* name = "resistanceHeatmap") { return find<HeatmapView>(name).heatmap(); }
  bool shown() {
    return QTest::qWaitFor(
        [&] {
          return workbench.touch().upToDate() && !window.busy() && map().values.size() > 0 &&
                 workbench.touch().touch().design() == workbench.project().design;
        },
        kPatience_ms);
  }
  /// Changes dR / R [%] of the touch that is shown, by a read-out.
  Eigen::MatrixXd changes(Readout readout) {
    const Touch& touch = workbench.touch().touch();
    const ConductionField field(*touch.problem());
    const Eigen::MatrixXd now = NetworkReading(*field.network(touch.solution()->state()), readout).resistances_ohm();
    const Eigen::MatrixXd rest =
        NetworkReading(networkAtRest(touch.design(), *touch.design().field()), readout).resistances_ohm();
    return 100 * (now - rest).cwiseQuotient(rest);
  }
  void choose(const char* box, Qt::Key key) {
    auto& combo = find<QComboBox>(box);
    combo.setFocus();
    QTest::keyClick(&combo, key);
  }
};

TEST_F(ResistanceField, StandsBesideThatOfEq1WithFactorAndCorrelation) {
  window.showScene("resistance");
  ASSERT_TRUE(shown()) << map().title;
  const Eigen::MatrixXd field = changes(Readout::VirtualGround);
  EXPECT_EQ(map().values, field);
  SensorDesign design = workbench.project().design;
  design.resistance = PairsLaw{};
  const Eigen::MatrixXd rest = rowColumnResistances(design, ElectrodeDisplacements::atRest(design));
  const Eigen::MatrixXd pairs =
      100 * (rowColumnResistances(design, *workbench.touch().electrodes()) - rest).cwiseQuotient(rest);
  ASSERT_TRUE(find<HeatmapView>("pairsHeatmap").isVisible());
  EXPECT_EQ(map("pairsHeatmap").values, pairs);
  EXPECT_NE(map().title, map("pairsHeatmap").title);
  const auto logs = [](const Eigen::MatrixXd& percent) { return (1 + percent.array() / 100).log().matrix().eval(); };
  const double factor = logs(field).norm() / logs(pairs).norm();
  const double correlation = logs(field).cwiseProduct(logs(pairs)).sum() / (logs(field).norm() * logs(pairs).norm());
  const QString words = find<QLabel>("lawsCompared").text();
  EXPECT_TRUE(words.contains(QString::number(factor, 'g', 3) + " times")) << factor << words.toStdString();
  EXPECT_TRUE(words.contains("correlation " + QString::number(correlation, 'f', 2))) << correlation;
  EXPECT_TRUE(find<QLabel>("reading").text().contains("R = "));
}

TEST_F(ResistanceField, FollowsTheReadoutAndTheLawThatAreSwitchedBesideIt) {
  window.showScene("resistance");
  ASSERT_TRUE(shown()) << map().title;
  const Eigen::MatrixXd grounded = map().values;
  choose("readoutBar", Qt::Key_Up);
  ASSERT_EQ(workbench.project().design.field()->readout, Readout::Floating);
  ASSERT_TRUE(shown());
  EXPECT_LT((map().values - changes(Readout::Floating)).norm(), 1e-9 * grounded.norm()) << "of another solve";
  EXPECT_GT((map().values - grounded).norm(), 0.1 * grounded.norm());
  choose("lawBar", Qt::Key_Up);
  ASSERT_EQ(workbench.project().design, paperDesign());
  ASSERT_TRUE(shown());
  EXPECT_FALSE(find<HeatmapView>("pairsHeatmap").isVisible());
  EXPECT_FALSE(find<QComboBox>("readoutBar").isVisible());
  EXPECT_FALSE(find<QLabel>("lawsCompared").isVisible());
  const Eigen::MatrixXd rest = rowColumnResistances(paperDesign(), ElectrodeDisplacements::atRest(paperDesign()));
  const Eigen::MatrixXd now = rowColumnResistances(paperDesign(), *workbench.touch().electrodes());
  EXPECT_EQ(map().values, 100 * (now - rest).cwiseQuotient(rest));
  workbench.history().undo();
  EXPECT_EQ(workbench.project().design.field()->readout, Readout::Floating);
}

TEST_F(ResistanceField, IsNotComputedWhereNobodyLooksAndSaysWhereItWasStopped) {
  find<QTabWidget>("deformationTabs").setCurrentIndex(1); // one that shows no resistances
  ASSERT_TRUE(solved());
  ASSERT_TRUE(idle());
  EXPECT_EQ(map().values.size(), 0);
  window.showScene("resistance");
  ASSERT_TRUE(window.busy());
  EXPECT_TRUE(QString::fromStdString(map().title).contains("Computing")) << map().title;
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  EXPECT_TRUE(QString::fromStdString(map().title).contains("cancelled")) << map().title;
  window.showScene("design");
  window.showScene("resistance");
  EXPECT_TRUE(shown()) << map().title;
}

TEST_F(ResistanceField, ReadsAllReadoutsOfOneFieldAndSolvesNothingAgainForAnotherLaw) {
  window.showScene("resistance");
  ASSERT_TRUE(shown()) << map().title;
  const Solution* solution = workbench.touch().touch().solution();
  const int fields = workbench.field().runs(), solves = workbench.touch().stages().runs("solve");
  choose("readoutBar", Qt::Key_Up);
  ASSERT_TRUE(shown());
  choose("lawBar", Qt::Key_Up);
  ASSERT_EQ(workbench.project().design.field(), nullptr);
  EXPECT_FALSE(window.busy()) << "Eq. (1) is known at once";
  EXPECT_TRUE(workbench.touch().upToDate());
  choose("lawBar", Qt::Key_Down);
  ASSERT_NE(workbench.project().design.field(), nullptr);
  EXPECT_FALSE(window.busy()) << "and so is the field that was computed";
  ASSERT_TRUE(shown());
  EXPECT_EQ(workbench.touch().touch().solution(), solution);
  EXPECT_EQ(workbench.touch().stages().runs("solve"), solves);
  EXPECT_EQ(workbench.field().runs(), fields);
}

TEST_F(ResistanceField, FollowsTheCurrentOfTheChosenCellWhereItIsAskedFor) {
  window.showScene("resistance");
  ASSERT_TRUE(shown()) << map().title;
  auto& block = find<BlockView>("resistanceBlock");
  auto& box = find<QCheckBox>("currentWay");
  const auto& paths = find<QLabel>("currentPaths");
  EXPECT_FALSE(box.isChecked());
  const std::array<double, 2> displacement = block.colorRange();
  ASSERT_TRUE(box.isEnabled());
  QTest::mouseClick(&box, Qt::LeftButton, {}, QPoint(8, box.height() / 2));
  ASSERT_TRUE(workbench.project().view.currentPaths);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.currentScene().complete() && !window.busy(); }, kPatience_ms));
  EXPECT_NE(block.colorRange(), displacement);
  EXPECT_GT(block.colorRange()[0], 0);
  EXPECT_LT(block.colorRange()[1], 10) << "A/mm2 of 1 A: 1.99 on an electrode that carries all of it";
  const auto found = workbench.field().found(workbench.touch().touch(), workbench.touch().loadFraction());
  ASSERT_NE(found, nullptr);
  const NetworkReading reading(found->network, Readout::VirtualGround);
  const CurrentPaths of = currentPaths(found->network, reading, 4, 15);
  EXPECT_TRUE(paths.text().contains(QString::number(100 * of.straight, 'f', 1) + " %")) << paths.text().toStdString();
  EXPECT_TRUE(paths.text().contains(QString::number(of.metal, 'f', 2) + " A"));
  const std::array<double, 2> first = block.colorRange();
  ViewSettings other = workbench.project().view;
  other.cell = {0, 0};
  Project next = workbench.project();
  next.view = other;
  workbench.edit("another cell", next);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.currentScene().complete() && !window.busy(); }, kPatience_ms));
  EXPECT_NE(block.colorRange(), first) << "another cell, another way";
  EXPECT_TRUE(paths.text().contains("row-wire 0")) << paths.text().toStdString();
  choose("lawBar", Qt::Key_Up);
  ASSERT_EQ(workbench.project().design.field(), nullptr);
  EXPECT_FALSE(box.isEnabled());
  EXPECT_TRUE(box.toolTip().contains("no current field")) << box.toolTip().toStdString();
  EXPECT_FALSE(paths.isVisible());
  ASSERT_TRUE(idle());
  EXPECT_EQ(block.colorRange(), displacement);
}

TEST_F(ResistanceField, FollowsNoCurrentWhereNobodyLooks) {
  Project next = workbench.project();
  next.view.currentPaths = true;
  workbench.edit("way", next);
  ASSERT_TRUE(solved());
  QStringList begun;
  QObject here; // the window lives longer
  for (JobRunner* runner : dynamic_cast<Scene&>(find<QWidget>("resistance")).runners())
    QObject::connect(runner, &JobRunner::started, &here, [&](const QString& title) { begun << title; });
  window.showScene("design");
  next.load.areas[0].force_N.z() = -1;
  workbench.edit("force", next);
  settle();
  ASSERT_TRUE(idle());
  EXPECT_FALSE(begun.contains("Following the current")) << begun.join(", ").toStdString();
  window.showScene("resistance");
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.currentScene().complete() && !window.busy(); }, kPatience_ms));
  EXPECT_EQ(begun.count("Following the current"), 1);
}

TEST_F(ResistanceField, StandsLessAKeptDesignWhateverLawThatHas) {
  window.showScene("resistance");
  ASSERT_TRUE(shown()) << map().title;
  const Eigen::MatrixXd field = map().values;
  for (const bool referenceField : {false, true}) {
    Project next = workbench.project();
    next.kept = paperDesign();
    if (referenceField) next.kept->resistance = FieldLaw{.electrodeRadius_mm = 0.25, .readout = Readout::VirtualGround};
    next.view.resistance = ResistanceKind::LessReference;
    workbench.edit("keep", next);
    ASSERT_TRUE(QTest::qWaitFor([&] { return map().values.size() > 0 && !window.busy(); }, kPatience_ms))
        << map().title;
    Touch kept(*next.kept, next.load, next.mesh);
    ASSERT_TRUE(kept.advance(Stage::Resistances));
    const Eigen::MatrixXd rest = resistancesAtRest_ohm(*next.kept);
    const Eigen::MatrixXd wanted = field - 100 * (*kept.resistances_ohm() - rest).cwiseQuotient(rest);
    EXPECT_LT((map().values - wanted).norm(), 1e-6 * field.norm()) << referenceField;
    EXPECT_NE(map().values.norm(), 0);
  }
}

TEST_F(ResistanceField, StandsOnTheDeformationSceneAndInItsTable) {
  ASSERT_TRUE(solved());
  ASSERT_TRUE(QTest::qWaitFor([&] { return map("heatmap").values.size() > 0 && !window.busy(); }, kPatience_ms))
      << map("heatmap").title;
  EXPECT_EQ(map("heatmap").values, changes(Readout::VirtualGround));
  const QTemporaryDir folder;
  const QString file = folder.filePath("resistances.csv");
  answerFileDialog(file);
  QAction* entry = nullptr;
  for (QAction* action : window.findChildren<QAction*>())
    if (action->text().contains("&resistances")) entry = action;
  ASSERT_NE(entry, nullptr);
  entry->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFileInfo::exists(file) && !window.busy(); }, kPatience_ms));
  QFile in(file);
  ASSERT_TRUE(in.open(QIODevice::ReadOnly));
  const QStringList rows = QString(in.readAll()).split('\n', Qt::SkipEmptyParts).filter(QRegularExpression("^[0-9]"));
  ASSERT_EQ(rows.size(), map("heatmap").values.size());
  const QStringList first = rows[0].split(',');
  EXPECT_NEAR(100 * (first[3].toDouble() / first[2].toDouble() - 1), map("heatmap").values(0, 0), 1e-9);
}

} // namespace
} // namespace palp
