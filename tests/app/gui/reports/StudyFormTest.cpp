#include "app/gui/reports/StudyForm.h"
#include "app/gui/reports/ReportFolders.h"
#include "app/gui/reports/ReportsPage.h"
#include "io/AtomicFile.h"
#include "io/DesignFile.h"

#include "tests/app/gui/WindowFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QToolButton>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// The Reports scene with the form of a study, worked by hand.
class StudyFormTest : public WindowFixture {
protected:
  StudyFormTest() {
    window.showScene("reports");
    auto& edit = find<QLineEdit>("reportFolder");
    edit.setText(folder.path());
    QTest::keyClick(&edit, Qt::Key_Return);
    auto& kinds = find<QComboBox>("reportKind");
    kinds.setCurrentIndex(kinds.findText("Study of many designs"));
    only("displacement");
  }
  void click(const char* button) { QTest::mouseClick(&find<QPushButton>(button), Qt::LeftButton); }
  /// What is worked out.
  void only(const QString& quantity) {
    for (const char* name : {"bound", "decoders", "displacement", "error"})
      find<QCheckBox>((QString("study-") + name).toUtf8()).setChecked(quantity == name);
  }
  void type(const char* edit, const QString& words) {
    auto& line = find<QLineEdit>(edit);
    line.setFocus();
    line.selectAll();
    QTest::keyClicks(&line, words);
  }
  bool ended() {
    return QTest::qWaitFor([&] { return find<QPushButton>("runReport").isEnabled(); }, 4 * kPatience_ms);
  }
  QString state() { return find<QLabel>("reportState").text(); }
  QString problem() { return find<QLabel>("studyProblem").text(); }
  QListWidget& written() { return find<QListWidget>("writtenReports"); }
  QStringList runs() { return QDir(folder.path()).entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name); }

  QTemporaryDir folder;
};

TEST_F(StudyFormTest, RunsAStudyOfTheProjectsDesignAndTakesOneOfItsDesignsOver) {
  type("studyValues0", "4.5, 5.5"); // the block's height
  EXPECT_TRUE(state().startsWith("2 designs")) << state().toStdString();
  click("runReport");
  ASSERT_TRUE(ended());
  ASSERT_TRUE(state().startsWith("Done")) << state().toStdString();
  ASSERT_EQ(runs().size(), 1);
  const std::string table = readFile(folder.filePath(runs()[0] + "/table.csv").toStdString());
  EXPECT_TRUE(table.starts_with("design,block_mm.2,problem,largest_displacement_mm\n0,4.5,")) << table;
  EXPECT_EQ(find<QListWidget>("reportPictures").count(), 1);
  EXPECT_FALSE(find<QLabel>("reportPicture").pixmap().isNull());
  EXPECT_TRUE(find<QPushButton>("openReport").isEnabled());
  ASSERT_EQ(written().count(), 1);
  EXPECT_TRUE(written().item(0)->text().startsWith("study, ")) << written().item(0)->text().toStdString();

  find<QSpinBox>("studyChosen").setValue(1);
  click("takeStudyDesign");
  EXPECT_EQ(workbench.project().design.block_mm.z(), 5.5);
  EXPECT_TRUE(state().startsWith("2 designs")) << "the study stands on the design that it was of";
  workbench.history().undo();
  EXPECT_EQ(workbench.project().design.block_mm.z(), 5);
}

TEST_F(StudyFormTest, WhatIsNoStudyIsSaidInRedAndCannotBeRun) {
  for (const auto& [words, said] :
       {std::pair{"4.5..5.5", "count"}, std::pair{"4.5..x 3", "expected a range"}, std::pair{"", "expected a range"},
        std::pair{"4.5, , 5", "block_mm.2"}, std::pair{"-1..5 x 3 log", "logarithmic"}, std::pair{"4,5", "unclear"},
        std::pair{"4,5..6 x 3", "unclear"}}) {
    type("studyValues0", "4.5, 5.5");
    ASSERT_TRUE(find<QPushButton>("runReport").isEnabled());
    auto& line = find<QLineEdit>("studyValues0");
    line.setText(words);
    EXPECT_TRUE(problem().contains(said)) << words << ": " << problem().toStdString();
    EXPECT_FALSE(find<QPushButton>("runReport").isEnabled()) << words;
  }
  type("studyValues0", "4.5..5.5 x 3");
  find<QComboBox>("studyKey0").setCurrentText("block_mm.9");
  EXPECT_TRUE(problem().contains("block_mm.9")) << problem().toStdString();
  find<QComboBox>("studyKey0").setCurrentText("block_mm.2");
  EXPECT_TRUE(find<QPushButton>("runReport").isEnabled()) << problem().toStdString();
  only("none");
  EXPECT_TRUE(problem().contains("compute")) << problem().toStdString();
  only("decoders");
  type("studyDecoders", "rbf, magic");
  EXPECT_TRUE(problem().contains("magic")) << problem().toStdString();
}

