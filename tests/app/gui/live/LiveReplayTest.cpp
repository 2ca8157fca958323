// Recordings played: any place, frame by frame, loops and marks.

#include "app/gui/views/StripChart.h"
#include "io/board/RecordingReader.h"
#include "tests/app/gui/WindowFixture.h"
#include "tests/app/gui/live/LiveOperatorFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>

namespace palp {
namespace {

/// A recording that is played, 60 frames long.
class LiveReplay : public LiveOperator {
protected:
  bool played() {
    return waitForFrames() && records(folder.filePath("touch.palprec"), 60) &&
           plays(folder.filePath("touch.palprec")) && wait([&] { return page.host().replay()->length_s > 0; });
  }
  bool held() {
    if (!page.host().paused()) click("replayPause");
    return waitForState(LiveState::Paused);
  }
  const LiveFrame* last() { return page.host().history().last(); }
  double span_s() {
    const auto& entries = page.host().history().entries();
    return entries.empty() ? 0 : entries.back().t_s - entries.front().t_s;
  }
};

TEST_F(LiveReplay, AfterAJumpTheCurvesHoldThePastOfThatPlace) {
  ASSERT_TRUE(played());
  ASSERT_TRUE(held());
  const double length_s = page.host().replay()->length_s;
  const auto begin_s = [&] { return page.host().history().entries().front().frame->frame.hostTime_s; };
  for (const double share : {0.9, 0.4}) { // forth and back
    const auto jumps = last() == nullptr ? 0 : last()->jumps;
    type<QDoubleSpinBox>("replayPlace", QString::number(share * length_s, 'f', 2));
    ASSERT_TRUE(wait([&] { return last() != nullptr && last()->jumps > jumps; }));
    EXPECT_LT(begin_s() - page.host().replay()->begin_s, 0.1) << "all of what came before";
    EXPECT_GT(span_s(), 0.8 * share * length_s);
    EXPECT_NEAR(last()->frame.hostTime_s - page.host().replay()->begin_s, share * length_s, 0.1);
    ASSERT_TRUE(wait([&] { return find<StripChart>("forceCurves").chart().series.size() == 3; }));
    EXPECT_EQ(page.host().status().counts.lost, 0U);
  }
  const auto number = last()->frame.number;
  click("replayBack");
  ASSERT_TRUE(wait([&] { return last()->frame.number == number - 1; }));
  EXPECT_LT(begin_s() - page.host().replay()->begin_s, 0.1) << "a frame back too";
}

TEST_F(LiveReplay, AllOfItIsExportedWhateverTheCurvesHold) {
  ASSERT_TRUE(played());
  ASSERT_TRUE(held());
  type<QDoubleSpinBox>("replayPlace", "0");
  const QString file = folder.filePath("touch.csv");
  answerFileDialog(file);
  click("exportLive");
  ASSERT_TRUE(wait([&] { return QFile::exists(file); }));
  QFile table(file);
  ASSERT_TRUE(table.open(QIODevice::ReadOnly));
  QStringList lines = QString::fromUtf8(table.readAll()).split('\n', Qt::SkipEmptyParts);
  lines.removeIf([](const QString& line) { return line.startsWith('#'); });
  EXPECT_TRUE(lines.front().startsWith("device_s,host_unix_s,frame,valid,area,fx_N,fy_N,fz_N,sd_fx_N,"))
      << lines.front().left(200).toStdString();
  EXPECT_GE(lines.size(), 60) << "every frame that was recorded";
  EXPECT_TRUE(QFile::exists(file) && page.host().paused()) << "what is seen stays as it is";
}

TEST_F(LiveReplay, InALoopTheCurvesHoldOnlyWhatWasPlayedSinceItsBegin) {
  ASSERT_TRUE(played());
  const double length_s = page.host().replay()->length_s;
  ASSERT_TRUE(wait([&] { return span_s() > 0.5 * length_s; })) << "the curves follow what is played look by look";
  type<QDoubleSpinBox>("loopTo", QString::number(0.3 * length_s, 'f', 2));
  find<QCheckBox>("replayLoop").click();
  const std::uint64_t frames = page.host().status().counts.frames;
  ASSERT_TRUE(wait([&] { return page.host().status().counts.frames > frames + 60; })) << "several turns of the loop";
  ASSERT_TRUE(wait([&] { return page.host().history().entries().size() > 5; }));
  EXPECT_LE(span_s(), 0.3 * length_s + 0.05);
  const auto& entries = page.host().history().entries();
  for (std::size_t k = 1; k < entries.size(); ++k)
    EXPECT_GT(entries[k].frame->frame.hostTime_s, entries[k - 1].frame->frame.hostTime_s) << "of two turns";
}

TEST_F(LiveReplay, GoesToAnyTimeThatIsTypedWithoutAFalseAlarm) {
  ASSERT_TRUE(played());
  ASSERT_TRUE(held());
  const double length_s = page.host().replay()->length_s;
  std::uint64_t jumps = 0;
  for (const double share : {0.51, 0.23, 0.377, 0.8}) {
    const double to_s = share * length_s;
    ++jumps;
    type<QDoubleSpinBox>("replayPlace", QString::number(to_s, 'f', 2));
    ASSERT_TRUE(wait([&] { return last() != nullptr && last()->jumps == jumps; })) << to_s;
    EXPECT_FALSE(last()->past) << "the place itself is shown";
    EXPECT_NEAR(page.host().replay()->position_s, to_s, 0.1);
    EXPECT_TRUE(last()->frame.complete) << to_s;
    EXPECT_TRUE(last()->faults.empty()) << last()->faults[0];
    EXPECT_TRUE(last()->forces.valid) << last()->forces.reason;
  }
  EXPECT_EQ(page.host().status().counts.incompleteFrames, 0U);
}

TEST_F(LiveReplay, TakesATimeThatIsTypedOverTheWholeBoxWhileItPlays) {
  ASSERT_TRUE(played());
  const double length_s = page.host().replay()->length_s;
  find<QCheckBox>("replayLoop").click(); // it plays on and on
  auto& box = find<QDoubleSpinBox>("replayPlace");
  auto& typed = *box.findChild<QLineEdit*>();
  for (int time = 0; time < 2; ++time) {
    const auto jumps = [&] { return last() == nullptr ? 0 : last()->jumps; };
    ASSERT_TRUE(wait([&] { return page.host().replay()->position_s > 0.5 * length_s; }));
    const double shown_s = box.value();
    QTest::mouseDClick(&typed, Qt::LeftButton);
    typed.selectAll(); // as a third click does
    ASSERT_TRUE(wait([&] { return std::abs(page.host().replay()->position_s - shown_s) > 0.05 * length_s; }));
    const auto before = jumps();
    QTest::keyClicks(&typed, QString::number(0.1 * length_s, 'f', 2));
    QTest::keyClick(&typed, Qt::Key_Return);
    EXPECT_NEAR(box.value(), 0.1 * length_s, 0.01);
    EXPECT_TRUE(wait([&] { return jumps() > before; }));
    EXPECT_TRUE(wait([&] { return box.value() > 0.3 * length_s; })) << "the box follows again";
  }
}

TEST_F(LiveReplay, GoesBackByOneFrame) {
  ASSERT_TRUE(played());
  ASSERT_TRUE(held());
  type<QDoubleSpinBox>("replayPlace", QString::number(0.5 * page.host().replay()->length_s, 'f', 2));
  ASSERT_TRUE(wait([&] { return last() != nullptr && last()->jumps == 1; })) << "more than one may be held before";
  for (int k = 0; k < 3; ++k) {
    const auto number = last()->frame.number;
    click("replayBack");
    EXPECT_TRUE(wait([&] { return last() != nullptr && last()->frame.number == number - 1; }))
        << number << " " << last()->frame.number;
  }
}

TEST_F(LiveReplay, AMarkOutsideOfTheLoopEndsTheLoopAndIsGoneTo) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(waitForFrames(40));
  QTest::keyClicks(&find<QLineEdit>("markText"), "poke");
  click("mark");
  ASSERT_TRUE(waitForFrames(20));
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(plays(file));
  auto& marks = find<QComboBox>("replayMarks");
  ASSERT_TRUE(wait([&] { return marks.count() == 2; }));
  const double mark_s = marks.itemData(1).toDouble();
  type<QDoubleSpinBox>("loopTo", QString::number(0.4 * mark_s, 'f', 2));
  auto& loop = find<QCheckBox>("replayLoop");
  loop.click();
  ASSERT_TRUE(loop.isChecked());
  marks.setFocus();
  QTest::keyClick(&marks, Qt::Key_Down);
  EXPECT_FALSE(loop.isChecked());
  EXPECT_FALSE(page.host().replay()->loop);
  EXPECT_TRUE(said.join(' ').contains("The loop is off")) << said.join("; ").toStdString();
  EXPECT_TRUE(wait([&] { return last() != nullptr && page.host().replay()->position_s >= mark_s; }));
}

TEST_F(LiveReplay, DrawsTheLineOfTheMarkThatOneWentTo) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(waitForFrames(20));
  QTest::keyClicks(&find<QLineEdit>("markText"), "poke");
  click("mark");
  ASSERT_TRUE(waitForFrames(20));
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(plays(file));
  ASSERT_TRUE(waitForState(LiveState::Ended));
  auto& marks = find<QComboBox>("replayMarks");
  ASSERT_TRUE(wait([&] { return marks.count() == 2; }));
  const auto lines = [&] { return find<StripChart>("forceCurves").chart().marks; };
  marks.setFocus();
  QTest::keyClick(&marks, Qt::Key_Down);
  EXPECT_TRUE(
      wait([&] { return page.host().history().last() != nullptr && page.host().history().last()->jumps == 1; }));
  EXPECT_TRUE(wait([&] { return lines().size() == 1 && lines()[0].second == "poke"; }));
  ASSERT_TRUE(waitForState(LiveState::Paused)) << "it stands there";
  type<QDoubleSpinBox>("replayPlace", QString::number(marks.itemData(1).toDouble() + 0.1, 'f', 2));
  EXPECT_TRUE(wait([&] { return page.host().history().last()->jumps == 2; }));
  EXPECT_TRUE(wait([&] { return lines().size() == 1; })) << "it stands in the past that is shown";
}

