// What an operator is told about a board with broken wires, and that it stays broken.

#include "tests/app/gui/live/LiveOperatorFixture.h"
#include "tests/io/SmallDecoders.h"

#include <QComboBox>
#include <QSignalSpy>
#include <QSpinBox>

namespace palp {
namespace {

using LiveBrokenBoard = LiveOperator;

/// Reads all row-wires of the simulated board but this one; what forces it gives does not matter here.
Decoder networkWithoutRow(int row) {
  SmallSamples samples;
  samples.inputs = 1000 + 10 * Eigen::MatrixXd::Random(9 * 30, 12).array();
  Decoder decoder = emptyDecoder(DecoderKind::Rbf, samples);
  decoder.input.rows.clear();
  for (int other = 0; other < 10; ++other)
    if (other != row) decoder.input.rows.push_back(other);
  decoder.input.rowWires = 10;
  decoder.input.valuesPerRow = 30;
  RbfOptions options;
  options.tail = Tail::Bias;
  options.spread = 1;
  decoder.model = trainRbf(samples.inputs, samples.forces, options).network;
  return decoder;
}

TEST_F(LiveBrokenBoard, AWireThatIsBrokenStaysSoWhenTheSceneOrTheBoardComesBack) {
  ASSERT_TRUE(waitForFrames());
  type<QSpinBox>("openRow", "3");
  auto before = page.host().status().connections - 1;
  const auto broken = [&] {
    const LiveFrame* last = page.host().history().last();
    return last != nullptr && last->connection > before && last->faults.size() == 1 &&
           last->faults[0] == "row-wire 3: open";
  };
  ASSERT_TRUE(wait(broken));
  before = page.host().status().connections;
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Searching));
  click("plug");
  EXPECT_TRUE(wait(broken)) << "plugged in again";
  ASSERT_TRUE(wait([&] { return page.host().status().framesPerSecond > 0; }));
  before = page.host().status().connections;
  page.hide();
  ASSERT_TRUE(wait([&] { // until the board is let go of
    page.host().look();
    return page.host().status().state == LiveState::Paused && page.host().status().framesPerSecond == 0;
  }));
  page.show();
  EXPECT_TRUE(wait(broken)) << "seen again";
}

TEST_F(LiveBrokenBoard, ABrokenWireLeadsToANetworkThatDoesWithoutIt) {
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(find<QPushButton>("otherRows").isHidden());
  type<QSpinBox>("openRow", "3");
  ASSERT_TRUE(wait([&] { return find<QPushButton>("otherRows").isVisible(); })) << banner().toStdString();
  EXPECT_TRUE(banner().startsWith("row-wire 3: open. ")) << banner().toStdString();
  EXPECT_TRUE(banner().contains("Network, Row-wires 0,1,2,4,5,6,7,8,9")) << banner().toStdString();
  QSignalSpy scenes(&page, &LivePage::sceneRequested);
  click("otherRows");
  ASSERT_EQ(scenes.size(), 1);
  EXPECT_EQ(scenes[0][0].toString(), "network");
  EXPECT_EQ(workbench.project().network.rows, "0,1,2,4,5,6,7,8,9");
  EXPECT_EQ(workbench.project().network.input, InputKind::Resistance);
  EXPECT_GE(workbench.project().network.noise, 5e-6);
  type<QSpinBox>("openColumn", "7"); // no network does without a column-wire
  EXPECT_TRUE(wait([&] { return banner().contains("repair the wire"); })) << banner().toStdString();
  EXPECT_TRUE(find<QPushButton>("otherRows").isHidden());
}

TEST_F(LiveBrokenBoard, ABrokenColumnWireWidensTheDeviationAndEndsNoForce) {
  ASSERT_TRUE(waitForFrames());
  type<QSpinBox>("openColumn", "7");
  ASSERT_TRUE(wait([&] { return banner().startsWith("column-wire 7: open. Forces continue"); }))
      << banner().toStdString();
  const LiveFrame* last = page.host().history().last();
  EXPECT_TRUE(last->forces.valid) << last->forces.reason;
  EXPECT_EQ(last->forces.missingReadings, 10);
  type<QSpinBox>("openColumn", "none");
  EXPECT_TRUE(wait([&] { return banner().isEmpty(); })) << banner().toStdString();
}

TEST_F(LiveBrokenBoard, AWireThatTheNetworkDoesNotReadIsNoAlarm) {
  ASSERT_TRUE(waitForFrames());
  type<QSpinBox>("openRow", "3");
  auto& words = find<QLabel>("liveBanner");
  ASSERT_TRUE(wait([&] { return banner().startsWith("row-wire 3: open"); }));
  EXPECT_EQ(words.property("role"), "banner");
  page.host().network().refine(networkWithoutRow(3), "without row-wire 3");
  ASSERT_TRUE(wait([&] { return banner().contains("does not need it"); })) << banner().toStdString();
  EXPECT_TRUE(banner().startsWith("row-wire 3: open")) << banner().toStdString();
  EXPECT_EQ(words.property("role"), "note");
  EXPECT_TRUE(find<QPushButton>("otherRows").isHidden());
  type<QSpinBox>("openRow", "4");
  ASSERT_TRUE(wait([&] { return banner().startsWith("row-wire 4: open"); }));
  EXPECT_TRUE(wait([&] { return words.property("role") == "banner"; })) << "this one it reads";
}

TEST_F(LiveBrokenBoard, OnlyWiresOfTheSimulatedDesignCanBreak) {
  ASSERT_TRUE(waitForFrames());
  auto& row = find<QSpinBox>("openRow");
  auto& column = find<QSpinBox>("openColumn");
  ASSERT_TRUE(wait([&] { return column.maximum() == 29; })) << column.maximum();
  EXPECT_EQ(row.maximum(), 9);
  type<QSpinBox>("openColumn", "none");
  QTest::keyClick(&column, Qt::Key_Down);
  EXPECT_EQ(workbench.project().live.simulation.openColumn, -1);
  use([](LiveSettings& live) { live.simulation.openRow = 20; }); // as a project file may say
  EXPECT_TRUE(wait([&] { return row.text() == "none"; })) << row.text().toStdString();
  ASSERT_TRUE(waitForFrames());
  EXPECT_EQ(banner(), "");
  QTest::keyClick(&row, Qt::Key_Up);
  EXPECT_EQ(workbench.project().live.simulation.openRow, 0);
}

TEST_F(LiveBrokenBoard, TheRowWiresThatMayBeScannedAloneAreThoseOfTheBoard) {
  ASSERT_TRUE(waitForFrames());
  auto& rows = find<QComboBox>("rows");
  ASSERT_TRUE(wait([&] { return rows.count() == 11; })) << rows.count();
  EXPECT_EQ(rows.itemText(10), "Row-wire 9 alone");
  rows.setFocus();
  QTest::keyClick(&rows, Qt::Key_End);
  EXPECT_EQ(workbench.project().live.row, 9);
  EXPECT_EQ(rows.currentText(), "Row-wire 9 alone");
}

} // namespace
} // namespace palp
