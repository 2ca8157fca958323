// What an operator does in the first half hour, by real clicks and keys.

#include "app/gui/live/LiveCalibration.h"
#include "app/gui/live/RecordingName.h"
#include "app/gui/views/StripChart.h"
#include "io/board/Recording.h"
#include "tests/app/gui/live/LivePageFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QMessageBox>
#include <QSignalSpy>
#include <QSlider>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>

#include <cmath>

namespace palp {
namespace {

/// Presses Yes where a dialog asks whether a file may be replaced.
void answerYes() {
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr) return;
    timer->stop();
    timer->deleteLater();
    QTest::mouseClick(box->button(QMessageBox::Yes), Qt::LeftButton);
  });
  timer->start(20);
}

std::vector<std::string> marksOf(const QString& file) {
  RecordingReader reader(file.toStdString());
  std::vector<std::string> marks;
  while (const auto entry = reader.next())
    if (entry->kind == RecordingEntry::Kind::Mark) marks.emplace_back(entry->bytes.begin(), entry->bytes.end());
  return marks;
}

class LiveOperator : public Live {
protected:
  void recordTo(const QString& file) { find<QLineEdit>("recordFile").setText(file); }
  bool startsToRecord() {
    click("record");
    return wait([&] { return page.host().status().recording; });
  }
  bool stopsToRecord() {
    click("record");
    return wait([&] { return !page.host().status().recording; });
  }
  bool isRed(const char* label) {
    auto& words = find<QLabel>(label);
    return wait([&] { return words.isVisible() && words.property("role") == "problem" && !words.text().isEmpty(); });
  }
  LiveCalibration& calibration() { return find<LiveCalibration>("calibration"); }
  /// Labelled frames of whatever is pressed now, with these forces in z.
  bool collect(int frames, double force_N) {
    page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
    type<QSpinBox>("labelFrames", "1");
    for (int k = 0; k < frames; ++k) {
      type<QSpinBox>("labelArea", QString::number(k % 6));
      type<QDoubleSpinBox>("label_Fz", QString::number(force_N * k));
      const Eigen::Index before = calibration().frames().samples().size();
      click("collect");
      if (!wait([&] { return calibration().frames().samples().size() == before + 1; })) return false;
    }
    return true;
  }
  bool fit() {
    click("fitCalibration");
    return wait([&] { return calibration().calibration().has_value() && !calibration().runner().running(); });
  }
  bool records(const QString& file, std::uint64_t frames) {
    recordTo(file);
    return startsToRecord() && waitForFrames(frames) && stopsToRecord();
  }
  bool plays(const QString& file) {
    use([&](LiveSettings& live) {
      live.source = LiveSourceKind::Recording;
      live.recording = file.toStdString();
    });
    return wait([&] { return page.host().replaying() && page.host().history().last() != nullptr; });
  }

  QTemporaryDir folder;
};

TEST_F(LiveOperator, ASecondRecordingTakesTheNextFreeNameByItself) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(startsToRecord()) << said.join("; ").toStdString();
  const QString second = find<QLineEdit>("recordFile").text();
  EXPECT_NE(second, file);
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(stopsToRecord());
  EXPECT_EQ(QDir(folder.path()).entryList({"touch*.palprec"}).size(), 3);
  EXPECT_NO_THROW(RecordingReader(second.toStdString()));
  EXPECT_FALSE(said.join(' ').contains("--"));
}

TEST(RecordingName, IsDatedOnceAndCountedWhereTheDateIsThereToo) {
  const QTemporaryDir folder;
  const QDateTime now(QDate(2026, 11, 22), QTime(14, 5, 6));
  const auto touched = [&](const QString& name) {
    QFile file(folder.filePath(name));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    return std::filesystem::path(file.fileName().toStdString());
  };
  EXPECT_EQ(freeRecording(folder.filePath("a").toStdString(), now).filename(), "a.palprec");
  EXPECT_EQ(freeRecording(touched("a.palprec"), now).filename(), "a-2026-11-22-140506.palprec");
  EXPECT_EQ(freeRecording(touched("a-2026-11-22-140506.palprec"), now).filename(), "a-2026-11-22-140506-2.palprec");
  EXPECT_EQ(freeRecording(touched("a-2026-11-22-140506-2.palprec"), now).filename(), "a-2026-11-22-140506-3.palprec");
}

