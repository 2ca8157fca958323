#include "app/gui/window/LogFile.h"

#include "app/gui/window/MessageLog.h"
#include "tests/app/gui/FullDisk.h"
#include "tests/app/gui/WindowFixture.h"

#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QRegularExpression>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <thread>

namespace palp {
namespace {

QStringList linesInFile(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  return QString::fromUtf8(file.readAll()).split('\n', Qt::SkipEmptyParts);
}

class LogFiles : public WindowFixture {
protected:
  QTemporaryDir folder;
};

TEST_F(LogFiles, HaveEveryMessageOfTheWindowWithDateAndTime) {
  LogFile log(folder.filePath("palp/log"));
  window.findChild<MessageLog*>()->keepIn(log);
  window.showMessage("Wrote a.csv.");
  window.showMessage("Two lines,\nof which the file has one.");
  const QStringList lines = linesInFile(log.path());
  ASSERT_EQ(lines.size(), 2);
  EXPECT_TRUE(QRegularExpression(R"(^\d{4}-\d\d-\d\d \d\d:\d\d:\d\d  Wrote a\.csv\.$)").match(lines[0]).hasMatch())
      << lines[0].toStdString();
  EXPECT_TRUE(lines[1].endsWith("Two lines, of which the file has one."));
  EXPECT_TRUE(find<QLineEdit>("logFile").text().contains(log.path()));
}

TEST_F(LogFiles, HaveQtsWarningsFromAnyThread) {
  {
    LogFile log(folder.path());
    log.takeQtMessages();
    std::thread([] { qWarning("a warning of %d", 7); }).join();
    EXPECT_TRUE(linesInFile(log.path()).value(0).endsWith("Qt: a warning of 7"));
  }
  qWarning("said when the log has gone");
  EXPECT_EQ(linesInFile(folder.filePath("palp-studio.log")).size(), 1);
}

TEST_F(LogFiles, StayBelowTwoMegabytes) {
  LogFile log(folder.path());
  const QString sentence(1000, 'x');
  for (int k = 0; k < 2500; ++k) log.add(QString::number(k) + sentence);
  EXPECT_LT(QFile(log.path()).size(), 1100000);
  EXPECT_LT(QFile(log.path() + ".1").size(), 1100000);
  EXPECT_EQ(QDir(folder.path()).entryList(QDir::Files).size(), 2);
  EXPECT_TRUE(linesInFile(log.path()).last().contains("2499x"));
}

TEST_F(LogFiles, OfAHomeThatCannotBeWrittenAreSaidOnceAndTheWindowGoesOn) {
  QFile inTheWay(folder.filePath("file"));
  ASSERT_TRUE(inTheWay.open(QIODevice::WriteOnly));
  LogFile log(folder.filePath("file/log")); // also as root, whom no mode stops
  QSignalSpy failures(&log, &LogFile::failed);
  window.findChild<MessageLog*>()->keepIn(log);
  window.showMessage("Wrote a.csv.");
  window.showMessage("Wrote b.csv.");
  ASSERT_TRUE(QTest::qWaitFor([&] { return failures.count() > 0; }, kPatience_ms));
  QTest::qWait(1);
  EXPECT_EQ(failures.count(), 1);
  EXPECT_TRUE(find<QLineEdit>("logFile").text().contains("cannot be written"));
}

TEST_F(LogFiles, OfAFullDiskAreSaidOnce) {
  LogFile log(folder.path());
  QSignalSpy failures(&log, &LogFile::failed);
  {
    const FullDisk full(10);
    log.add("a sentence of more than ten letters");
    log.add("another");
  }
  ASSERT_TRUE(QTest::qWaitFor([&] { return failures.count() > 0; }, kPatience_ms));
  QTest::qWait(1);
  EXPECT_EQ(failures.count(), 1);
}

} // namespace
} // namespace palp
