#include "app/gui/jobs/ExportJob.h"
#include "model/base/Cancelled.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAction>
#include <QDir>
#include <QFile>
#include <QImage>
#include <QMenuBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace palp {
namespace {

QByteArray contentOf(const QString& file) {
  QFile in(file);
  return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
}

TEST(ExportJobs, AStopLeavesTheFileThatWasThereAndNothingBeside) {
  const QTemporaryDir folder;
  const QString file = folder.filePath("deck.inp");
  QFile before(file);
  ASSERT_TRUE(before.open(QIODevice::WriteOnly));
  before.write("before");
  before.close();
  ExportJob job;
  QSignalSpy done(&job, &ExportJob::done);
  std::atomic<bool> begun = false;
  job.write(file, [&begun](const std::stop_token& stop) -> std::string {
    begun = true;
    while (!stop.stop_requested()) std::this_thread::yield();
    throw Cancelled();
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return begun.load(); }, kPatience_ms));
  job.runner().cancel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !job.runner().running(); }, kPatience_ms));
  EXPECT_EQ(contentOf(file), "before");
  EXPECT_EQ(QDir(folder.path()).entryList(QDir::Files).size(), 1);
  EXPECT_EQ(done.count(), 0);
}

class Exporting : public WindowFixture {
protected:
  void trigger(const QString& begin) {
    for (QAction* menu : window.menuBar()->actions())
      for (QAction* action : menu->menu()->actions())
        if (action->text().remove('&').startsWith(begin)) return action->trigger();
    FAIL() << begin.toStdString();
  }
  bool written(const QString& file) {
    return QTest::qWaitFor([&] { return QFile::exists(file) && !window.busy(); }, kPatience_ms);
  }
  QTemporaryDir folder;
};

TEST_F(Exporting, AVtuGetsItsEndingAndTheKeptDesignsFieldsWhereTheyAreShown) {
  ASSERT_TRUE(solved());
  answerFileDialog(folder.filePath("shown"));
  trigger("Export VTU");
  ASSERT_TRUE(written(folder.filePath("shown.vtu")));
  EXPECT_TRUE(contentOf(folder.filePath("shown.vtu")).contains("displacement_mm"));
  EXPECT_FALSE(contentOf(folder.filePath("shown.vtu")).contains("kept_displacement_mm"));
  Project next = workbench.project();
  next.kept = next.design;
  next.kept->material.c10_MPa *= 0.5;
  next.view.lessKept = true;
  workbench.edit("keep", next);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.keptPath() != nullptr && !window.busy(); }, kPatience_ms));
  answerFileDialog(folder.filePath("both"));
  trigger("Export VTU");
  ASSERT_TRUE(written(folder.filePath("both.vtu")));
  EXPECT_TRUE(contentOf(folder.filePath("both.vtu")).contains("kept_displacement_mm"));
}

TEST_F(Exporting, ACalculixDeckIsWrittenWholeBesideTheWindow) {
  ASSERT_TRUE(solved());
  answerFileDialog(folder.filePath("touch"));
  trigger("Export CalculiX deck");
  ASSERT_TRUE(written(folder.filePath("touch.inp")));
  const QByteArray deck = contentOf(folder.filePath("touch.inp"));
  EXPECT_TRUE(deck.startsWith("*HEADING"));
  EXPECT_TRUE(deck.trimmed().endsWith("*END STEP"));
}

TEST_F(Exporting, ATablesNameGetsItsEnding) {
  ASSERT_TRUE(solved());
  answerFileDialog(folder.filePath("table"));
  trigger("Export electrodes");
  EXPECT_TRUE(QFile::exists(folder.filePath("table.csv")));
  EXPECT_FALSE(QFile::exists(folder.filePath("table")));
}

TEST_F(Exporting, AFilmMakesItsFolder) {
  ASSERT_TRUE(solved());
  answerFileDialog(folder.filePath("film"));
  trigger("Film of the load path");
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(folder.filePath("film/load-000.png")); }, kPatience_ms));
  QTest::keyClick(&window, Qt::Key_Escape);
  EXPECT_TRUE(idle());
}

TEST_F(Exporting, EveryChartAndTableOfTheSceneGoesIntoANewFolderAtOnce) {
  window.showScene("network");
  ASSERT_TRUE(solved());
  QTest::mouseClick(window.findChild<QPushButton*>("generate"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr && !window.busy(); }, kPatience_ms));
  QTest::mouseClick(window.findChild<QPushButton*>("train"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr && !window.busy(); }, kPatience_ms));
  QTest::mouseClick(window.findChild<QPushButton*>("sweep"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sweepPoints().size() == 3 && !window.busy(); }, kPatience_ms));
  const QDir charts(folder.filePath("charts"));
  answerFileDialog(charts.path());
  QTest::keyClick(&window, Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.statusBar()->currentMessage().startsWith("Wrote"); }, kPatience_ms))
      << window.statusBar()->currentMessage().toStdString();
  const QStringList files = charts.entryList(QDir::Files);
  for (const char* file : {"sweepError.png", "sweepError.csv", "leaveOneOut.png", "decoupledFx.png", "decoupledFz.csv",
                           "relativeError.csv", "sweep.csv", "networks.csv"})
    EXPECT_TRUE(files.contains(file)) << file << " among " << files.join(' ').toStdString();
  EXPECT_FALSE(files.contains("trialsError.png")) << "nothing was compared";
  EXPECT_EQ(contentOf(charts.filePath("sweep.csv")).count('\n'), 4);
  EXPECT_TRUE(contentOf(charts.filePath("sweepError.csv")).contains(",5.18") ||
              contentOf(charts.filePath("sweepError.csv")).contains(",0.16"))
      << "numbers as they are printed";
  EXPECT_GT(QImage(charts.filePath("decoupledFx.png")).width(), 600) << "of a tab that was never seen";
}

} // namespace
} // namespace palp