TEST_F(LiveOperator, ReplacesTheFileThatTheDialogWasToldTo) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  QFile old(file);
  ASSERT_TRUE(old.open(QIODevice::WriteOnly));
  old.write("an old recording");
  old.close();
  answerFileDialog(file);
  answerYes();
  click("chooseRecordFile");
  ASSERT_EQ(find<QLineEdit>("recordFile").text(), file);
  ASSERT_TRUE(startsToRecord()) << said.join("; ").toStdString();
  ASSERT_TRUE(stopsToRecord());
  EXPECT_EQ(QDir(folder.path()).entryList({"*.palprec"}).size(), 1);
  EXPECT_NO_THROW(RecordingReader(file.toStdString()));
  ASSERT_TRUE(startsToRecord()); // the leave to replace was for once
  ASSERT_TRUE(stopsToRecord());
  EXPECT_EQ(QDir(folder.path()).entryList({"*.palprec"}).size(), 2);
}

TEST_F(LiveOperator, SaysInRedAtTheRecordingWhyNothingIsRecorded) {
  ASSERT_TRUE(waitForFrames());
  recordTo(folder.filePath("no such folder/touch.palprec"));
  click("record");
  EXPECT_TRUE(isRed("recorded"));
  EXPECT_TRUE(find<QLabel>("recorded").text().contains("no such folder"));
  EXPECT_FALSE(find<QPushButton>("record").isChecked());
  recordTo(folder.filePath("touch.palprec"));
  ASSERT_TRUE(startsToRecord());
  EXPECT_TRUE(wait([&] { return find<QLabel>("recorded").property("role") == "hint"; }));
}

TEST_F(LiveOperator, GoesBackToTheNetworkBeforeACalibrationAndMarksBothInTheRecording) {
  ASSERT_TRUE(waitForArrow());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(collect(9, -0.5));
  ASSERT_TRUE(fit());
  const std::string before = page.host().decoder()->trainedWith;
  click("useCalibration");
  auto& name = find<QLabel>("networkName");
  EXPECT_TRUE(wait([&] { return name.text().startsWith("calibrated, 9 frames, 2"); })) << name.text().toStdString();
  const Eigen::MatrixXd calibrated_N = page.host().decoder()->residual_N;
  click("networkBack");
  EXPECT_TRUE(wait([&] { return name.text().startsWith("Palp's own"); })) << name.text().toStdString();
  EXPECT_NE(page.host().decoder()->residual_N, calibrated_N);
  EXPECT_EQ(page.host().decoder()->trainedWith, before);
  ASSERT_TRUE(waitForFrames());
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(wait([&] { return marksOf(file).size() == 2; }));
  EXPECT_EQ(marksOf(file)[0].rfind("network: calibrated, 9 frames", 0), 0U) << marksOf(file)[0];
  EXPECT_EQ(marksOf(file)[1].rfind("network: Palp's own", 0), 0U) << marksOf(file)[1];
}

TEST_F(LiveOperator, SaysThatTheLabelsDoNotBelongToTheFrames) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(collect(12, -0.5)); // whatever was pressed
  auto& table = find<QTableWidget>("labelledFrames");
  EXPECT_FALSE(table.item(0, 6)->text().isEmpty()) << "what the network said stands beside the label";
  ASSERT_TRUE(fit());
  EXPECT_TRUE(find<QLabel>("calibrationReport").text().contains("A bad fit"));
  EXPECT_TRUE(find<QLabel>("calibrationReport").text().contains("the model under these labels"));
}

TEST_F(LiveOperator, RefusesALoadThatMovesInsideAMean) {
  ASSERT_TRUE(waitForArrow());
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  type<QSpinBox>("labelFrames", "120"); // longer than a touch of the demo
  click("collect");
  ASSERT_TRUE(isRed("calibrationProblem"));
  EXPECT_TRUE(find<QLabel>("calibrationProblem").text().contains("moved")) << "nothing was said";
  EXPECT_EQ(calibration().frames().samples().size(), 0);
}

