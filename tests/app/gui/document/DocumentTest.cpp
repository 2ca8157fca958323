#include "app/gui/document/Document.h"
#include "app/gui/project/Leaving.h"
#include "app/gui/project/ProjectFile.h"
#include "io/AtomicFile.h"
#include "tests/app/gui/FullDisk.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAction>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileInfo>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QTemporaryDir>
#include <SourceDir.h>

#include <algorithm>

namespace palp {
namespace {

class DocumentTest : public WindowFixture {
protected:
  ~DocumentTest() override { answer_.stop(); }
  /// A force typed into the panel.
  void press(double fz_N) {
    window.showScene("deformation");
    auto& force = find<QDoubleSpinBox>("force_z");
    force.setFocus();
    force.selectAll();
    QTest::keyClicks(&force, QString::number(fz_N));
    QTest::keyClick(&force, Qt::Key_Return);
    ASSERT_EQ(workbench.project().load.areas[0].force_N.z(), fz_N);
  }
  /// Clicks this button of every question from now on, and counts the questions.
  void answer(QMessageBox::StandardButton button) {
    QObject::disconnect(&answer_, nullptr, nullptr, nullptr);
    QObject::connect(&answer_, &QTimer::timeout, &answer_, [this, button] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr || box->button(button) == nullptr) return;
      ++questions_;
      QTest::mouseClick(box->button(button), Qt::LeftButton);
    });
    answer_.start(20);
  }
  void key(Qt::Key letter) {
    window.activateWindow(); // a dialog may have taken the keys
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    QTest::keyClick(&window, letter, Qt::ControlModifier);
  }
  QString inFolder(const char* name) { return folder_.filePath(name); }
  double fz_N() { return workbench.project().load.areas[0].force_N.z(); }

  QTemporaryDir folder_;
  QTimer answer_;
  int questions_ = 0;
};

TEST_F(DocumentTest, AsksBeforeUnsavedWorkIsLostByClosing) {
  press(-2.5);
  answer(QMessageBox::Cancel);
  EXPECT_FALSE(window.close());
  EXPECT_TRUE(window.isVisible());
  EXPECT_EQ(questions_, 1);
  key(Qt::Key_Q);
  EXPECT_TRUE(window.isVisible());
  EXPECT_EQ(questions_, 2);
  answer(QMessageBox::Discard);
  EXPECT_TRUE(window.close());
  EXPECT_EQ(questions_, 3);
}

TEST_F(DocumentTest, ClosesWithoutAQuestionWhereNothingIsLost) {
  find<QAbstractButton>("clickLine").click(); // how things are shown
  answer(QMessageBox::Cancel);
  EXPECT_TRUE(window.close());
  EXPECT_EQ(questions_, 0);
}

TEST_F(DocumentTest, SavesWhenAskedToBeforeItCloses) {
  press(-2.5);
  const QString file = inFolder("mine");
  workbench.saved(file + ".json"); // so that no file dialog is needed
  press(-3.5);
  answer(QMessageBox::Save);
  EXPECT_TRUE(window.close());
  EXPECT_EQ(loadProject((file + ".json").toStdString(), exampleProject()).load.areas[0].force_N.z(), -3.5);
}

TEST_F(DocumentTest, AsksBeforeAnotherProjectTakesItsPlaceAndUndoDoesNotBringWhatWasDiscardedBack) {
  press(-2.5);
  answer(QMessageBox::Cancel);
  key(Qt::Key_N);
  EXPECT_EQ(questions_, 1);
  EXPECT_EQ(fz_N(), -2.5);
  answer(QMessageBox::Discard);
  key(Qt::Key_N);
  EXPECT_EQ(questions_, 2);
  EXPECT_EQ(workbench.project(), exampleProject());
  key(Qt::Key_Z);
  EXPECT_EQ(workbench.project(), exampleProject());
}

