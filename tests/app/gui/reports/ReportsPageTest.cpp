#include "app/gui/reports/ReportsPage.h"

#include "tests/app/gui/WindowFixture.h"

#include <QClipboard>
#include <QComboBox>
#include <QContextMenuEvent>
#include <QDesktopServices>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPixmap>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QTimer>
#include <QTreeWidget>

#include <gtest/gtest.h>

namespace palp {
namespace {

constexpr int kReportPatience_ms = 4 * kPatience_ms;

class ReportsPageTest : public WindowFixture {
protected:
  ReportsPageTest() {
    window.showScene("reports");
    keepIn(folder.path());
  }
  /// As if typed.
  void keepIn(const QString& path) {
    auto& edit = find<QLineEdit>("reportFolder");
    edit.setText(path);
    QTest::keyClick(&edit, Qt::Key_Return);
  }
  void choose(const QString& kind) {
    auto& kinds = find<QComboBox>("reportKind");
    kinds.setCurrentIndex(kinds.findText(kind, Qt::MatchFixedString));
    ASSERT_EQ(kinds.currentText().toLower(), kind.toLower());
  }
  void run(const QString& kind) {
    choose(kind);
    QTest::mouseClick(&find<QPushButton>("runReport"), Qt::LeftButton);
  }
  bool ended() {
    return QTest::qWaitFor([&] { return find<QPushButton>("runReport").isEnabled(); }, kReportPatience_ms);
  }
  /// A stand-in for palp: a shell script that gets the report's folder as $folder.
  void setProgram(const QByteArray& body) {
    const QString program = programs.filePath("palp-stand-in");
    QFile script(program);
    ASSERT_TRUE(script.open(QIODevice::WriteOnly));
    script.write("#!/bin/sh\nwhile [ \"$1\" != -o ]; do shift; done\nfolder=$2\n" + body);
    script.close();
    ASSERT_TRUE(script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
    static_cast<ReportsPage&>(window.currentScene()).setProgram(program);
  }
  QStringList reports() { return QDir(folder.path()).entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name); }
  QString inReport(const QString& file) {
    return reports().isEmpty() ? QString() : QDir(folder.filePath(reports().back())).filePath(file);
  }
  QString state() { return find<QLabel>("reportState").text(); }
  QListWidget& pictures() { return find<QListWidget>("reportPictures"); }
  QListWidget& written() { return find<QListWidget>("writtenReports"); }