TEST_F(LiveOperator, ANetworkThatCannotBeUsedLeavesTheOneInUse) {
  ASSERT_TRUE(waitForArrow());
  const QString broken = folder.filePath("broken.json");
  QFile file(broken);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("{\"palp_network\": 1}");
  file.close();
  answerFileDialog(broken);
  click("chooseNetwork");
  ASSERT_TRUE(isRed("networkProblem"));
  EXPECT_TRUE(find<QLabel>("networkProblem").text().contains("broken.json"));
  EXPECT_EQ(workbench.project().live.network, "");
  EXPECT_TRUE(page.host().decoder().has_value());
  EXPECT_TRUE(find<QLabel>("networkName").text().startsWith("Palp's own"));
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(page.host().history().last()->forces.valid);
}

TEST_F(LiveOperator, DrawsNoCurveThroughTheTimeThatTheBoardWasOut) {
  ASSERT_TRUE(waitForFrames(20));
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Searching));
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Streaming));
  ASSERT_TRUE(waitForFrames(20));
  for (const char* name : {"forceCurves", "changeCurves"}) {
    ASSERT_TRUE(wait([&] {
      const std::vector<StripSeries>& series = find<StripChart>(name).chart().series;
      return !series.empty() &&
             std::any_of(series[0].y.begin(), series[0].y.end(), [](double y) { return std::isnan(y); });
    })) << name;
  }
}

TEST_F(LiveOperator, SaysNothingAgainstTheUntouchedDemoAndDoubtsADriftingBoard) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(waitForFrames(150));
  for (const LiveHistory::Entry& entry : page.host().history().entries()) EXPECT_EQ(entry.frame->forces.doubt, "");
  EXPECT_TRUE(wait([&] { return find<QLabel>("liveTrust").text() == "fits"; }));
  type<QDoubleSpinBox>("warming", "100");
  EXPECT_TRUE(wait([&] { return find<QLabel>("liveTrust").text() == "doubted"; }));
  EXPECT_EQ(find<QLabel>("liveTrust").property("role"), "problem");
}

TEST_F(LiveOperator, TheSimulatedBoardSimulatesTheProjectsDesign) {
  Project small = workbench.project();
  small.design.lower.wire_mm.resize(12);
  if (small.design.lower.along_mm.size() > 1) small.design.lower.along_mm.resize(12);
  small.mesh.mapped = {6, 6, 2};
  ASSERT_TRUE(check(small.design).empty()) << check(small.design)[0].sentence;
  workbench.edit("fewer wires", small);
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(wait([&] { return find<QLabel>("simulatedDesign").text().contains("not the project's"); }));
  click("simulateDesign");
  ASSERT_TRUE(wait([&] { return page.host().simulatesOwnDesign(); })) << said.join("; ").toStdString();
  ASSERT_TRUE(wait([&] { return page.host().status().info && page.host().status().info->columnWires == 12; }));
  EXPECT_TRUE(waitForArrow()) << page.host().status().decoderProblem;
  EXPECT_TRUE(wait([&] { return find<QLabel>("networkName").text().startsWith("Made for the simulated design"); }));
  workbench.history().undo(); // the paper's design again, and its board and network
  ASSERT_TRUE(wait([&] { return page.host().status().info && page.host().status().info->columnWires == 30; }));
  EXPECT_TRUE(wait([&] { return find<QLabel>("networkName").text().startsWith("Palp's own"); }));
  EXPECT_TRUE(waitForArrow());
}

