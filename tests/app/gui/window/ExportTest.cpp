#include "app/gui/jobs/ExportJob.h"
#include "app/gui/live/LiveBoards.h"
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

#include <array>
#include <atomic>
#include <cmath>
#include <thread>

namespace palp {
namespace {

QByteArray bytesOf(const QString& file) {
  QFile in(file);
  return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
}

/// The lines below those that say what the table was made with.
QList<QByteArray> linesOf(const QByteArray& text) {
  QList<QByteArray> lines = text.trimmed().split('\n');
  while (!lines.isEmpty() && lines.front().startsWith('#')) lines.removeFirst();
  return lines;
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
  EXPECT_EQ(bytesOf(file), "before");
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
  EXPECT_TRUE(bytesOf(folder.filePath("shown.vtu")).contains("displacement_mm"));
  EXPECT_FALSE(bytesOf(folder.filePath("shown.vtu")).contains("kept_displacement_mm"));
  Project next = workbench.project();
  next.kept = next.design;
  std::get<MooneyRivlin>(next.kept->material.law).c10_MPa *= 0.5;
  next.view.lessReference = true;
  workbench.edit("keep", next);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.referencePath() != nullptr && !window.busy(); }, kPatience_ms));
  answerFileDialog(folder.filePath("both"));
  trigger("Export VTU");
  ASSERT_TRUE(written(folder.filePath("both.vtu")));
  EXPECT_TRUE(bytesOf(folder.filePath("both.vtu")).contains("kept_displacement_mm"));
}

TEST_F(Exporting, ACalculixDeckIsWrittenWholeBesideTheWindow) {
  ASSERT_TRUE(solved());
  answerFileDialog(folder.filePath("touch"));
  trigger("Export CalculiX deck");
  ASSERT_TRUE(written(folder.filePath("touch.inp")));
  const QByteArray deck = bytesOf(folder.filePath("touch.inp"));
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

TEST_F(Exporting, TheFieldInTheCutIsATableOfTheValuesThatColourIt) {
  ASSERT_TRUE(solved());
  trigger("Export field in the cut");
  EXPECT_TRUE(window.statusBar()->currentMessage().startsWith("There is no cut"));
  find<QComboBox>("cut").setCurrentIndex(2); // across y, in the middle
  answerFileDialog(folder.filePath("cut"));
  trigger("Export field in the cut");
  ASSERT_TRUE(written(folder.filePath("cut.csv")));
  const QByteArray text = bytesOf(folder.filePath("cut.csv"));
  EXPECT_TRUE(text.contains("# load on area 1: (")) << text.left(400).toStdString();
  EXPECT_TRUE(text.contains("# mesh --mapped 9x8x2\n"));
  EXPECT_TRUE(text.contains("# up to date when it was saved\n"));
  const double at_mm = workbench.project().view.cut->at_mm;
  EXPECT_TRUE(text.contains("# cut across y at " + QByteArray::number(at_mm) + " mm"));
  const QList<QByteArray> table = linesOf(text);
  EXPECT_EQ(table.front(), "x_mm,y_mm,z_mm,u_x_mm,u_y_mm,u_z_mm,\"" +
                               QByteArray::fromStdString(quantityName(Quantity::Displacement)) + " [mm]\"");
  ASSERT_GT(table.size(), 20);
  const double warp = find<BlockView>("block").deformationScale();
  for (const QByteArray& line : table.mid(1)) {
    const QList<QByteArray> cells = line.split(',');
    ASSERT_EQ(cells.size(), 7) << line.toStdString();
    std::array<double, 7> v{};
    for (int k = 0; k < 7; ++k) v[static_cast<std::size_t>(k)] = cells[k].toDouble();
    EXPECT_NEAR(v[1] + warp * v[4], at_mm, 1e-6) << "on the plane as drawn; VTK weighs nodes in single precision";
    const double size_mm = std::sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
    EXPECT_NEAR(v[6], size_mm, 0.05 * workbench.touch().fields()->displacement_mm.colwise().norm().maxCoeff())
        << "between nodes both are interpolated";
  }
}

TEST_F(Exporting, ATableSaysWhatHasChangedSinceItWasComputed) {
  ASSERT_TRUE(solved());
  ASSERT_TRUE(idle());
  window.showScene("design"); // which computes no solution
  Project next = workbench.project();
  std::get<MooneyRivlin>(next.design.material.law).c10_MPa *= 2;
  next.design.block_mm.x() = 31;
  workbench.edit("softer", next);
  answerFileDialog(folder.filePath("old"));
  trigger("Export electrodes");
  const QByteArray text = bytesOf(folder.filePath("old.csv"));
  EXPECT_TRUE(text.contains("# stale when it was saved: block size along x 30 -> 31 mm, "))
      << text.left(300).toStdString();
  EXPECT_TRUE(text.contains("\"block_mm\":[30,")) << "the design that it was computed from";
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
      const auto begun = [&] { return !QDir(folder.filePath("film")).isEmpty(QDir::Files | QDir::Hidden); };
      ASSERT_TRUE(QTest::qWaitFor(begun, kPatience_ms)) << "under a temporary name";
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
  for (const char* file : {"sweepError.png", "sweepError.csv", "sweepError.svg", "leaveOneOut.png", "decoupledFx.png",
                           "decoupledFz.csv", "relativeError.csv", "sweep.csv", "networks.csv"})
    EXPECT_TRUE(files.contains(file)) << file << " among " << files.join(' ').toStdString();
  EXPECT_FALSE(files.contains("trialsError.png")) << "nothing was compared";
  for (const char* file : {"sweep.csv", "sweepError.csv"}) {
    const QByteArray table = bytesOf(charts.filePath(file));
    EXPECT_TRUE(table.contains("# palp sweep train.csv")) << "what it was made with";
    EXPECT_TRUE(table.contains("# design {")) << file;
    EXPECT_TRUE(table.contains("# up to date when it was saved\n")) << file;
  }
  EXPECT_EQ(linesOf(bytesOf(charts.filePath("sweep.csv"))).size(), 4);
  EXPECT_TRUE(bytesOf(charts.filePath("sweepError.csv")).contains(",5.18") ||
              bytesOf(charts.filePath("sweepError.csv")).contains(",0.16"))
      << "numbers as they are printed";
  const QByteArray drawing = bytesOf(charts.filePath("decoupledFx.svg"));
  EXPECT_TRUE(drawing.contains("<svg") && drawing.trimmed().endsWith("</svg>"));
  EXPECT_FALSE(drawing.contains("<image")) << "lines and letters, no pixels";
  EXPECT_GT(QImage(charts.filePath("decoupledFx.png")).width(), 600) << "of a tab that was never seen";
}

TEST_F(Exporting, TheFramesOfTheLiveSceneSayWhatTheyWereMadeWith) {
  window.showScene("live");
  auto& page = find<LiveBoards>("live").page();
  ASSERT_TRUE(QTest::qWaitFor([&] { return page.host().history().entries().size() > 10; }, kPatience_ms));
  const QString file = folder.filePath("live.csv");
  answerFileDialog(file);
  QTest::mouseClick(page.findChild<QPushButton*>("exportLive"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(file); }, kPatience_ms));
  const QByteArray text = bytesOf(file);
  EXPECT_TRUE(text.startsWith("# palp listen --simulate")) << text.left(200).toStdString();
  EXPECT_TRUE(text.contains("\n# design {"));
  EXPECT_TRUE(linesOf(text).front().startsWith("t_s,board_s,"));
  EXPECT_GT(linesOf(text).size(), 10);
}

} // namespace
} // namespace palp