  QTemporaryDir folder, programs;
};

TEST_F(ReportsPageTest, RunsAReportOfTheProjectsMeshAndShowsItsPicturesAlone) {
  QFile(folder.filePath("of_another_report.png")).open(QIODevice::WriteOnly);
  run("stability");
  EXPECT_TRUE(find<QPlainTextEdit>("reportLog").toPlainText().contains("--per-area 6 --mapped 9x8x2"));
  ASSERT_TRUE(ended());
  EXPECT_TRUE(state().startsWith("Done")) << state().toStdString();
  EXPECT_TRUE(find<QPushButton>("openReport").isEnabled());
  ASSERT_EQ(reports().size(), 1);
  EXPECT_TRUE(reports().front().startsWith("stability-")) << reports().front().toStdString();
  EXPECT_TRUE(QFile::exists(inReport("report.html")));
  ASSERT_EQ(pictures().count(), 1);
  EXPECT_EQ(pictures().item(0)->text(), "spread.png");
  EXPECT_FALSE(find<QLabel>("reportPicture").pixmap().isNull());
}

TEST_F(ReportsPageTest, ShowsTheWordsAndTablesOfThePageAndMarksItInTheList) {
  setProgram("echo '<html><style>p { color: red; }</style><body><p>It resolves 0.1 N.</p><img src=\"data:x\">"
             "<table><tr class=\"bad\"><td>1.25</td></tr></table></body></html>' > \"$folder/report.html\"\n");
  run("stability");
  ASSERT_TRUE(ended());
  auto& words = find<QTextBrowser>("reportWords");
  EXPECT_TRUE(words.toPlainText().contains("It resolves 0.1 N.")) << words.toPlainText().toStdString();
  EXPECT_TRUE(words.toPlainText().contains("1.25"));
  EXPECT_FALSE(words.toPlainText().contains("color"));
  EXPECT_TRUE(words.isVisible()) << "its tab is shown";
  run("noise");
  ASSERT_TRUE(ended());
  QTest::mouseClick(&find<QPushButton>("showNewReport"), Qt::LeftButton);
  ASSERT_EQ(written().count(), 2);
  ASSERT_NE(written().currentItem(), nullptr);
  EXPECT_TRUE(written().currentItem()->text().startsWith("noise")) << written().currentItem()->text().toStdString();
}

TEST_F(ReportsPageTest, RunGivesTheKeysToNoField) {
  setProgram("exec sleep 600\n");
  find<QPushButton>("runReport").setFocus();
  run("stability");
  settle();
  auto& kept = find<QLineEdit>("reportFolder");
  EXPECT_FALSE(kept.hasFocus());
  ASSERT_NE(QApplication::focusWidget(), nullptr);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_X);
  EXPECT_EQ(kept.text(), folder.path());
  auto& cancel = find<QPushButton>("cancelReport");
  cancel.setFocus();
  QTest::mouseClick(&cancel, Qt::LeftButton);
  ASSERT_TRUE(ended());
  EXPECT_TRUE(find<QPushButton>("runReport").hasFocus());
}

TEST_F(ReportsPageTest, AnEarlierReportStandsBelowItsOwnKindAndItsTimeIsTheEstimateAfterARestart) {
  setProgram("echo page > \"$folder/report.html\"\n");
  run("stability");
  ASSERT_TRUE(ended());
  choose("networks");
  ASSERT_EQ(written().count(), 1);
  auto& tabs = find<QTabWidget>("reportTabs");
  tabs.setCurrentWidget(&written());
  settle();
  const QPoint place = written().visualItemRect(written().item(0)).center();
  QTest::mouseClick(written().viewport(), Qt::LeftButton, {}, place);
  EXPECT_EQ(find<QComboBox>("reportKind").currentText(), "Stability");
  EXPECT_EQ(tabs.currentWidget(), &written()) << "the list stays in sight";
  EXPECT_TRUE(state().startsWith("Shown again")) << state().toStdString();
  choose("networks");
  EXPECT_TRUE(find<QLabel>("reportShown").text().startsWith("stability, ")) << "whose page it is, whatever is chosen";
  QSettings().remove("reportTimes"); // as if it had been run by another installation
  const ReportsPage again(workbench);
  auto* kinds = again.findChild<QComboBox*>("reportKind");
  const QString estimate = "as in the last run on this machine";
  auto* words = again.findChild<QLabel*>("reportState");
  EXPECT_FALSE(words->text().contains(estimate)) << "of the kind that was not run";
  kinds->setCurrentText("Stability");
  EXPECT_TRUE(words->text().contains(estimate)) << words->text().toStdString();
}

TEST_F(ReportsPageTest, QuittingAsksBeforeItEndsAReport) {
  setProgram("echo begun > \"$folder/begun\"\nexec sleep 600\n");
  run("stability");
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(inReport("begun")); }, kReportPatience_ms));
  int asked = 0;
  QMessageBox::StandardButton answer = QMessageBox::No;
  QTimer answers;
  QObject::connect(&answers, &QTimer::timeout, &answers, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr || box->button(answer) == nullptr) return;
    ++asked;
    box->button(answer)->click();
  });
  answers.start(20);
  window.close();
  EXPECT_TRUE(window.isVisible());
  EXPECT_EQ(asked, 1);
  EXPECT_FALSE(find<QPushButton>("runReport").isEnabled()) << "it still runs";
  answer = QMessageBox::Yes;
  window.close();
  EXPECT_FALSE(window.isVisible());
  EXPECT_EQ(asked, 2);
}

