#include "app/gui/live/LivePage.h"

#include "app/gui/live/LiveCalibration.h"
#include "app/gui/live/LiveModelView.h"
#include "app/gui/live/LiveView.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/views/StripChart.h"
#include "app/study/Resources.h"
#include "app/study/live/SimulatedTouch.h"
#include "io/SampleFile.h"
#include "tests/app/gui/live/LivePageFixture.h"

#include <QApplication>
#include <QClipboard>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST_F(Live, ShowsThePressOfTheSimulatedBoardAndMeshesAndSolvesNothing) {
  ASSERT_TRUE(waitForArrow());
  EXPECT_EQ(block().arrows().size(), 1u);
  EXPECT_LT(block().arrows()[0].force_N.z(), 0);
  EXPECT_TRUE(find<QLabel>("liveState").text().startsWith("Simulated"));
  EXPECT_EQ(find<HeatmapView>("liveHeatmap").heatmap().values.cols(), 30);
  EXPECT_EQ(find<StripChart>("forceCurves").chart().series.size(), 3u);
  EXPECT_EQ(find<StripChart>("changeCurves").chart().series.size(), 6u) << "one a load area";
  EXPECT_TRUE(workbench.touch().stages().counts().empty());
  EXPECT_TRUE(page.twin().stages().counts().empty());
}

TEST_F(Live, NamesTheWireThatBreaksAndGreysItsCellsUntilItIsMended) {
  ASSERT_TRUE(waitForArrow());
  type<QSpinBox>("openColumn", "7");
  ASSERT_TRUE(wait([&] { return banner().startsWith("column-wire 7: open"); }));
  EXPECT_FALSE(block().stale()) << "the other readings give the force";
  const HeatmapSpec& heatmap = find<HeatmapView>("liveHeatmap").heatmap();
  EXPECT_TRUE(heatmap.values.col(7).array().isNaN().all());
  EXPECT_FALSE(heatmap.values.col(8).array().isNaN().any());
  EXPECT_FALSE(workbench.history().canUndo()) << "the live settings are no part of the design's history";
  type<QSpinBox>("openColumn", "none");
  EXPECT_EQ(workbench.project().live.simulation.openColumn, -1);
  EXPECT_TRUE(wait([&] { return banner().isEmpty(); }));
  EXPECT_TRUE(waitForArrow());
}

TEST_F(Live, SaysAtOnceThatTheBoardWasPulledOutAndComesBackWithItsTare) {
  ASSERT_TRUE(waitForArrow());
  type<QSpinBox>("tareFrames", "3");
  click("tare");
  ASSERT_TRUE(wait([&] { return page.host().status().tared; }));
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Searching));
  EXPECT_TRUE(wait([&] { return banner().contains("pulled out"); }));
  EXPECT_TRUE(find<QLabel>("liveState").text().startsWith("Searching"));
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Streaming));
  EXPECT_EQ(page.host().status().connections, 2u);
  EXPECT_TRUE(page.host().status().tared);
  EXPECT_TRUE(
      wait([&] { return find<HeatmapView>("liveHeatmap").heatmap().title.find("tared") != std::string::npos; }));
  click("clearTare");
  EXPECT_TRUE(wait([&] { return !page.host().status().tared; }));
}