TEST_F(DocumentTest, EveryWayOfLeavingAsksAboutWhatWouldEnd) {
  Project other = quickProject();
  other.load.areas[0].force_N.z() = -9;
  saveProject(inFolder("other.json").toStdString(), other);
  const Project here = workbench.project();
  QObject board;
  std::vector<const Project*> next;
  workbench.lossQuestion().ask(board, [&](const Leaving& leaving) {
    if (leaving.way == Leaving::Way::Edit) return QStringList();
    next.push_back(leaving.next);
    return QStringList("touch.palprec is being recorded.");
  });
  answer(QMessageBox::No);
  EXPECT_FALSE(window.close());
  dropOn(window, inFolder("other.json"));
  key(Qt::Key_N);
  window.document().openExample(inFolder("other.json"), "other");
  EXPECT_EQ(questions_, 4);
  EXPECT_EQ(workbench.project(), here);
  ASSERT_EQ(next.size(), 4U);
  EXPECT_EQ(std::count(next.begin(), next.end(), nullptr), 1) << "quitting alone has nothing after it";
  answer(QMessageBox::Yes);
  dropOn(window, inFolder("other.json"));
  EXPECT_EQ(fz_N(), -9);
}

TEST_F(DocumentTest, SamplesThatAreBeingMadeAreNotEndedWithoutAQuestion) {
  network.generate({2000, 1}, workbench.project().mesh);
  answer(QMessageBox::No);
  EXPECT_FALSE(window.close());
  EXPECT_EQ(questions_, 1);
  EXPECT_TRUE(network.generating());
  network.cancel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !network.working(); }, kPatience_ms));
  EXPECT_TRUE(window.close());
  EXPECT_EQ(questions_, 1) << "they were given up";
}

TEST_F(DocumentTest, AsksBeforeAnOpenedFileTakesItsPlace) {
  Project other = quickProject();
  other.load.areas[0].force_N.z() = -9;
  saveProject(inFolder("other.json").toStdString(), other);
  press(-2.5);
  answer(QMessageBox::Cancel);
  dropOn(window, inFolder("other.json"));
  EXPECT_EQ(questions_, 1);
  EXPECT_EQ(fz_N(), -2.5);
  answer(QMessageBox::Discard);
  dropOn(window, inFolder("other.json"));
  EXPECT_EQ(fz_N(), -9);
}

TEST_F(DocumentTest, ShowsTheFileAndWhetherItHoldsEverythingInTheTitle) {
  EXPECT_EQ(window.windowTitle(), "Untitled[*] - Palp");
  EXPECT_FALSE(window.isWindowModified());
  press(-2.5);
  EXPECT_TRUE(window.isWindowModified());
  answerFileDialog(inFolder("mine.json"));
  key(Qt::Key_S);
  EXPECT_EQ(window.windowTitle(), "mine.json[*] - Palp");
  EXPECT_FALSE(window.isWindowModified());
  press(-3);
  EXPECT_TRUE(window.isWindowModified());
  key(Qt::Key_Z);
  EXPECT_FALSE(window.isWindowModified()) << "back at what the file holds";
}

TEST_F(DocumentTest, SavesAgainWithoutAskingForTheNameAndListsTheFile) {
  press(-2.5);
  answerFileDialog(inFolder("mine")); // a name without .json
  key(Qt::Key_S);
  ASSERT_TRUE(QFileInfo::exists(inFolder("mine.json")));
  press(-4);
  key(Qt::Key_S); // would wait for an answer for ever if it asked
  EXPECT_EQ(loadProject(inFolder("mine.json").toStdString(), exampleProject()).load.areas[0].force_N.z(), -4);
  EXPECT_EQ(Document::recent(), QStringList(inFolder("mine.json")));
  auto* recent = window.findChild<QMenu*>("recent");
  ASSERT_NE(recent, nullptr);
  emit recent->aboutToShow();
  ASSERT_EQ(recent->actions().size(), 1);
  EXPECT_TRUE(recent->actions()[0]->isEnabled()) << "in the very first session";
}

TEST_F(DocumentTest, SavesAnOpenedProjectInItsOwnFile) {
  saveProject(inFolder("p.json").toStdString(), quickProject());
  dropOn(window, inFolder("p.json"));
  press(-4);
  key(Qt::Key_S);
  EXPECT_EQ(loadProject(inFolder("p.json").toStdString(), exampleProject()).load.areas[0].force_N.z(), -4);
}