TEST_F(ReportsPageTest, QuittingAsksOnceAboutTheReportAndTheProject) {
  Project next = workbench.project();
  next.design.block_mm.x() = 31;
  workbench.edit("block", next); // not saved
  setProgram("echo begun > \"$folder/begun\"\nexec sleep 600\n");
  run("stability");
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(inReport("begun")); }, kReportPatience_ms));
  QStringList asked;
  QTimer answers;
  QObject::connect(&answers, &QTimer::timeout, &answers, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr) return;
    asked << box->text();
    box->button(QMessageBox::Cancel)->click();
  });
  answers.start(20);
  window.close();
  ASSERT_EQ(asked.size(), 1) << asked.join(" | ").toStdString();
  EXPECT_TRUE(asked[0].contains("not saved")) << asked[0].toStdString();
  EXPECT_TRUE(asked[0].contains("A report is running")) << asked[0].toStdString();
  EXPECT_TRUE(window.isVisible()) << "the answer was to stay";
  EXPECT_FALSE(find<QPushButton>("runReport").isEnabled()) << "the report goes on";
}

TEST_F(ReportsPageTest, ARefusedReportAndOneThatQuittingEndsLeaveNoFolder) {
  setProgram("echo it cannot be >&2\nexit 2\n");
  run("stability");
  ASSERT_TRUE(ended());
  EXPECT_TRUE(state().startsWith("Failed with status 2")) << state().toStdString();
  EXPECT_TRUE(reports().isEmpty());
  {
    ReportsPage page(workbench);
    page.findChild<QLineEdit*>("reportFolder")->setText(folder.path());
    const QString program = programs.filePath("palp-that-waits");
    QFile script(program);
    ASSERT_TRUE(script.open(QIODevice::WriteOnly));
    script.write("#!/bin/sh\nexec sleep 600\n");
    script.close();
    ASSERT_TRUE(script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
    page.setProgram(program);
    page.findChild<QPushButton*>("runReport")->click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return page.running(); }, kReportPatience_ms));
    EXPECT_EQ(reports().size(), 1);
  }
  EXPECT_TRUE(reports().isEmpty()) << reports().join(' ').toStdString();
}

TEST_F(ReportsPageTest, ASecondRunAndFilesOfOthersLeaveEveryFileAsItWas) {
  QFile foreign(folder.filePath("report.html"));
  ASSERT_TRUE(foreign.open(QIODevice::WriteOnly));
  foreign.write("a page of somebody else");
  foreign.close();
  setProgram("echo run > \"$folder/report.html\"\n");
  for (int k = 0; k < 3; ++k) { // within one second too
    run("stability");
    ASSERT_TRUE(ended());
  }
  ASSERT_EQ(reports().size(), 3);
  for (const QString& report : reports()) EXPECT_TRUE(QFile::exists(folder.filePath(report + "/report.html")));
  ASSERT_TRUE(foreign.open(QIODevice::ReadOnly));
  EXPECT_EQ(foreign.readAll(), "a page of somebody else");
}

TEST_F(ReportsPageTest, ListsEarlierReportsAndShowsOneAgain) {
  setProgram("echo the first one said this\necho page > \"$folder/report.html\"\n");
  run("stability");
  ASSERT_TRUE(ended());
  setProgram("echo another\necho page > \"$folder/report.html\"\n");
  run("noise");
  ASSERT_TRUE(ended());
  ASSERT_EQ(written().count(), 2);
  QListWidgetItem* first = written().findItems("stability, ", Qt::MatchStartsWith).value(0);
  ASSERT_NE(first, nullptr);
  find<QTabWidget>("reportTabs").setCurrentWidget(&written());
  QTest::mouseClick(written().viewport(), Qt::LeftButton, {}, written().visualItemRect(first).center());
  EXPECT_TRUE(state().startsWith("Shown again")) << state().toStdString();
  EXPECT_TRUE(state().contains("stability-"));
  EXPECT_TRUE(find<QPlainTextEdit>("reportLog").toPlainText().contains("the first one said this"));
  EXPECT_TRUE(find<QPushButton>("openReport").isEnabled());
}