TEST_F(LiveReplay, CountsItsTimeFromItsFirstReport) {
  ASSERT_TRUE(played());
  ASSERT_TRUE(held());
  auto& chart = find<StripChart>("forceCurves");
  ASSERT_TRUE(wait([&] { return chart.chart().zero_s == page.host().replay()->begin_s.load(); }));
  const double length_s = page.host().replay()->length_s;
  type<QDoubleSpinBox>("replayPlace", QString::number(0.5 * length_s, 'f', 2));
  ASSERT_TRUE(wait([&] { return last() != nullptr && last()->jumps == 1 && !chart.chart().series.empty(); }));
  // The frame at that place, however far apart a busy machine recorded them: within the recording's own time.
  const auto& shown = page.host().history().entries();
  EXPECT_TRUE(wait([&] { return !shown.empty() && chart.chart().end_s == shown.back().t_s; }));
  const double shown_s = chart.chart().end_s - chart.chart().zero_s.value_or(0);
  EXPECT_TRUE(shown_s > 0 && shown_s < length_s) << shown_s << " of " << length_s;
  click("backToBoard");
  EXPECT_TRUE(wait([&] { return !chart.chart().zero_s; })) << "a board's time counts back from now";
}

TEST_F(LiveReplay, SaysThatTheReplayStandsAndNotTheBoard) {
  ASSERT_TRUE(played());
  ASSERT_TRUE(held());
  EXPECT_TRUE(wait([&] { return page.lamp().words.startsWith("Replay paused: recording touch.palprec"); }))
      << page.lamp().words.toStdString();
  click("replayPause");
  ASSERT_TRUE(waitForState(LiveState::Ended));
  EXPECT_TRUE(page.lamp().words.startsWith("Replay ended: recording touch.palprec")) << page.lamp().words.toStdString();
  click("replayBack");
  EXPECT_TRUE(waitForState(LiveState::Paused)) << "the end can be stepped back from";
}

