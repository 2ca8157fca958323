#include "app/gui/reports/ReportsPage.h"

#include "tests/app/gui/WindowFixture.h"

#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr int kReportPatience_ms = 4 * kPatience_ms;

class ReportsPageTest : public WindowFixture {
protected:
  ReportsPageTest() {
    window.showScene("reports");
    find<QLineEdit>("reportFolder").setText(folder.path());
  }
  void run(const QString& kind) {
    auto& kinds = find<QComboBox>("reportKind");
    kinds.setCurrentIndex(kinds.findText(kind));
    ASSERT_EQ(kinds.currentText(), kind);
    QTest::mouseClick(&find<QPushButton>("runReport"), Qt::LeftButton);
  }
  bool ended() {
    return QTest::qWaitFor([&] { return find<QPushButton>("runReport").isEnabled(); }, kReportPatience_ms);
  }
  QString state() { return find<QLabel>("reportState").text(); }
  QListWidget& pictures() { return find<QListWidget>("reportPictures"); }

  QTemporaryDir folder;
};

TEST_F(ReportsPageTest, RunsAReportOfTheProjectsMeshAndShowsItsPicturesAlone) {
  QFile(folder.filePath("of_another_report.png")).open(QIODevice::WriteOnly);
  settle();
  run("stability");
  EXPECT_TRUE(find<QPlainTextEdit>("reportLog").toPlainText().contains("--per-area 6 --mapped 9x8x2"));
  ASSERT_TRUE(ended());
  EXPECT_TRUE(state().startsWith("Done")) << state().toStdString();
  EXPECT_TRUE(find<QPushButton>("openReport").isEnabled());
  EXPECT_TRUE(QFile::exists(folder.filePath("report.html")));
  ASSERT_EQ(pictures().count(), 1);
  EXPECT_EQ(pictures().item(0)->text(), "spread.png");
  EXPECT_FALSE(find<QLabel>("reportPicture").pixmap().isNull());
}

TEST_F(ReportsPageTest, ACancelledReportSaysSoAndShowsNothingOfAnEarlierOne) {
  Project many = workbench.project();
  many.samples.perArea = 4000; // work for longer than any machine waits before the cancel
  workbench.edit("many", many);
  run("networks");
  ASSERT_TRUE(QTest::qWaitFor([&] { return find<QPushButton>("cancelReport").isEnabled(); }, kPatience_ms));
  QTest::qWait(300); // it computes
  QTest::mouseClick(&find<QPushButton>("cancelReport"), Qt::LeftButton);
  ASSERT_TRUE(ended());
  EXPECT_TRUE(state().startsWith("Cancelled")) << state().toStdString();
  EXPECT_FALSE(pictures().isVisible());
  EXPECT_TRUE(find<QLabel>("reportPicture").pixmap().isNull());
  EXPECT_FALSE(find<QPushButton>("openReport").isEnabled());
  EXPECT_FALSE(QFile::exists(folder.filePath("report.html")));
}

TEST_F(ReportsPageTest, SaysThatTheProgramCannotBeStartedAndLeavesTheWordsThere) {
  static_cast<ReportsPage&>(window.currentScene()).setProgram(folder.filePath("no-palp"));
  run("stability");
  ASSERT_TRUE(ended());
  settle();
  EXPECT_TRUE(state().contains("no-palp cannot be started")) << state().toStdString();
  EXPECT_FALSE(find<QPushButton>("cancelReport").isEnabled());
}

TEST_F(ReportsPageTest, SaysWhichFilesACancelledReportHadWritten) {
  const QString program = folder.filePath("half-palp");
  QFile script(program);
  ASSERT_TRUE(script.open(QIODevice::WriteOnly));
  script.write("#!/bin/sh\nshift $(($# - 2))\ntrap 'exit 130' INT\necho 1 > \"$1/points.csv\"\n"
               "while :; do sleep 0.02; done\n");
  script.close();
  ASSERT_TRUE(script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
  const QTemporaryDir report;
  find<QLineEdit>("reportFolder").setText(report.path());
  QTest::qWait(20); // the script is older than the report
  static_cast<ReportsPage&>(window.currentScene()).setProgram(program);
  run("stability");
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(report.filePath("points.csv")); }, kPatience_ms));
  QTest::mouseClick(&find<QPushButton>("cancelReport"), Qt::LeftButton);
  ASSERT_TRUE(ended());
  EXPECT_TRUE(state().contains("1 of the report's files")) << state().toStdString();
  EXPECT_TRUE(find<QPushButton>("openReportFolder").isEnabled());
}

} // namespace
} // namespace palp
