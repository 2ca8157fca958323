#include "app/gui/views/HeatmapView.h"
#include "model/FieldAtRest.h"
#include "solver/ConductionField.h"
#include "tests/app/gui/WindowFixture.h"

#include <QComboBox>
#include <QLabel>

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
  ASSERT_TRUE(solved()); // on the Deformation scene
  ASSERT_TRUE(idle());
  EXPECT_EQ(map().values.size(), 0);
  window.showScene("resistance");
  ASSERT_TRUE(window.busy());
  EXPECT_TRUE(QString::fromStdString(map().title).contains("being computed")) << map().title;
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  EXPECT_TRUE(QString::fromStdString(map().title).contains("stopped")) << map().title;
  window.showScene("design");
  window.showScene("resistance");
  EXPECT_TRUE(shown()) << map().title;
}

} // namespace
} // namespace palp