TEST_F(LiveReplay, DrawsAMarkThatIsSetAndSaysThatARecordingIsACopy) {
  ASSERT_TRUE(played());
  find<QCheckBox>("replayLoop").click(); // it plays on and on
  ASSERT_TRUE(waitForState(LiveState::Streaming));
  EXPECT_TRUE(wait([&] { return find<QPushButton>("record").text() == "Record what is played"; }));
  const QString copy = folder.filePath("copy.palprec");
  recordTo(copy);
  ASSERT_TRUE(startsToRecord()) << said.join("; ").toStdString();
  EXPECT_TRUE(said.join(' ').contains("Recording what is played")) << said.join("; ").toStdString();
  ASSERT_TRUE(held());
  const auto jumps = last() == nullptr ? 0 : last()->jumps;
  type<QDoubleSpinBox>("replayPlace", "0.1");
  ASSERT_TRUE(wait([&] { return last() != nullptr && last()->jumps > jumps; }));
  QTest::keyClicks(&find<QLineEdit>("markText"), "here");
  click("mark");
  const auto lines = [&] { return find<StripChart>("forceCurves").chart().marks; };
  EXPECT_TRUE(wait([&] {
    page.host().step(1);
    return lines().size() == 1 && lines()[0].second == "here";
  })) << "from the next frame on";
  const double begin_s = page.host().replay()->begin_s, length_s = page.host().replay()->length_s;
  ASSERT_TRUE(stopsToRecord());
  RecordingReader reader(copy.toStdString());
  bool marked = false;
  while (const auto entry = reader.next()) {
    if (entry->kind != RecordingEntry::Kind::Mark) continue;
    marked = true;
    EXPECT_GE(entry->hostTime_s, begin_s);
    EXPECT_LE(entry->hostTime_s, begin_s + length_s);
  }
  EXPECT_TRUE(marked);
}

TEST_F(LiveReplay, LeadsToItsMarks) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(waitForFrames(20));
  QTest::keyClicks(&find<QLineEdit>("markText"), "poke");
  click("mark");
  ASSERT_TRUE(waitForFrames(20));
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(plays(file));
  auto& marks = find<QComboBox>("replayMarks");
  ASSERT_TRUE(wait([&] { return marks.count() == 2; })) << "one mark and the head";
  EXPECT_TRUE(marks.itemText(1).endsWith(" s: poke")) << marks.itemText(1).toStdString();
  ASSERT_TRUE(waitForState(LiveState::Ended));
  const double at_s = marks.itemData(1).toDouble();
  EXPECT_GT(at_s, 0.1 * page.host().replay()->length_s);
  EXPECT_LT(at_s, 0.9 * page.host().replay()->length_s);
  marks.setFocus();
  QTest::keyClick(&marks, Qt::Key_Down);
  EXPECT_TRUE(wait([&] { return last() != nullptr && last()->jumps == 1; })) << "it may have ended again";
  EXPECT_TRUE(wait([&] { return last()->mark == "poke"; }));
}

} // namespace
} // namespace palp