TEST_F(StudyFormTest, NumbersAreAddedAndTakenAwayAndAHypercubeNeedsNoCount) {
  type("studyValues0", "4.5..5.5 x 3");
  click("addStudyKey");
  EXPECT_TRUE(state().startsWith("6 designs")) << "two numbers of columns" << state().toStdString();
  find<QComboBox>("studyPlan").setCurrentIndex(1);
  find<QSpinBox>("studyPoints").setValue(12);
  type("studyValues0", "4.5..5.5");
  EXPECT_TRUE(state().startsWith("12 designs")) << state().toStdString() << problem().toStdString();
  find<QComboBox>("studyPlan").setCurrentIndex(0);
  type("studyValues0", "4.5..5.5 x 4");
  QList<QToolButton*> away = find<QWidget>("studyForm").findChildren<QToolButton*>();
  away.erase(std::remove_if(away.begin(), away.end(), [](const QToolButton* b) { return b->text() != "x"; }),
             away.end());
  ASSERT_EQ(away.size(), 2);
  QTest::mouseClick(away[1], Qt::LeftButton);
  EXPECT_TRUE(state().startsWith("4 designs")) << state().toStdString();
}

TEST_F(StudyFormTest, AStudyThatWasStoppedGoesOnInItsFolder) {
  type("studyValues0", "4.5, 5, 5.5");
  const QString stopped = folder.filePath("study-2026-01-02-030405");
  auto* form = window.findChild<StudyForm*>("studyForm");
  ASSERT_TRUE(QDir().mkpath(stopped + "/rows"));
  writeFile((stopped + "/" + kStudyFile).toStdString(), toJson(form->plan()), false);
  writeFile((stopped + "/rows/0000001.csv").toStdString(), "1,5,,0.125\n", false); // as no solve would say it
  type("studyValues0", "4, 4.5");
  QTest::keyClick(&find<QLineEdit>("reportFolder"), Qt::Key_Return); // lists anew
  ASSERT_EQ(written().count(), 1);
  EXPECT_TRUE(written().item(0)->text().endsWith("stopped")) << written().item(0)->text().toStdString();
  find<QTabWidget>("reportTabs").setCurrentWidget(&written());
  QTest::mouseClick(written().viewport(), Qt::LeftButton, {}, written().visualItemRect(written().item(0)).center());
  EXPECT_TRUE(state().startsWith("1 of 3 designs")) << state().toStdString();
  EXPECT_EQ(find<QLineEdit>("studyValues0").text(), "4.5, 5, 5.5");
  click("runReport");
  ASSERT_TRUE(ended());
  ASSERT_TRUE(state().startsWith("Done")) << state().toStdString();
  EXPECT_EQ(runs().size(), 1);
  const std::string table = readFile((stopped + "/table.csv").toStdString());
  EXPECT_NE(table.find("\n1,5,,0.125\n2,5.5,"), std::string::npos) << table;
}

TEST_F(StudyFormTest, SavesAFileThatThePanelOpensAgain) {
  const QString file = folder.filePath("heights.json");
  type("studyValues0", "4.5..6 x 4 log");
  answerFileDialog(file);
  click("saveStudy");
  EXPECT_EQ(loadStudy(file.toStdString()).designs(), 4U);
  type("studyValues0", "4.5, 5");
  answerFileDialog(file);
  click("openStudy");
  EXPECT_EQ(find<QLineEdit>("studyValues0").text(), "4.5..6 x 4 log");
  EXPECT_TRUE(state().startsWith("4 designs")) << state().toStdString();
  EXPECT_EQ(find<QComboBox>("studyDesign").currentText(), "The study file's design");
  type("studyValues0", "4.5, 5");
  window.showScene("design");
  dropOn(window, file);
  EXPECT_EQ(window.currentScene().objectName(), "reports");
  EXPECT_EQ(find<QLineEdit>("studyValues0").text(), "4.5..6 x 4 log") << "it goes where it belongs";
  writeFile(file.toStdString(), "{\"palp_study\": 1}", true);
  answerFileDialog(file);
  click("openStudy");
  EXPECT_TRUE(problem().contains("heights.json")) << problem().toStdString();
}

} // namespace
} // namespace palp