TEST_F(Live, RecordsMarksAndPlaysStepByStep) {
  const QTemporaryDir folder;
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("a.palprec");
  find<QLineEdit>("recordFile").setText(file);
  click("record");
  ASSERT_TRUE(wait([&] { return page.host().status().recording; }));
  QTest::keyClicks(&find<QLineEdit>("markText"), "poke");
  click("mark");
  ASSERT_TRUE(waitForFrames(20));
  click("record");
  ASSERT_TRUE(wait([&] { return !page.host().status().recording; }));
  use([&](LiveSettings& live) {
    live.source = LiveSourceKind::Recording;
    live.recording = file.toStdString();
    live.replaySpeed = 0.02; // its end is far away, however slow the machine is
  });
  ASSERT_TRUE(wait([&] { return page.host().replaying() && page.host().history().last() != nullptr; }));
  click("replayPause");
  ASSERT_TRUE(waitForState(LiveState::Paused));
  const std::uint64_t before = page.host().status().counts.frames;
  for (int step = 1; step <= 3; ++step) {
    click("replayStep");
    ASSERT_TRUE(wait([&] { return page.host().status().counts.frames >= before + static_cast<unsigned>(step); }));
    ASSERT_EQ(page.host().replay()->steps, 0);
    EXPECT_EQ(page.host().status().counts.frames, before + static_cast<unsigned>(step));
  }
  use([](LiveSettings& live) { live.replaySpeed = 0; });
  click("replayPause");
  ASSERT_TRUE(waitForState(LiveState::Ended));
  EXPECT_EQ(page.host().history().last()->mark, "poke");
  EXPECT_TRUE(wait([&] { return !find<StripChart>("forceCurves").chart().marks.empty(); })); // drawn at the next look
  click("openAgain");
  EXPECT_TRUE(waitForFrames(1));
}

TEST_F(Live, CostsNothingWhileHiddenAndDrawsNoMoreThanThirtyFramesASecond) {
  ASSERT_TRUE(waitForArrow());
  QElapsedTimer clock;
  clock.start();
  const int looks = page.looks();
  const int renders = block().renderCount();
  ASSERT_TRUE(wait([&] { return page.looks() >= looks + 15; }));
  const double most = static_cast<double>(clock.elapsed()) / 1000 * 30 + 2;
  EXPECT_LE(page.looks() - looks, most);
  EXPECT_LE(block().renderCount() - renders, most);
  page.hide();
  QCoreApplication::processEvents();
  const int hiddenLooks = page.looks();
  const int hiddenRenders = block().renderCount() + find<HeatmapView>("liveHeatmap").renderCount();
  const int hiddenPaints = find<StripChart>("forceCurves").paintCount();
  QSignalSpy looked(&page, &LivePage::looked);
  ASSERT_TRUE(wait([&] { return looked.count() >= 2; })); // out of sight, at its slow pace
  EXPECT_EQ(page.looks(), hiddenLooks);
  EXPECT_EQ(block().renderCount() + find<HeatmapView>("liveHeatmap").renderCount(), hiddenRenders);
  EXPECT_EQ(find<StripChart>("forceCurves").paintCount(), hiddenPaints);
  page.show();
  page.host().look(); // what was decoded before it was hidden
  page.host().look();
  EXPECT_TRUE(waitForFrames());
  EXPECT_EQ(page.host().status().counts.lost, 0u);
}

TEST_F(Live, CountsLostReportsApartFromBadOnes) {
  ASSERT_TRUE(waitForFrames());
  EXPECT_EQ(find<QLabel>("liveLosses").text(), "0 lost");
  use([](LiveSettings& live) { live.simulation.dropEvery = 7; });
  ASSERT_TRUE(wait([&] { return page.host().status().counts.lost > 0; }));
  ASSERT_TRUE(wait([&] { return find<QLabel>("liveLosses").text() != "0 lost"; }));
  EXPECT_TRUE(find<QLabel>("liveLosses").text().endsWith(" lost"));
  EXPECT_TRUE(find<QLabel>("liveLossesUnit").text().startsWith("0 corrupt, "))
      << find<QLabel>("liveLossesUnit").text().toStdString();
}

TEST_F(Live, ShowsTheCurveOfTheCellThatIsClicked) {
  ASSERT_TRUE(waitForArrow());
  auto& heatmap = find<HeatmapView>("liveHeatmap");
  const QPoint place(heatmap.width() / 2, heatmap.height() / 2);
  const auto cell = heatmap.cellAt(place);
  ASSERT_TRUE(cell.has_value());
  QTest::mouseClick(&heatmap, Qt::LeftButton, {}, place);
  const QString name = QString("%1, %2").arg((*cell)[0]).arg((*cell)[1]);
  ASSERT_EQ(find<StripChart>("changeCurves").chart().series.size(), 1u);
  EXPECT_EQ(find<StripChart>("changeCurves").chart().series[0].name, name);
  EXPECT_EQ(heatmap.heatmap().selected, cell);
}

