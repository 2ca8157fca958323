#include "app/gui/views/ChartView.h"
#include "app/study/Resources.h"
#include "app/study/live/LiveSource.h"
#include "tests/app/gui/WindowFixture.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QStatusBar>

namespace palp {
namespace {

class NetworkScene : public WindowFixture {
protected:
  NetworkScene() {
    window.showScene("network");
    EXPECT_TRUE(solved());
  }
  void generate() {
    QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
};

TEST_F(NetworkScene, GoesOnWithSamplesWhereItWasStopped) {
  Project more = workbench.project();
  more.samples.perArea = 400; // so many that the cancel comes first
  workbench.edit("more", more);
  for (int wait_ms = 100; network.samples() == nullptr && network.stoppedAt()[0] == 0; wait_ms += 100) {
    QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
    QTest::qWait(wait_ms); // longer each time: it may still have been meshing
    network.cancel();
    ASSERT_TRUE(idle());
  }
  ASSERT_EQ(network.samples(), nullptr) << "all samples were made before the cancel";
  EXPECT_TRUE(find<QPushButton>("generate").text().contains("Go on"));
  EXPECT_TRUE(find<QLabel>("samplesWords").text().contains("Stopped at sample"));
  generate();
  const SampleSet resumed = network.samples()->training;
  // A whole run gives the same samples.
  NetworkSession other;
  other.setDesign(workbench.project().design);
  other.generate(workbench.project().samples, workbench.project().mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return other.samples() != nullptr; }, kPatience_ms));
  EXPECT_EQ(resumed.forces_N, other.samples()->training.forces_N);
  EXPECT_EQ(resumed.displacements_mm, other.samples()->training.displacements_mm);
  EXPECT_EQ(network.samples()->test.resistances_ohm, other.samples()->test.resistances_ohm);
}

TEST_F(NetworkScene, DrawsNoChartAgainForALoadThatItDoesNotShow) {
  settle();
  auto& chart = find<ChartView>("sweepError");
  const int before = chart.renderCount();
  Project changed = workbench.project();
  changed.load.areas[0].force_N.z() += 1;
  workbench.edit("another load", changed);
  settle();
  EXPECT_EQ(chart.renderCount(), before);
  changed.network.input = InputKind::Resistance; // the paper's points are others
  workbench.edit("another input", changed);
  settle();
  EXPECT_EQ(chart.renderCount(), before + 1);
}

TEST_F(NetworkScene, TriesANetworkOfAFileInTheBackgroundAndSaysWhyAnotherCannotBe) {
  generate();
  answerFileDialog(QString::fromStdString(shippedNetwork().string()));
  QTest::mouseClick(&find<QPushButton>("openNetwork"), Qt::LeftButton);
  EXPECT_EQ(network.fit(), nullptr) << "read while the window waited";
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  EXPECT_EQ(network.fit()->settings.input, InputKind::Resistance);
  EXPECT_EQ(network.fit()->prediction.forces_N.cols(), network.samples()->test.size());
  ASSERT_TRUE(idle());
  const NetworkFit* good = network.fit();
  answerFileDialog(QString::fromStdString(resource("paper.json").string())); // a design is no network
  QTest::mouseClick(&find<QPushButton>("openNetwork"), Qt::LeftButton);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return window.statusBar()->currentMessage().contains("paper.json"); }, kPatience_ms))
      << window.statusBar()->currentMessage().toStdString();
  EXPECT_EQ(network.fit(), good);
}

TEST_F(NetworkScene, PutsEveryDecoderOnTheSameAxes) {
  generate();
  find<QComboBox>("input").setCurrentIndex(1);
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == allDecoderKinds().size(); }, kPatience_ms));
  ASSERT_TRUE(idle());
  settle();
  std::size_t trained = 0;
  for (const DecoderTrial& trial : network.trials()) trained += trial.refusal.isEmpty() ? 1 : 0;
  EXPECT_GE(trained, 4u);
  EXPECT_EQ(find<ChartView>("trialsTime").chart().series.size(), trained);
  EXPECT_EQ(find<ChartView>("trialsError").chart().series.size(), trained);
}

TEST_F(NetworkScene, AKeystrokeInTheDesignLosesNothingThatWasTrained) {
  generate();
  QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("sweep"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sweepPoints().size() == 3; }, kPatience_ms));
  ASSERT_TRUE(idle());
  const NetworkSamples* samples = network.samples();
  const NetworkFit* fit = network.fit();
  window.showScene("design");
  auto& height = find<QLineEdit>("block_mm[2]");
  height.setFocus();
  height.selectAll();
  QTest::keyClicks(&height, "6");
  ASSERT_EQ(workbench.project().design.block_mm.z(), 6);
  EXPECT_EQ(network.samples(), samples) << "they are still to be looked at";
  EXPECT_FALSE(network.upToDate());
  EXPECT_FALSE(find<QPushButton>("train").isEnabled()) << "but are not of this design";
  EXPECT_TRUE(find<QLabel>("samplesWords").text().contains("earlier design"));
  window.showScene("network");
  generate();
  EXPECT_NE(network.samples(), samples) << "samples of the other design";
  EXPECT_EQ(network.fit(), nullptr);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(workbench.project().design.block_mm.z(), 5);
  EXPECT_EQ(network.samples(), samples);
  EXPECT_EQ(network.fit(), fit);
  EXPECT_EQ(network.sweepPoints().size(), 3u);
  EXPECT_TRUE(network.upToDate());
}

} // namespace
} // namespace palp
