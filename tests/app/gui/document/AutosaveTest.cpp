#include "app/gui/document/Autosave.h"

#include "app/gui/document/Document.h"
#include "app/gui/document/Recovery.h"
#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/project/ProjectFile.h"
#include "io/AtomicFile.h"
#include "io/board/RecordingWriter.h"
#include "tests/app/gui/FullDisk.h"
#include "tests/app/gui/WindowFixture.h"

#include <QDir>
#include <QElapsedTimer>
#include <QLabel>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QProcess>
#include <QPushButton>
#include <QTemporaryDir>

#include <map>
#include <random>

namespace palp {
namespace {

/// A session killed in the midst of it, and what it had done.
struct Killed {
  std::map<int, qint64> typed_ms; ///< the session's steps, and when they were seen
  qint64 killed_ms = 0;
};

Killed killAfter(int wait_ms, const QString& root, const QString& file) {
  Killed killed;
  QProcess session;
  session.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  QElapsedTimer clock;
  clock.start();
  session.start(QString(PALP_GUI_SESSION), {root, file});
  EXPECT_TRUE(session.waitForStarted(kPatience_ms));
  qint64 begun_ms = -1; // with the first step: a machine under load starts it late
  while (begun_ms < 0 || clock.elapsed() - begun_ms < wait_ms) {
    if (!session.waitForReadyRead(kPatience_ms)) break;
    for (const QByteArray& line : session.readAllStandardOutput().split('\n'))
      if (!line.isEmpty()) killed.typed_ms[line.toInt()] = clock.elapsed();
    if (begun_ms < 0) begun_ms = clock.elapsed();
  }
  EXPECT_EQ(session.state(), QProcess::Running);
  session.kill();
  killed.killed_ms = clock.elapsed();
  EXPECT_TRUE(session.waitForFinished(kPatience_ms));
  return killed;
}

/// The step that typed this force.
int stepOf(const Project& project) {
  return static_cast<int>(std::lround(-100 * project.load.areas[0].force_N.z())) - 1;
}

/// PALP_KILLS kills it more often than in a usual run.
int kills() {
  const int asked = qEnvironmentVariableIntValue("PALP_KILLS");
  return asked > 0 ? asked : 3;
}

TEST(Autosave, AtMostTenSecondsAreMissingAfterAKillAndNoFileIsBroken) {
  std::mt19937 random(std::random_device{}()); // another moment each time: whatever it is, nothing may be lost
  std::uniform_int_distribution<int> wait_ms(200, 9000);
  for (int k = 0; k < kills(); ++k) {
    const int wait = wait_ms(random);
    SCOPED_TRACE("killed " + std::to_string(wait) + " ms after its first step");
    const QTemporaryDir folder;
    const QString root = folder.filePath("recovery"), file = folder.filePath("p.json");
    const Killed killed = killAfter(wait, root, file);
    ASSERT_FALSE(killed.typed_ms.empty());
    int newest = stepOf(loadProject(file.toStdString(), exampleProject()));
    const std::vector<LeftWork> left = Autosave::left(root);
    ASSERT_LE(left.size(), 1U);
    for (const LeftWork& work : left) {
      EXPECT_EQ(work.file, file);
      const Project project = parseProject(Autosave::project(work), "recovered", exampleProject());
      newest = std::max(newest, stepOf(project));
      EXPECT_TRUE(openResults(Autosave::results(work).toStdString(), project.design, {}).problems.empty());
    }
    EXPECT_TRUE(openResults(folder.filePath("p.palp").toStdString(), quickProject().design, {}).problems.empty());
    const auto lost = killed.typed_ms.upper_bound(newest); // the first step that is in no file
    if (lost != killed.typed_ms.end()) {
      EXPECT_LE(killed.killed_ms - lost->second, 10000) << "step " << lost->first << " was lost";
    }
  }
}

/// Answers the question about what was left by "Recover".
void recoverInto(MainWindow& window, Autosave& autosave, const QString& left) {
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, &answer, [] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box != nullptr && box->objectName() == "recovery") QTest::mouseClick(box->buttons().front(), Qt::LeftButton);
  });
  answer.start(20);
  offerRecovery(window, autosave, left);
}