TEST_F(ReportsPageTest, AnEarlierReportIsOpenedWhileOneRunsAndStaysUntilTheNewOneIsAskedFor) {
  setProgram("echo first run\necho page > \"$folder/report.html\"\n");
  run("stability");
  ASSERT_TRUE(ended());
  run("noise");
  ASSERT_TRUE(ended());
  auto& shown = find<QLabel>("reportShown");
  auto& offer = find<QPushButton>("showNewReport");
  EXPECT_TRUE(shown.text().startsWith("stability, ")) << "a run does not take away what is looked at";
  ASSERT_TRUE(offer.isVisible());
  QTest::mouseClick(&offer, Qt::LeftButton);
  EXPECT_TRUE(shown.text().startsWith("noise, ")) << shown.text().toStdString();
  EXPECT_FALSE(offer.isVisible());

  setProgram("echo progress 400 1000 case\nwhile [ ! -e \"$folder/go\" ]; do sleep 0.02; done\n"
             "echo page > \"$folder/report.html\"\n");
  run("stability");
  EXPECT_TRUE(shown.text().startsWith("noise, ")) << "nor does its start";
  QListWidgetItem* first = written().findItems("stability, ", Qt::MatchStartsWith).value(0);
  ASSERT_NE(first, nullptr);
  find<QTabWidget>("reportTabs").setCurrentWidget(&written());
  QTest::mouseClick(written().viewport(), Qt::LeftButton, {}, written().visualItemRect(first).center());
  EXPECT_TRUE(shown.text().startsWith("stability, ")) << shown.text().toStdString();
  EXPECT_TRUE(find<QPushButton>("openReport").isEnabled());
  EXPECT_TRUE(state().startsWith("Running for")) << "progress stays in sight";
  EXPECT_FALSE(find<QPlainTextEdit>("reportLog").toPlainText().contains("first run")) << "the messages are the run's";
  QFile(inReport("go")).open(QIODevice::WriteOnly);
  ASSERT_TRUE(ended());
  EXPECT_TRUE(state().startsWith("Done in")) << state().toStdString();
  EXPECT_TRUE(offer.isVisible());
  EXPECT_EQ(written().count(), 3);
}

TEST_F(ReportsPageTest, AReportsPictureHasTheMenuOfOtherChartsAndIsExportedWithItsPoints) {
  ASSERT_TRUE(QPixmap(64, 48).toImage().convertToFormat(QImage::Format_RGB32).save(programs.filePath("spread.png")));
  setProgram("cp " + programs.filePath("spread.png").toUtf8() +
             " \"$folder\"\necho x,y > \"$folder/points.csv\"\necho page > \"$folder/report.html\"\n");
  run("stability");
  ASSERT_TRUE(ended());
  auto& label = find<QLabel>("reportPicture");
  const auto choose = [&](const QString& begin) {
    QTimer::singleShot(50, [begin] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      ASSERT_NE(menu, nullptr);
      for (QAction* action : menu->actions())
        if (action->text().startsWith(begin)) { // by keys: Qt 6.8 drops a click where the mouse has not moved
          menu->setActiveAction(action);
          return QTest::keyClick(menu, Qt::Key_Return);
        }
      menu->close();
      FAIL() << begin.toStdString();
    });
    QContextMenuEvent event(QContextMenuEvent::Mouse, label.rect().center(), label.mapToGlobal(label.rect().center()));
    QApplication::sendEvent(&label, &event);
  };
  choose("Copy points");
  EXPECT_EQ(QApplication::clipboard()->text(), "x,y\n");
  answerFileDialog(programs.filePath("kept.png"));
  choose("Save picture, 64 x 48");
  EXPECT_TRUE(QFile::exists(programs.filePath("kept.png")));
  answerFileDialog(programs.filePath("kept.csv"));
  choose("Save points");
  EXPECT_TRUE(QFile::exists(programs.filePath("kept.csv")));
  answerFileDialog(programs.filePath("all"));
  for (QAction* menu : window.menuBar()->actions())
    for (QAction* action : menu->menu()->actions())
      if (action->shortcut() == QKeySequence("Ctrl+Shift+E")) action->trigger();
  const QDir all(programs.filePath("all"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return all.entryList(QDir::Files, QDir::Name).size() == 2; }, kPatience_ms));
  EXPECT_EQ(all.entryList(QDir::Files, QDir::Name), QStringList({"points.csv", "spread.png"}));
}

