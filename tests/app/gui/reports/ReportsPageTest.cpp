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

} // namespace
} // namespace palp