/// A window with an autosave that is then forgotten as by a kill: what it kept stays.
class AutosaveTest : public WindowFixture {
protected:
  AutosaveTest() : autosave(std::make_unique<Autosave>(workbench, network, window, folder.filePath("r"))) {}
  void press(double fz_N) {
    Project next = workbench.project();
    next.load.areas[0].force_N.z() = fz_N;
    workbench.edit("force", next);
  }
  /// The folder that the window keeps its work in, as a killed one would leave it.
  bool kept(const char* name) {
    return QTest::qWaitFor(
        [&] {
          const QDir root(folder.filePath("r"));
          for (const QString& one : root.entryList(QDir::Dirs | QDir::NoDotAndDotDot))
            if (QFileInfo::exists(root.filePath(one) + "/" + name)) return true;
          return false;
        },
        kPatience_ms);
  }
  /// Copies what is kept, without its lock.
  QString copyOfLeft() {
    const QDir root(folder.filePath("r"));
    const QString from = root.filePath(root.entryList(QDir::Dirs | QDir::NoDotAndDotDot).front());
    const QString to = folder.filePath("left/window");
    std::filesystem::create_directories(to.toStdString());
    std::filesystem::copy(from.toStdString(), to.toStdString(),
                          std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
    QFile::remove(to + "/lock");
    return folder.filePath("left");
  }

  /// What a killed window has left of a project.
  QString leaveProject(const Project& project, const QString& file) {
    const QString killed = folder.filePath("left/window");
    std::filesystem::create_directories(killed.toStdString());
    writeFile((killed + "/project.json").toStdString(), projectText(project).toStdString(), true);
    writeFile((killed + "/file.txt").toStdString(), file.toStdString(), true);
    return folder.filePath("left");
  }
  bool generated(int perArea, std::uint64_t seed) {
    network.generate({perArea, seed}, workbench.project().mesh);
    return QTest::qWaitFor([&] { return network.samples() != nullptr && !network.working(); }, kPatience_ms);
  }

  QTemporaryDir folder;
  std::unique_ptr<Autosave> autosave;
};

TEST_F(AutosaveTest, KeepsNothingWhereNothingIsUnsavedAndLeavesNothingBehind) {
  press(-2.5);
  ASSERT_TRUE(kept("project.json"));
  workbench.history().undo();
  const QDir root(folder.filePath("r"));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        const QStringList windows = root.entryList(QDir::Dirs | QDir::NoDotAndDotDot);
        return windows.size() == 1 && !QFileInfo::exists(root.filePath(windows.front()) + "/project.json");
      },
      kPatience_ms));
  press(-3);
  autosave.reset(); // as at the end of the program
  EXPECT_TRUE(root.isEmpty());
}

TEST_F(AutosaveTest, TakesNoWorkOfAWindowThatIsOpen) {
  press(-2.5);
  ASSERT_TRUE(kept("project.json"));
  EXPECT_TRUE(Autosave::left(folder.filePath("r")).empty());
}

TEST_F(AutosaveTest, AFullDiskIsSaidAndWhatWasKeptStaysUntilThereIsRoom) {
  press(-2.5);
  ASSERT_TRUE(kept("project.json"));
  const auto keptForce_N = [&] {
    const QString left = copyOfLeft();
    const std::vector<LeftWork> work = Autosave::left(left);
    return work.size() != 1
               ? 0.0
               : parseProject(Autosave::project(work[0]), "kept", exampleProject()).load.areas[0].force_N.z();
  };
  QString said;
  QObject::connect(autosave.get(), &Autosave::failed, [&said](const QString& sentence) { said = sentence; });
  {
    const FullDisk full(100);
    press(-3.5);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !said.isEmpty(); }, kPatience_ms));
  }
  EXPECT_TRUE(said.startsWith("Unsaved work cannot be stored")) << said.toStdString();
  EXPECT_FALSE(said.contains('\n'));
  EXPECT_EQ(keptForce_N(), -2.5);
  press(-4.5);
  EXPECT_TRUE(QTest::qWaitFor([&] { return keptForce_N() == -4.5; }, kPatience_ms));
}

TEST_F(AutosaveTest, WhatCannotBeReadIsNotForgottenWithTheRest) {
  const QString left = folder.filePath("left");
  std::filesystem::create_directories((left + "/window/results").toStdString());
  writeFile((left + "/window/project.json").toStdString(), projectText(quickProject()).toStdString(), true);
  writeFile((left + "/window/results/samples.csv").toStdString(), "# palp_samples: 1\n", true);
  recoverInto(window, *autosave, left);
  auto& problem = find<QLabel>("trainingProblem");
  ASSERT_TRUE(QTest::qWaitFor([&] { return problem.text().contains("samples.csv"); }, kPatience_ms));
  EXPECT_TRUE(find<QPlainTextEdit>("messageLines").toPlainText().contains(left + "/window/results"));
  EXPECT_TRUE(Autosave::left(left).empty()) << "another window would offer what is open here";
  autosave.reset();
  EXPECT_EQ(Autosave::left(left).size(), 1U) << "the next start asks again";
}