TEST_F(LiveOperator, PullingOutAndPluggingInMovesNoButton) {
  ASSERT_TRUE(waitForFrames());
  auto& plug = find<QPushButton>("plug");
  const QPoint place = plug.mapTo(&page, QPoint());
  for (int k = 0; k < 2; ++k) {
    click("plug");
    ASSERT_TRUE(waitForState(LiveState::Searching));
    ASSERT_TRUE(wait([&] { return plug.text() == "Plug in" && !banner().isEmpty(); }));
    EXPECT_EQ(plug.mapTo(&page, QPoint()), place);
    click("plug");
    ASSERT_TRUE(waitForState(LiveState::Streaming));
    ASSERT_TRUE(wait([&] { return plug.text() == "Pull out" && banner().isEmpty(); }));
    EXPECT_EQ(plug.mapTo(&page, QPoint()), place);
  }
}

TEST_F(LiveOperator, PlaysARecordingFromAnyPlaceInALoopAndGoesBackToTheBoard) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  ASSERT_TRUE(records(file, 60));
  ASSERT_TRUE(plays(file));
  auto& line = find<QSlider>("replayLine");
  ASSERT_TRUE(wait([&] { return line.isVisible() && page.host().replay()->length_s > 0; }));
  use([](LiveSettings& live) { live.replaySpeed = 0; });
  ASSERT_TRUE(waitForState(LiveState::Ended));
  EXPECT_TRUE(wait([&] { return find<QLabel>("liveBanner").property("role") == "note"; })) << "its end is no alarm";
  EXPECT_NE(find<QLabel>("liveState").property("role"), "problem");

  use([](LiveSettings& live) { live.replaySpeed = 0.1; });
  const double length_s = page.host().replay()->length_s;
  QTest::mouseClick(&line, Qt::LeftButton, {}, {line.width() / 2, line.height() / 2});
  ASSERT_TRUE(wait([&] { return page.host().status().state == LiveState::Streaming; }));
  ASSERT_TRUE(wait([&] { return page.host().replay()->position_s > 0.4 * length_s; }));
  EXPECT_LT(page.host().replay()->position_s, 0.95 * length_s);

  type<QDoubleSpinBox>("loopTo", QString::number(0.3 * length_s, 'f', 2));
  find<QCheckBox>("replayLoop").click();
  use([](LiveSettings& live) { live.replaySpeed = 2; });
  const std::uint64_t frames = page.host().status().counts.frames;
  ASSERT_TRUE(wait([&] { return page.host().status().counts.frames > frames + 100; })) << "more than it holds";
  EXPECT_LE(page.host().replay()->position_s, 0.35 * length_s + 0.05);
  EXPECT_EQ(page.host().status().counts.lost, 0U) << "what was skipped is no loss";

  click("backToBoard");
  ASSERT_TRUE(wait([&] { return page.host().simulated() && page.host().status().state == LiveState::Streaming; }));
  EXPECT_TRUE(wait([&] { return !line.isVisible(); }));
}

TEST_F(LiveOperator, ReadsNothingWhileNobodyLooksUnlessItRecords) {
  ASSERT_TRUE(waitForFrames());
  const auto reports = [&] {
    page.host().look();
    return page.host().status().counts.reports;
  };
  const auto rests = [&] {
    const std::uint64_t before = reports();
    QTest::qWait(300);
    return reports() == before;
  };
  page.hide();
  EXPECT_TRUE(wait(rests));
  page.show();
  ASSERT_TRUE(waitForFrames());
  recordTo(folder.filePath("touch.palprec"));
  ASSERT_TRUE(startsToRecord());
  page.hide();
  const std::uint64_t before = page.host().status().recordedReports;
  EXPECT_TRUE(wait([&] {
    page.host().look();
    return page.host().status().recordedReports > before + 300;
  }));
}

