// Forces for other programs: switched on and off by clicks, counted, kept in the project.

#include "app/gui/live/send/SendPanel.h"
#include "app/gui/project/ProjectFile.h"
#include "tests/app/gui/live/LiveOperatorFixture.h"

#include <QFile>
#include <QStyle>
#include <QStyleOptionViewItem>
#include <QToolButton>
#include <QTreeWidget>

namespace palp {
namespace {

class LiveSend : public LiveOperator {
protected:
  LiveSend() { QTest::mouseClick(&find<QToolButton>("sendForces"), Qt::LeftButton); }
  QTreeWidget& list() { return find<QTreeWidget>("receivers"); }
  QString sent() { return list().topLevelItem(0)->text(1); }
  void add(const QString& address) {
    QTest::keyClicks(&find<QLineEdit>("receiver"), address);
    click("addReceiver");
  }
  /// A click on the tick of a line.
  void tick(int line) {
    const QRect place = list().visualItemRect(list().topLevelItem(line));
    QStyleOptionViewItem option;
    option.rect = place;
    option.features = QStyleOptionViewItem::HasCheckIndicator | QStyleOptionViewItem::HasDisplay;
    option.widget = &list();
    const QRect box = list().style()->subElementRect(QStyle::SE_ItemViewItemCheckIndicator, &option, &list());
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, box.center());
  }
  QByteArray content(const QString& file) {
    QFile in(file);
    return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
  }
};

TEST_F(LiveSend, AReceiverGetsTheFramesUntilItIsSwitchedOffAndIsKeptInTheProject) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("forces.csv");
  add("csv:" + file);
  ASSERT_EQ(workbench.project().live.receivers, (std::vector<LiveReceiver>{{"csv:" + file.toStdString(), true}}));
  ASSERT_TRUE(wait([&] { return sent().toInt() > 5; })) << sent().toStdString();
  EXPECT_EQ(list().topLevelItem(0)->text(2), "0") << "none is dropped";
  EXPECT_TRUE(wait([&] { return content(file).count('\n') > 5; }));
  EXPECT_TRUE(find<QToolButton>("sendForces").text().contains("1 on"));
  EXPECT_TRUE(page.commands(workbench.project(), {}).contains("--send 'csv:"));

  const Project again = parseProject(projectText(workbench.project()), "project.json", exampleProject());
  EXPECT_EQ(again.live.receivers, (std::vector<LiveReceiver>{{"csv:" + file.toStdString(), false, true}}))
      << "a file that is read waits for a tick";
  EXPECT_EQ(projectText(again), projectText(workbench.project()));

  tick(0);
  ASSERT_FALSE(workbench.project().live.receivers[0].on);
  ASSERT_TRUE(wait([&] { return sent() == "off"; }));
  ASSERT_TRUE(wait([&] { return page.host().sendingSettled(); }));
  const auto lines = content(file).count('\n');
  ASSERT_TRUE(waitForFrames(10));
  EXPECT_EQ(content(file).count('\n'), lines) << "it goes on though it is off";
  EXPECT_FALSE(page.commands(workbench.project(), {}).contains("--send"));

  tick(0); // what was sent before stays: the frames go into a file beside it
  ASSERT_TRUE(wait([&] { return sent().toInt() > 5; })) << sent().toStdString();
  EXPECT_TRUE(list().topLevelItem(0)->text(0).contains("forces-20")) << list().topLevelItem(0)->text(0).toStdString();
  EXPECT_EQ(content(file).count('\n'), lines);
  EXPECT_EQ(workbench.project().live.receivers[0].to, "csv:" + file.toStdString());

  list().setCurrentItem(list().topLevelItem(0));
  click("removeReceiver");
  EXPECT_TRUE(workbench.project().live.receivers.empty());
  EXPECT_EQ(list().topLevelItemCount(), 0);
}

TEST_F(LiveSend, WhatCannotBeOpenedIsSaidInRedAndTheOthersGoOn) {
  ASSERT_TRUE(waitForFrames());
  add("udp:localhost:9870"); // nobody is there: what it is given is dropped
  const auto given = [&] { return sent().toInt() + list().topLevelItem(0)->text(2).toInt(); };
  ASSERT_TRUE(wait([&] { return given() > 3; })) << given();
  add("tcp:localhost:1");
  ASSERT_TRUE(wait([&] { return list().topLevelItemCount() == 2 && list().topLevelItem(1)->text(1) == "refused"; }));
  EXPECT_TRUE(isRed("sendProblem"));
  EXPECT_TRUE(find<QLabel>("sendProblem").text().contains("tcp:localhost:1"))
      << find<QLabel>("sendProblem").text().toStdString();
  EXPECT_FALSE(find<QLabel>("sendProblem").text().contains("--send")) << "a window has no options";
  const int before = given();
  EXPECT_TRUE(wait([&] { return given() > before; }));
  add("udp:localhost:9870"); // again
  EXPECT_EQ(workbench.project().live.receivers.size(), 2U) << "an address stands once";
  add("127.0.0.1:9871");
  EXPECT_EQ(workbench.project().live.receivers.back().to, "udp:127.0.0.1:9871") << "host and port alone go by UDP";
}

TEST_F(LiveSend, WhatAProjectOfSomebodySendsElsewhereWaitsForATick) {
  Project mailed = workbench.project();
  mailed.live.receivers = {{"udp:192.0.2.7:9870", true}, {"udp:localhost:9871", true}, {"osc:192.0.2.8:9", false}};
  const Project opened = parseProject(projectText(mailed), "mailed.json", exampleProject());
  EXPECT_EQ(opened.live.receivers,
            (std::vector<LiveReceiver>{
                {"udp:192.0.2.7:9870", false, true}, {"udp:localhost:9871", true}, {"osc:192.0.2.8:9", false}}));
  workbench.edit("opened", opened);
  ASSERT_TRUE(waitForFrames());
  ASSERT_TRUE(wait([&] { return list().topLevelItemCount() == 3 && sent() == "off"; }));
  const QLabel& question = find<QLabel>("sendProblem");
  ASSERT_TRUE(wait([&] { return question.text().contains("udp:192.0.2.7:9870"); })) << question.text().toStdString();
  EXPECT_FALSE(question.text().contains("192.0.2.8"));
  EXPECT_TRUE(list().isVisible());
  tick(0);
  EXPECT_EQ(workbench.project().live.receivers.front(), (LiveReceiver{"udp:192.0.2.7:9870", true}));
  EXPECT_TRUE(wait([&] { return !question.text().contains("This project sends"); }));
}

TEST_F(LiveSend, GoesOnOutOfSight) {
  ASSERT_TRUE(waitForFrames());
  add("csv:" + folder.filePath("forces.csv"));
  ASSERT_TRUE(wait([&] { return sent().toInt() > 3; }));
  page.hide();
  const std::uint64_t before = page.host().sending()[0].sent;
  EXPECT_TRUE(wait([&] { return page.host().sending()[0].sent > before + 20; }));
}

} // namespace
} // namespace palp