TEST_F(AutosaveTest, KeepsADesignUnderTheField) {
  Project next = workbench.project();
  next.design.resistance = FieldLaw{.wire_ohm = 12.5, .readout = Readout::OthersAtHalf};
  workbench.edit("field", next);
  ASSERT_TRUE(kept("project.json"));
  const QString left = copyOfLeft();
  Workbench fresh(exampleProject());
  NetworkSession none;
  MainWindow other(fresh, none);
  other.show();
  Autosave copies(fresh, none, other, folder.filePath("other"));
  recoverInto(other, copies, left);
  EXPECT_EQ(fresh.project().design, next.design);
}

TEST_F(AutosaveTest, HoldsNothingOfAProjectThatWasLeft) {
  network.generate({2, 1}, workbench.project().mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr && !network.working(); }, kPatience_ms));
  network.train(workbench.project().network);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr && !network.working(); }, kPatience_ms));
  const std::weak_ptr<const NetworkSamples> samples = network.sharedSamples();
  const std::weak_ptr<const NetworkFit> fit = network.results().fit;
  press(-2.5);
  ASSERT_TRUE(kept("results"));
  EXPECT_FALSE(samples.expired());
  workbench.replace(quickProject());
  EXPECT_TRUE(QTest::qWaitFor([&] { return samples.expired() && fit.expired(); }, kPatience_ms));
}

TEST_F(AutosaveTest, BringsProjectSamplesAndNetworkBackAndUndoLeadsToWhatTheFileHeld) {
  const QString file = folder.filePath("mine.json");
  workbench.saved(file);
  saveProject(file.toStdString(), workbench.project());
  const Project held = workbench.project();
  press(-2.5);
  window.showScene("network");
  find<QPushButton>("generate").click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(idle());
  find<QPushButton>("train").click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(kept("results/network.json"));
  const QString left = copyOfLeft();

  Workbench fresh(exampleProject());
  NetworkSession none;
  MainWindow next(fresh, none);
  next.show();
  Autosave copies(fresh, none, next, folder.filePath("next"));
  recoverInto(next, copies, left);
  EXPECT_EQ(fresh.project().load, workbench.project().load);
  EXPECT_EQ(fresh.file(), file);
  EXPECT_TRUE(next.isWindowModified()) << "what was recovered is still unsaved";
  ASSERT_TRUE(QTest::qWaitFor([&] { return none.fit() != nullptr; }, kPatience_ms));
  EXPECT_EQ(none.samples()->training.resistances_ohm, network.samples()->training.resistances_ohm);
  EXPECT_EQ(none.samples()->test.forces_N, network.samples()->test.forces_N);
  EXPECT_EQ(none.fit()->prediction.forces_N, network.fit()->prediction.forces_N);
  EXPECT_TRUE(Autosave::left(left).empty()) << "recovered once";
  EXPECT_TRUE(QFileInfo::exists(left + "/window/project.json")) << "the copy went before there was another one";
  fresh.history().undo();
  EXPECT_EQ(fresh.project().load, held.load);
}

TEST_F(AutosaveTest, RecoversAProjectWhoseOwnFileIsBrokenAndKeepsItUnsaved) {
  const QString file = folder.filePath("mine.json");
  Project mine = quickProject();
  mine.load.areas[0].force_N.z() = -2.5;
  const QByteArray text = projectText(mine);
  writeFile(file.toStdString(), text.left(text.size() / 2).toStdString(), true); // as a power cut leaves it
  recoverInto(window, *autosave, leaveProject(mine, file));
  EXPECT_EQ(workbench.project().load, mine.load);
  EXPECT_EQ(workbench.file(), file);
  EXPECT_TRUE(window.isWindowModified());
  EXPECT_TRUE(find<QPlainTextEdit>("messageLines").toPlainText().contains("mine.json"));
}