TEST_F(LiveOperator, ZoomsAndMovesACurveWhileTheLiveOneWaits) {
  ASSERT_TRUE(waitForArrow());
  auto& chart = find<StripChart>("forceCurves");
  const double window_s = chart.chart().window_s;
  wheel(chart, 120);
  EXPECT_TRUE(chart.held());
  EXPECT_LT(chart.chart().window_s, window_s);
  const double end_s = chart.chart().end_s;
  ASSERT_TRUE(waitForFrames());
  EXPECT_EQ(chart.chart().end_s, end_s) << "it runs on under the eyes";
  drag(chart, chart.rect().center(), chart.rect().center() + QPoint(60, 0));
  EXPECT_LT(chart.chart().end_s, end_s);
  const QStringList lines = chart.asCsv().split('\n', Qt::SkipEmptyParts);
  EXPECT_EQ(lines[0], "t_s,\"Fx force [N]\",\"Fy force [N]\",\"Fz force [N]\"");
  EXPECT_GT(lines.size(), 20);
  EXPECT_EQ(lines[1].count(','), 3);
  QTest::mouseDClick(&chart, Qt::LeftButton, {}, chart.rect().center());
  EXPECT_FALSE(chart.held());
  EXPECT_TRUE(wait([&] { return chart.chart().end_s > end_s && chart.chart().window_s == window_s; }));
}

TEST_F(LiveOperator, ScalesTheForceAsOneLikes) {
  ASSERT_TRUE(waitForArrow());
  auto& chart = find<StripChart>("forceCurves");
  auto& scale = find<QComboBox>("forceScale");
  scale.setCurrentIndex(scale.findData(2.0));
  EXPECT_EQ(workbench.project().live.forceScale, ForceScale::Fixed);
  EXPECT_TRUE(wait([&] { return chart.chart().yRange == std::array{-2.0, 2.0}; }));
  scale.setCurrentIndex(scale.findData(-1.0));
  EXPECT_TRUE(wait([&] { return chart.chart().yRange != std::array{-2.0, 2.0}; }));
  double low = 0;
  for (const StripSeries& series : chart.chart().series)
    for (const double y : series.y)
      if (std::isfinite(y)) low = std::min(low, y);
  EXPECT_LE(chart.chart().yRange[0], low);
}

TEST_F(LiveOperator, AnAlarmGoesOffIsSeenAndMarked) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  type<QDoubleSpinBox>("alarmLimit", "-1");
  find<QCheckBox>("alarmOn").click();
  ASSERT_TRUE(wait([&] { return banner().contains("is below -1 N"); }));
  EXPECT_TRUE(wait([&] { return said.join(' ').contains("is below -1 N"); }));
  EXPECT_EQ(find<StripChart>("forceCurves").chart().limits, std::vector<double>{-1});
  ASSERT_TRUE(wait([&] { return banner().isEmpty(); })) << "the touch has gone";
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(wait([&] { return !marksOf(file).empty(); }));
  EXPECT_EQ(marksOf(file)[0].rfind("alarm: Fz", 0), 0U) << marksOf(file)[0];
}

TEST_F(LiveOperator, HoldsATouchWhereOnePressesAndHowOneTypes) {
  ASSERT_TRUE(waitForArrow());
  find<QCheckBox>("touchHeld").click();
  type<QSpinBox>("touchArea", "4");
  type<QDoubleSpinBox>("touch_Fz", "-3");
  const auto reads = [&](int area, double fz_N) {
    return wait([&] {
      const LiveFrame* last = page.host().history().last();
      return last != nullptr && last->forces.valid && last->forces.area == area &&
             std::abs(last->forces.forces_N(2, 0) - fz_N) < 0.05;
    });
  };
  ASSERT_TRUE(reads(4, -3));
  // The arrow is drawn where the area is: a press somewhere else moves the touch there.
  QSignalSpy pressed(&block(), &LiveView::areaPressed);
  for (int x = 1; x < 10 && (pressed.isEmpty() || pressed.back()[0] == 4); ++x)
    QTest::mouseClick(&block(), Qt::LeftButton, {}, {block().width() * x / 10, block().height() * 6 / 10});
  ASSERT_FALSE(pressed.isEmpty());
  const int area = pressed.back()[0].toInt();
  EXPECT_NE(area, 4);
  EXPECT_EQ(find<QSpinBox>("touchArea").value(), area);
  EXPECT_TRUE(reads(area, -3));
  find<QCheckBox>("touchHeld").click();
  EXPECT_TRUE(wait([&] { return page.host().history().last()->forces.area != area; }))
      << "it goes over the areas again";
}

} // namespace
} // namespace palp
