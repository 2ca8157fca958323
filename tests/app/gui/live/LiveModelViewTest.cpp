#include "app/gui/live/LiveModelView.h"

#include "app/gui/jobs/FieldTouch.h"

#include <QLabel>
#include <QTest>

#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr int kTwinPatience_ms = 60000;

/// The share that the twin says of a board whose dR/R is `times` its own.
double saidBeside(LiveModelView& twin, const Touch& touch, const Eigen::MatrixXd& own, double times) {
  twin.solve(touch.design(), touch.load(), touch.meshOptions(), times * own);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !twin.runner().running(); }, kTwinPatience_ms));
  const QString words = twin.findChild<QLabel*>("twinWords")->text();
  const QString before = "differs from the board's by ";
  EXPECT_TRUE(words.contains(before)) << words.toStdString();
  return words.mid(words.indexOf(before) + before.size()).section(' ', 0, 0).toDouble();
}

TEST(LiveModelView, ComparesItselfWithTheBoardUnderTheFieldToo) {
  SensorDesign design = paperDesign();
  design.resistance = FieldLaw{.readout = Readout::VirtualGround};
  MeshOptions mesh;
  mesh.mapped = std::array<int, 3>{6, 6, 2};
  Touch touch(design, {{{1, {0.3, 0, -4}}}, {}, {}}, mesh);
  ASSERT_TRUE(touch.advance(Stage::Displacements));
  const auto resistances = fieldResistances(touch, 1, {});
  ASSERT_TRUE(resistances);
  const Eigen::MatrixXd own = resistances->now_ohm.cwiseQuotient(resistances->rest_ohm).array() - 1;
  LiveModelView twin;
  EXPECT_LT(saidBeside(twin, touch, own, 1), 1e-6);
  EXPECT_NEAR(saidBeside(twin, touch, own, 2), 50, 0.5); // the second keeps mesh and field
  EXPECT_NEAR(saidBeside(twin, touch, own, 4), 75, 0.5);
}

} // namespace
} // namespace palp