TEST_F(AutosaveTest, WhatHadNoFileIsNoEditOfTheFileThatIsOpen) {
  const QString file = folder.filePath("open.json");
  workbench.saved(file);
  Project other = quickProject();
  other.load.areas[0].force_N.z() = -2.5;
  recoverInto(window, *autosave, leaveProject(other, {}));
  EXPECT_EQ(workbench.project().load, other.load);
  EXPECT_EQ(workbench.file(), "") << "saving would replace another project";
}

TEST_F(AutosaveTest, TwoWindowsDoNotOfferTheSameWork) {
  const QString left = leaveProject(quickProject(), {});
  {
    const std::vector<LeftWork> offered = Autosave::left(left);
    ASSERT_EQ(offered.size(), 1U);
    EXPECT_TRUE(Autosave::left(left).empty()) << "while it is offered";
  }
  EXPECT_EQ(Autosave::left(left).size(), 1U) << "asked again later";
}

TEST_F(AutosaveTest, TheCopyThatWasRecoveredIsGoneWhenTheWindowEndsAsItShould) {
  const QString left = leaveProject(quickProject(), {});
  recoverInto(window, *autosave, left);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !network.working(); }, kPatience_ms));
  EXPECT_TRUE(QFileInfo::exists(left + "/window/project.json"));
  autosave.reset();
  EXPECT_TRUE(QDir(left).isEmpty());
}

TEST_F(AutosaveTest, WhereNothingCanBeKeptTheWindowStartsAndSaysSoOnce) {
  writeFile(folder.filePath("file").toStdString(), "", true);
  Autosave nowhere(workbench, network, window, folder.filePath("file/recovery"));
  QStringList said;
  QObject::connect(&nowhere, &Autosave::failed, [&said](const QString& sentence) { said << sentence; });
  ASSERT_TRUE(QTest::qWaitFor([&] { return !said.isEmpty(); }, kPatience_ms));
  EXPECT_TRUE(said[0].contains("file/recovery")) << said[0].toStdString();
  press(-2.5);
  ASSERT_TRUE(kept("project.json")) << "the other one keeps it";
  EXPECT_EQ(said.size(), 1);
}

TEST_F(AutosaveTest, KeepsNoNetworkOfAProjectThatWasDiscarded) {
  ASSERT_TRUE(generated(2, 1));
  network.train(workbench.project().network);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr && !network.working(); }, kPatience_ms));
  ASSERT_TRUE(kept("results/networks"));
  workbench.replace(quickProject());
  ASSERT_TRUE(generated(2, 2)); // of the same design
  ASSERT_TRUE(kept("project.json")) << "that of the discarded project goes at once";
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return QDir(folder.filePath("r")).entryList(QDir::Dirs | QDir::NoDotAndDotDot).size() == 1; },
      kPatience_ms))
      << "the copy of the discarded project stays";
  ASSERT_TRUE(kept("results/samples.csv"));
  EXPECT_TRUE(
      openResults((copyOfLeft() + "/window/results").toStdString(), quickProject().design, {}).results.kept.empty());
}

TEST_F(AutosaveTest, KeepsASweepThatWasMadeAfterTheSamplesWereKept) {
  ASSERT_TRUE(generated(2, 1));
  ASSERT_TRUE(kept("results/samples.csv"));
  NetworkSettings settings = workbench.project().network;
  settings.sweepCount = 2;
  network.sweep(settings);
  EXPECT_TRUE(kept("results/sweeps.json"));
}

TEST_F(AutosaveTest, TheNextStartNamesTheRecordingThatWasCut) {
  const QString file = folder.filePath("touch.palprec");
  RecordingHead head;
  head.source = "a board";
  RecordingWriter(file.toStdString(), head, false);
  emit window.recordingsChanged({file});
  ASSERT_TRUE(kept("recordings.txt"));
  const QString left = copyOfLeft(); // as after a kill
  emit window.recordingsChanged({});
  const QDir root(folder.filePath("r"));
  for (const QString& one : root.entryList(QDir::Dirs | QDir::NoDotAndDotDot))
    EXPECT_FALSE(QFileInfo::exists(root.filePath(one) + "/recordings.txt")) << "it ended as it should";
  offerRecovery(window, *autosave, left);
  auto* box = window.findChild<QMessageBox*>("cutRecordings");
  ASSERT_NE(box, nullptr);
  EXPECT_TRUE(box->text().contains(file + ": readable")) << box->text().toStdString();
  box->close();
  EXPECT_TRUE(QDir(left).isEmpty()) << "said once";
}

} // namespace
} // namespace palp