TEST_F(Live, SolvesTheTwinOnDemandAndTakesItsLoad) {
  Project coarse = workbench.project();
  coarse.mesh.mapped = {6, 6, 2};
  workbench.edit("mesh", coarse);
  ASSERT_TRUE(waitForArrow());
  page.findChild<QTabWidget*>("blockTabs")->setCurrentIndex(1);
  click("solveTwin");
  ASSERT_TRUE(wait([&] { return page.twin().touch() != nullptr; })) << said.join("; ").toStdString();
  EXPECT_EQ(page.twin().stages().runs("solve"), 1);
  EXPECT_TRUE(page.twin().touch()->solution()->converged);
  EXPECT_TRUE(find<QLabel>("twinWords").text().contains("dR/R"));
  const LoadCase before = workbench.project().load;
  click("takeLoad");
  EXPECT_EQ(workbench.project().load, page.twin().touch()->load());
  workbench.history().undo();
  EXPECT_EQ(workbench.project().load, before);
  EXPECT_TRUE(workbench.touch().stages().counts().empty()) << "the Deformation scene was never shown";
}

TEST_F(Live, RefinesTheNetworkWithFramesOfAFileThatHasGoneSince) {
  ASSERT_TRUE(waitForArrow());
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  auto& calibration = *page.findChild<LiveCalibration*>("calibration");
  const QTemporaryDir folder;
  const QString file = folder.filePath("frames.csv");
  std::filesystem::copy_file(resource("board/paper-samples.csv"), file.toStdString());
  answerFileDialog(file);
  click("loadFrames");
  ASSERT_TRUE(wait([&] { return calibration.frames().samples().size() > 8; })) << said.join("; ").toStdString();
  ASSERT_TRUE(wait([&] { return !calibration.runner().running(); }));
  ASSERT_TRUE(QFile::remove(file));
  click("fitCalibration");
  ASSERT_TRUE(wait([&] { return calibration.calibration().has_value(); })) << said.join("; ").toStdString();
  EXPECT_TRUE(find<QLabel>("calibrationReport").text().contains("Newest:"));
  const QString broken = folder.filePath("broken.csv");
  ASSERT_TRUE(QFile(broken).open(QIODevice::WriteOnly));
  answerFileDialog(broken);
  click("loadFrames");
  ASSERT_TRUE(wait([&] { return !said.isEmpty() && said.back().contains("broken.csv"); })) << "nothing was said";
}

TEST_F(Live, CollectsLabelledFramesAndRefinesTheNetwork) {
  ASSERT_TRUE(waitForArrow());
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  auto& calibration = *page.findChild<LiveCalibration*>("calibration");
  const Agreeing agreeing; // the demo bears another load
  type<QSpinBox>("labelFrames", "1");
  for (int k = 0; k < 9; ++k) {
    type<QSpinBox>("labelArea", QString::number(k % 6));
    type<QDoubleSpinBox>("label_Fz", QString::number(-0.5 * k));
    click("collect");
    ASSERT_TRUE(wait([&] { return calibration.frames().samples().size() == k + 1; }));
  }
  click("fitCalibration");
  ASSERT_TRUE(wait([&] { return calibration.calibration().has_value(); })) << said.join("; ").toStdString();
  EXPECT_EQ(calibration.calibration()->report.samples, 9);
  EXPECT_TRUE(find<QLabel>("calibrationReport").text().contains("coverage"));
  click("useCalibration");
  EXPECT_TRUE(waitForFrames());
  EXPECT_EQ(page.host().status().decoderProblem, "");
}

constexpr int kClings_ms = 3000;

/// A board that this user may not open until it is mended, that can fall silent, and that can be slow to let go.
struct Gate {
  std::atomic<bool> permission{false}, silent{false};
  std::atomic<bool> clings{false};    ///< a source does not let go while this is set
  std::atomic<bool> waitedFor{false}; ///< and has waited for it in vain
};