TEST_F(DocumentTest, AProjectOfTheProgramsStartIsSavedInItsFile) {
  saveProject(inFolder("p.json").toStdString(), workbench.project());
  window.document().beganWith(inFolder("p.json"));
  EXPECT_EQ(window.windowTitle(), "p.json[*] - Palp");
  press(-4);
  key(Qt::Key_S);
  EXPECT_EQ(loadProject(inFolder("p.json").toStdString(), exampleProject()).load.areas[0].force_N.z(), -4);
  window.document().beganWith(QString::fromStdString(PALP_SOURCE_DIR "/resources/paper.json"));
  EXPECT_EQ(workbench.file(), inFolder("p.json")) << "a design is none to be overwritten";
}

TEST_F(DocumentTest, AFullDiskIsSaidAndLeavesTheFileAndTheWorkAsTheyAre) {
  const std::string file = inFolder("mine.json").toStdString();
  workbench.saved(inFolder("mine.json")); // so that no file dialog is needed
  press(-2.5);
  ASSERT_TRUE(window.document().save());
  press(-3.5);
  const std::string before = readFile(file);
  answer(QMessageBox::Ok);
  {
    const FullDisk full(before.size() / 2);
    key(Qt::Key_S);
  }
  EXPECT_EQ(questions_, 1) << "one box";
  EXPECT_EQ(readFile(file), before);
  EXPECT_TRUE(window.isWindowModified());
  EXPECT_EQ(QDir(inFolder(".")).entryList(QDir::Files | QDir::Hidden), QStringList("mine.json"));
  key(Qt::Key_S);
  EXPECT_FALSE(window.isWindowModified()) << "and it is saved when there is room again";
}

TEST_F(DocumentTest, AFullDiskKeepsTheSamplesUnsavedAndTheProjectOpen) {
  workbench.saved(inFolder("mine.json"));
  window.showScene("network");
  find<QPushButton>("generate").click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
  answer(QMessageBox::Ok);
  QString said;
  QObject::connect(&network.writer(), &JobRunner::failed, [&said](const QString& sentence) { said = sentence; });
  {
    const FullDisk full(1 << 14); // room for the project, not for the samples
    EXPECT_TRUE(window.document().save());
    ASSERT_TRUE(QTest::qWaitFor([&] { return questions_ == 1; }, kPatience_ms));
  }
  EXPECT_TRUE(said.contains("cannot be written")) << said.toStdString();
  EXPECT_TRUE(window.isWindowModified());
  EXPECT_TRUE(QDir(inFolder("mine.palp")).entryList(QDir::Files | QDir::Hidden).isEmpty());
  ASSERT_TRUE(window.document().save());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.isWindowModified(); }, kPatience_ms));
}

TEST_F(DocumentTest, OpensTheExamplesAsCopies) {
  QMenu* examples = nullptr;
  for (QMenu* menu : window.findChildren<QMenu*>())
    if (menu->title() == "&Examples") examples = menu;
  ASSERT_NE(examples, nullptr);
  ASSERT_EQ(examples->actions().size(), 3);
  answer(QMessageBox::Discard);
  QList<SensorDesign> seen;
  for (QAction* example : examples->actions()) {
    press(-2.5); // unsaved, so that each asks
    const int before = questions_;
    example->trigger();
    EXPECT_EQ(questions_, before + 1) << example->text().toStdString();
    EXPECT_TRUE(workbench.file().isEmpty()) << "an example must not be saved over";
    EXPECT_FALSE(Document::recent().contains(example->text()));
    EXPECT_TRUE(check(workbench.project().design).empty());
    for (const SensorDesign& other : seen) EXPECT_NE(other, workbench.project().design);
    seen.append(workbench.project().design);
    if (workbench.project().load.areas.empty()) { // pressed by an indenter: the next press() needs an area
      Project next = workbench.project();
      next.load = exampleProject().load;
      workbench.edit("area", next);
    }
  }
}

TEST_F(DocumentTest, ADesignAloneIsNoProjectToBeOverwritten) {
  QFile::copy(QString::fromStdString(PALP_SOURCE_DIR "/resources/paper.json"), inFolder("sensor.json"));
  dropOn(window, inFolder("sensor.json"));
  EXPECT_TRUE(workbench.file().isEmpty());
}

} // namespace
} // namespace palp