TEST_F(ReportsPageTest, SaysBeforehandWhatRunsAndForHowLongAndThenWhatIsDone) {
  choose("stability");
  EXPECT_TRUE(state().startsWith("Takes about")) << state().toStdString();
  auto& cases = find<QTreeWidget>("reportCases");
  ASSERT_GT(cases.topLevelItemCount(), 2);
  EXPECT_TRUE(cases.topLevelItem(0)->text(1).startsWith("about "));
  setProgram("echo progress 400 1000 shear 2 N\nwhile [ ! -e \"$folder/go\" ]; do sleep 0.02; done\n"
             "echo page > \"$folder/report.html\"\n");
  run("stability");
  ASSERT_TRUE(QTest::qWaitFor([&] { return cases.topLevelItem(1)->text(1) == "running"; }, kPatience_ms));
  EXPECT_TRUE(cases.topLevelItem(0)->text(1).startsWith("done in"));
  EXPECT_TRUE(cases.topLevelItem(1)->text(0).contains("shear 2 N"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return state().contains("left."); }, kPatience_ms)) << state().toStdString();
  QFile(inReport("go")).open(QIODevice::WriteOnly);
  ASSERT_TRUE(ended());
  for (int k = 0; k < cases.topLevelItemCount(); ++k)
    EXPECT_TRUE(cases.topLevelItem(k)->text(1).startsWith("done in")) << k;
}

TEST_F(ReportsPageTest, SaysThePathWhereNoProgramShowsThePage) {
  setProgram("echo page > \"$folder/report.html\"\n");
  run("stability");
  ASSERT_TRUE(ended());
  QTest::mouseClick(&find<QPushButton>("openReport"), Qt::LeftButton); // offscreen there is no desktop to ask
  EXPECT_TRUE(state().startsWith("No application on this computer")) << state().toStdString();
  EXPECT_TRUE(state().contains(inReport("report.html")));
}

TEST_F(ReportsPageTest, AFolderThatCannotBeMadeIsNamed) {
  QFile(folder.filePath("file")).open(QIODevice::WriteOnly);
  keepIn(folder.filePath("file"));
  run("stability");
  EXPECT_TRUE(state().contains("cannot be created")) << state().toStdString();
  EXPECT_TRUE(find<QPushButton>("runReport").isEnabled());
}

TEST_F(ReportsPageTest, ACancelledReportSaysSoAndLeavesNothing) {
  Project many = workbench.project();
  many.view.reportPerArea = 4000; // work for longer than any machine waits before the cancel
  workbench.edit("many", many);
  run("networks");
  ASSERT_TRUE(QTest::qWaitFor([&] { return find<QPushButton>("cancelReport").isEnabled(); }, kPatience_ms));
  auto& cases = find<QTreeWidget>("reportCases");
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return !cases.findItems("running", Qt::MatchExactly, 1).isEmpty(); }, kReportPatience_ms))
      << "it computes";
  QTest::mouseClick(&find<QPushButton>("cancelReport"), Qt::LeftButton);
  ASSERT_TRUE(ended());
  EXPECT_TRUE(state().startsWith("Cancelled")) << state().toStdString();
  EXPECT_FALSE(pictures().isVisible());
  EXPECT_TRUE(find<QLabel>("reportPicture").pixmap().isNull());
  EXPECT_FALSE(find<QPushButton>("openReport").isEnabled());
  EXPECT_TRUE(reports().isEmpty()) << reports().join(' ').toStdString();
}

TEST_F(ReportsPageTest, SaysThatTheProgramCannotBeStartedAndLeavesTheWordsThere) {
  static_cast<ReportsPage&>(window.currentScene()).setProgram(folder.filePath("no-palp"));
  run("stability");
  ASSERT_TRUE(ended());
  settle();
  EXPECT_TRUE(state().contains("no-palp cannot be started")) << state().toStdString();
  EXPECT_FALSE(find<QPushButton>("cancelReport").isEnabled());
  EXPECT_TRUE(reports().isEmpty());
}

TEST_F(ReportsPageTest, SaysWhichFilesACancelledReportHadWritten) {
  setProgram("trap 'exit 130' INT\necho 1 > \"$folder/points.csv\"\nwhile :; do sleep 0.02; done\n");
  run("stability");
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(inReport("points.csv")); }, kPatience_ms));
  QTest::mouseClick(&find<QPushButton>("cancelReport"), Qt::LeftButton);
  ASSERT_TRUE(ended());
  EXPECT_TRUE(state().contains("1 of the report's files")) << state().toStdString();
  EXPECT_TRUE(find<QPushButton>("openReportFolder").isEnabled());
}

} // namespace
} // namespace palp