class GatedSource : public SimulatedSource {
public:
  GatedSource(VirtualBoard board, std::shared_ptr<Gate> gate)
      : SimulatedSource(std::move(board)), gate_(std::move(gate)) {}
  ~GatedSource() override {
    QElapsedTimer clock;
    clock.start();
    while (gate_->clings && clock.elapsed() < kClings_ms) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (gate_->clings) gate_->waitedFor = true; // nobody let go of it
  }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override {
    if (!gate_->silent) return SimulatedSource::read(report, timeout);
    std::this_thread::sleep_for(timeout / 10);
    return Outcome::Nothing;
  }
  [[nodiscard]] std::string name() const override { return "PALP-1 at /dev/hidraw3"; }

private:
  std::shared_ptr<Gate> gate_;
};

class LiveWithABoard : public Live {
protected:
  LiveWithABoard() : LiveWithABoard(std::make_shared<Gate>()) {}
  explicit LiveWithABoard(const std::shared_ptr<Gate>& shared)
      : Live({[shared] {
                return std::vector<HidBoard>{{"/dev/hidraw3", "PALP-1", "Palp board", shared->permission}};
              },
              [shared](const std::string&) -> std::unique_ptr<ReportSource> {
                if (!shared->permission)
                  throw BoardPermissionError("PALP-1 at /dev/hidraw3: no permission to open it; " + permissionRemedy());
                VirtualBoard board = simulatedBoard(loadSamples(resource("board/paper-samples.csv")), {}, 1000, 3);
                return std::make_unique<GatedSource>(std::move(board), shared);
              }}),
        gate(shared) {}
  std::shared_ptr<Gate> gate;
};

TEST_F(LiveWithABoard, ShowsTheRuleWhereItMayNotBeOpenedAndGoesOnWhenItMay) {
  ASSERT_TRUE(waitForState(LiveState::Refused));
  EXPECT_TRUE(wait([&] { return banner().contains("udev rule"); }));
  EXPECT_TRUE(wait([&] { return find<QListWidget>("devices").count() == 3; }));
  EXPECT_TRUE(find<QListWidget>("devices").item(1)->text().contains("no permission"));
  click("copyRemedy");
  EXPECT_TRUE(QApplication::clipboard()->text().startsWith("sudo cp 70-palp-board.rules"));
  gate->permission = true;
  ASSERT_TRUE(waitForState(LiveState::Streaming)) << "by itself";
  EXPECT_FALSE(page.host().simulated());
}

TEST_F(LiveWithABoard, OpensASourceAgainAndAgainWithoutWaitingForThoseBefore) {
  gate->permission = true;
  ASSERT_TRUE(waitForState(LiveState::Streaming));
  gate->clings = true;
  for (int k = 0; k < 3; ++k) {
    page.host().restart();
    EXPECT_FALSE(gate->waitedFor) << "the window has waited for a source that does not let go";
    ASSERT_TRUE(waitForFrames(1));
  }
  gate->clings = false;
}

TEST_F(LiveWithABoard, ShowsThatTheBoardFellSilent) {
  gate->permission = true;
  ASSERT_TRUE(waitForState(LiveState::Streaming));
  gate->silent = true;
  ASSERT_TRUE(waitForState(LiveState::Stalled));
  EXPECT_TRUE(wait([&] { return banner().contains("no report received"); }));
  gate->silent = false;
  EXPECT_TRUE(waitForState(LiveState::Streaming));
}

TEST_F(LiveWithABoard, ChoosesTheSimulatedBoardByAClick) {
  gate->permission = true;
  ASSERT_TRUE(wait([&] { return find<QListWidget>("devices").count() == 3; }));
  auto& list = find<QListWidget>("devices");
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.item(2)).center());
  EXPECT_EQ(workbench.project().live.source, LiveSourceKind::Simulated);
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(page.host().simulated());
  use([](LiveSettings& live) { live.source = LiveSourceKind::Automatic; });
  EXPECT_TRUE(wait([&] { return !page.host().simulated(); }));
}

} // namespace
} // namespace palp
