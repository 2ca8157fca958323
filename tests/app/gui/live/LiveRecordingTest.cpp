// Recordings: made, ended, and played.

#include "app/gui/live/recordings/RecordingName.h"
#include "io/board/RecordingReader.h"
#include "tests/app/gui/FullDisk.h"
#include "tests/app/gui/live/LiveOperatorFixture.h"

#include <QCheckBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QListWidget>
#include <QSignalSpy>
#include <QSlider>

namespace palp {
namespace {

using LiveRecording = LiveOperator;

TEST_F(LiveRecording, ASecondRecordingTakesTheNextFreeNameByItself) {
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

TEST_F(LiveRecording, ThatAFullDiskEndsIsOneNoMoreAndIsSaidInEveryScene) {
  ASSERT_TRUE(waitForFrames());
  recordTo(folder.filePath("touch.palprec"));
  ASSERT_TRUE(startsToRecord());
  {
    const FullDisk full(2000); // of which the head takes a part
    EXPECT_TRUE(wait([&] { return !page.host().recording(); })) << "it says that it records";
  }
  EXPECT_TRUE(wait([&] { return said.join(' ').contains("Nothing is recorded any more: "); }));
  EXPECT_TRUE(isRed("recorded"));
  EXPECT_EQ(find<QPushButton>("record").text(), "Record");
  EXPECT_NE(page.lamp().kind, LiveLampState::Kind::Records);
  page.hide();
  EXPECT_TRUE(wait([&] { return page.lamp().words == "Nothing is recorded any more: touch.palprec"; }))
      << page.lamp().words.toStdString();
  page.show();
  ASSERT_TRUE(startsToRecord()) << "there is room again";
  EXPECT_EQ(page.host().status().recordingFailure, "");
  ASSERT_TRUE(stopsToRecord());
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

TEST_F(LiveRecording, ReplacesTheFileThatTheDialogWasToldTo) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  QFile old(file);
  ASSERT_TRUE(old.open(QIODevice::WriteOnly));
  old.write("an old recording");
  old.close();
  answerFileDialog(file);
  answerQuestion(QMessageBox::Yes);
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

TEST_F(LiveRecording, ItsLengthIsTheSameWhereverItIsSaid) {
  ASSERT_TRUE(waitForFrames());
  recordTo(folder.filePath("touch.palprec"));
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(waitForFrames(20));
  ASSERT_TRUE(stopsToRecord());
  auto& panel = find<QLabel>("recorded");
  ASSERT_TRUE(wait([&] { return panel.text().startsWith("Recorded: "); })) << panel.text().toStdString();
  const QString ended = said.filter("Recorded ").value(0);
  ASSERT_FALSE(ended.isEmpty()) << said.join("; ").toStdString();
  EXPECT_EQ(panel.text().section(' ', 1, 1), ended.section(' ', 1, 1)) << ended.toStdString();
}

TEST_F(LiveRecording, SaysInRedAtTheRecordingWhyNothingIsRecorded) {
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

TEST_F(LiveRecording, PlaysARecordingFromAnyPlaceInALoopAndGoesBackToTheBoard) {
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
  ASSERT_TRUE(waitForState(LiveState::Paused)) << "after its end it stands where one went";
  ASSERT_TRUE(wait([&] { return page.host().replay()->position_s > 0.4 * length_s; }));
  EXPECT_LT(page.host().replay()->position_s, 0.95 * length_s);
  click("replayPause");
  ASSERT_TRUE(waitForState(LiveState::Streaming));

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

TEST_F(LiveRecording, ReadsNothingWhileNobodyLooksUnlessItRecords) {
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

TEST_F(LiveRecording, GoesOnInTheCurvesWhileAnotherSceneIsSeen) {
  ASSERT_TRUE(waitForFrames());
  recordTo(folder.filePath("touch.palprec"));
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(waitForFrames());
  page.hide();
  ASSERT_TRUE(waitForFrames(60)) << "it is not decoded";
  page.show();
  ASSERT_TRUE(waitForFrames());
  ASSERT_TRUE(stopsToRecord());
  const auto& entries = page.host().history().entries();
  for (std::size_t k = 1; k < entries.size(); ++k) EXPECT_FALSE(entries[k].gap) << k;
}

TEST_F(LiveRecording, IsLookedForWhereTheLastOneWasSaved) {
  ASSERT_TRUE(waitForFrames());
  ASSERT_TRUE(records(folder.filePath("touch.palprec"), 5));
  QString begins;
  QTimer look;
  QObject::connect(&look, &QTimer::timeout, &look, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (dialog == nullptr) return;
    begins = dialog->directory().canonicalPath();
    dialog->reject();
  });
  look.start(20);
  ASSERT_TRUE(waitForFrames(20)); // the panel has looked again
  QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  click("openRecording");
  EXPECT_EQ(begins, QDir(folder.path()).canonicalPath());
}

TEST_F(LiveRecording, SaysBeforehandThatTheNextOneGetsAnotherName) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  auto& words = find<QLabel>("recorded");
  EXPECT_TRUE(wait([&] { return words.text() == "Not recording."; }));
  QFile there(file);
  ASSERT_TRUE(there.open(QIODevice::WriteOnly));
  recordTo({});
  recordTo(file);
  EXPECT_TRUE(wait([&] { return words.text().startsWith("touch.palprec exists: the next recording gets date"); }))
      << words.text().toStdString();
}

TEST_F(LiveRecording, TheKeyThatBeginsOneDoesNotEndIt) {
  ASSERT_TRUE(waitForFrames());
  recordTo(folder.filePath("touch.palprec"));
  page.setFocus();
  QTest::keyClick(&page, Qt::Key_R);
  ASSERT_TRUE(wait([&] { return page.host().status().recording; }));
  QTest::keyClick(&page, Qt::Key_R);
  ASSERT_TRUE(waitForFrames(10));
  EXPECT_TRUE(page.host().status().recording);
  EXPECT_TRUE(said.join(' ').contains("Shift+R")) << "nothing was said";
  QTest::keyClick(&page, Qt::Key_R, Qt::ShiftModifier);
  EXPECT_TRUE(wait([&] { return !page.host().status().recording; }));
  EXPECT_TRUE(said.back().startsWith("Recorded ")) << said.back().toStdString();
  EXPECT_TRUE(wait([&] { return find<QLabel>("recorded").text().startsWith("Recorded: "); }));
}

TEST_F(LiveRecording, WaitsForABoardThatIsOutAndSaysSoAndCanBeEnded) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Searching));
  EXPECT_TRUE(wait([&] { return find<QLabel>("recorded").text().startsWith("Waiting for the board"); }));
  EXPECT_EQ(find<QPushButton>("record").text(), "Stop recording");
  EXPECT_TRUE(wait([&] { return find<QLabel>("liveTrust").text() == "none"; })) << "there is nothing to trust";
  const double before_s = page.host().recorded_s();
  EXPECT_GT(before_s, 0);
  QSignalSpy looked(&page, &LivePage::looked);
  ASSERT_TRUE(wait([&] { return looked.count() >= 5; }));
  EXPECT_EQ(page.host().recorded_s(), before_s) << "a board that is out is not recorded";
  click("plug");
  ASSERT_TRUE(wait([&] { return page.host().status().recording; }));
  EXPECT_TRUE(wait([&] { return page.host().recorded_s() > before_s; }));
  EXPECT_TRUE(wait([&] { return find<QLabel>("recorded").text().startsWith("Recording: "); }));
  click("plug");
  ASSERT_TRUE(wait([&] { return page.host().status().recordingWaits; }));
  click("record");
  EXPECT_TRUE(wait([&] { return !page.host().recording(); }));
  EXPECT_TRUE(wait([&] { return find<QPushButton>("record").text() == "Record"; }));
  const std::vector<std::string> marks{"the board is disconnected", "the board is connected again",
                                       "the board is disconnected"};
  EXPECT_TRUE(wait([&] { return marksOf(file) == marks; })) << marksOf(file).size();
}

TEST_F(LiveRecording, AnotherSourceEndsItOnlyWhereThatIsSaid) {
  ASSERT_TRUE(waitForFrames());
  recordTo(folder.filePath("touch.palprec"));
  ASSERT_TRUE(startsToRecord());
  auto& list = find<QListWidget>("devices");
  const auto choose = [&] {
    QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.item(1)).center());
  };
  answerQuestion(QMessageBox::No);
  choose();
  EXPECT_EQ(workbench.project().live.source, LiveSourceKind::Automatic);
  EXPECT_TRUE(page.host().status().recording);
  EXPECT_TRUE(wait([&] { return list.currentRow() == 0; })) << "the line in use is the chosen one";
  answerQuestion(QMessageBox::Yes);
  choose();
  EXPECT_EQ(workbench.project().live.source, LiveSourceKind::Simulated);
  EXPECT_TRUE(wait([&] { return !page.host().recording(); }));
  EXPECT_TRUE(said.join(' ').contains("Recorded "));
}

TEST_F(LiveRecording, IsEndedByNoDoorWithoutAQuestion) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  const LossQuestion& question = workbench.lossQuestion();
  Project next = workbench.project();
  EXPECT_TRUE(question.losses({Leaving::Way::OtherProject, &next}).isEmpty()) << "it goes on with the same source";
  EXPECT_TRUE(question.losses({Leaving::Way::Quit}).join(' ').contains(file));
  next.live.simulation.seed += 1; // another sensor
  EXPECT_TRUE(question.losses({Leaving::Way::OtherProject, &next}).join(' ').contains(file));
  answerQuestion(QMessageBox::No);
  workbench.edit("another sensor", next);
  EXPECT_NE(workbench.project().live.simulation.seed, next.live.simulation.seed);
  EXPECT_TRUE(page.host().recording());
  answerQuestion(QMessageBox::Yes);
  workbench.edit("another sensor", next);
  EXPECT_EQ(workbench.project().live.simulation.seed, next.live.simulation.seed);
  EXPECT_TRUE(wait([&] { return !page.host().recording(); }));
}

} // namespace
} // namespace palp
