#include "app/gui/jobs/ExportJob.h"
#include "app/gui/touch/LoadPathAnimation.h"
#include "app/gui/views/BlockView.h"
#include "model/base/Cancelled.h"
#include "tests/app/gui/FullDisk.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAction>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QImage>
#include <QImageReader>
#include <QMenuBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
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

/// Answers the next question about a film, as a user would.
void answerFilmDialog(bool gif, int pictures, double seconds) {
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [=] {
    QWidget* dialog = QApplication::activeModalWidget();
    if (dialog == nullptr || dialog->objectName() != "film") return;
    timer->stop();
    timer->deleteLater();
    dialog->findChild<QComboBox*>("filmKind")->setCurrentIndex(gif ? 0 : 1);
    dialog->findChild<QSpinBox*>("filmPictures")->setValue(pictures);
    dialog->findChild<QSpinBox*>("filmWidth")->setValue(320);
    dialog->findChild<QDoubleSpinBox*>("filmSeconds")->setValue(seconds);
    QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok), Qt::LeftButton);
  });
  timer->start(20);
}

TEST_F(Exporting, AFilmIsAnAnimatedGifOfTheChosenLength) {
  ASSERT_TRUE(solved());
  answerFilmDialog(true, 5, 2);
  answerFileDialog(folder.filePath("touch"));
  trigger("Film of the load path");
  const QString file = folder.filePath("touch.gif");
  ASSERT_TRUE(written(file));
  QImageReader reader(file); // Qt's own reader
  ASSERT_TRUE(reader.supportsAnimation());
  EXPECT_EQ(reader.imageCount(), 5);
  EXPECT_EQ(reader.loopCount(), -1) << "for ever";
  QImage first, last;
  int time_ms = 0;
  for (int k = 0; k < 5; ++k) {
    last = reader.read();
    if (k == 0) first = last.copy();
    time_ms += reader.nextImageDelay();
  }
  EXPECT_EQ(first.width(), 320);
  EXPECT_NE(first, last);
  EXPECT_EQ(time_ms, 2000);
}

TEST_F(Exporting, AFilmThatIsStoppedLeavesNothing) {
  ASSERT_TRUE(solved());
  for (const bool gif : {true, false}) {
    answerFilmDialog(gif, 500, 100);
    answerFileDialog(folder.filePath("film"));
    trigger("Film of the load path");
    ASSERT_TRUE(window.busy());
    if (!gif) {
      ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(folder.filePath("film/load-000.png")); }, kPatience_ms));
    }
    window.activateWindow(); // the dialogs had the keys
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    QTest::keyClick(&window, Qt::Key_Escape);
    ASSERT_TRUE(idle());
    EXPECT_TRUE(QDir(folder.path()).isEmpty()) << "kind " << gif;
  }
}

TEST_F(Exporting, AFilmThatDoesNotFitOnTheDiskIsSaidAndLeavesNothing) {
  ASSERT_TRUE(solved());
  for (const bool gif : {true, false}) {
    answerFilmDialog(gif, 3, 1);
    answerFileDialog(folder.filePath("film"));
    QString said;
    const auto listen = QObject::connect(&window.findChild<LoadPathAnimation*>()->runner(), &JobRunner::failed,
                                         [&](const QString& sentence) { said = sentence; });
    {
      const FullDisk full(2000);
      trigger("Film of the load path");
      ASSERT_TRUE(idle());
    }
    QObject::disconnect(listen);
    EXPECT_TRUE(said.contains("cannot be written")) << said.toStdString();
    EXPECT_TRUE(QDir(folder.path()).isEmpty()) << "kind " << gif;
  }
}

TEST_F(Exporting, TheViewAloneIsSavedFromTheMenu) {
  ASSERT_TRUE(solved());
  answerFileDialog(folder.filePath("slide"));
  trigger("Picture of the view");
  const QImage slide(folder.filePath("slide.png"));
  EXPECT_EQ(slide.size(), 2 * find<BlockView>("block").image().size());
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
  QTest::keyClick(&window, Qt::Key_E, Qt::ControlModifier | Qt::ShiftModifier);
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
