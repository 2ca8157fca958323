#include "app/gui/document/Document.h"
#include "app/gui/import/ImportDialog.h"
#include "app/gui/network/words/SamplesWords.h"
#include "app/gui/project/FileKind.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/views/HeatmapView.h"
#include "app/study/Resources.h"
#include "app/study/live/LiveSource.h"
#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "io/SampleFile.h"
#include "tests/app/gui/WindowFixture.h"

#include <QDir>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStatusBar>
#include <QTemporaryDir>

namespace palp {
namespace {

class OpenFiles : public WindowFixture {
protected:
  OpenFiles() {
    QObject::connect(&closer_, &QTimer::timeout, &closer_, [this] {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        said = box->text();
        box->close();
      }
    });
    closer_.start(20);
  }
  void generate() {
    window.showScene("network");
    find<QPushButton>("generate").click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
  QString inFolder(const char* name) { return folder_.filePath(name); }

  QString said; ///< by the last box, which was closed

private:
  QTemporaryDir folder_;
  QTimer closer_;
};

TEST_F(OpenFiles, SavesSamplesAndOpensThemAgainInANewSession) {
  generate();
  const SampleSet training = network.samples()->training, test = network.samples()->test;
  for (const char* ending : {".csv", ".h5", ".npz"}) {
    const QString file = inFolder("mine") + ending;
    answerFileDialog(file);
    find<QPushButton>("saveSamples").click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFile::exists(file) && !window.busy(); }, kPatience_ms))
        << said.toStdString() << find<QPlainTextEdit>("messageLines").toPlainText().toStdString();
    EXPECT_TRUE(QFile::exists(inFolder("mine-test") + ending));
    network.clear();
    ASSERT_EQ(network.samples(), nullptr);
    answerFileDialog(file);
    find<QPushButton>("openSamples").click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms)) << ending;
    EXPECT_EQ(network.samples()->training.resistances_ohm, training.resistances_ohm);
    EXPECT_EQ(network.samples()->test.forces_N, test.forces_N);
    EXPECT_TRUE(network.upToDate());
  }
}

TEST_F(OpenFiles, TakesTheTestSamplesThatTheCommandLineNamesBesideItsTrainingSamples) {
  generate();
  const SampleSet training = network.samples()->training, test = network.samples()->test;
  saveSamples(inFolder("train.csv").toStdString(), training, true);
  saveSamples(inFolder("test.csv").toStdString(), test, true);
  network.clear();
  window.document().open(inFolder("train.csv"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms)) << said.toStdString();
  EXPECT_EQ(network.samples()->training.forces_N, training.forces_N);
  EXPECT_EQ(network.samples()->test.forces_N, test.forces_N);
}

TEST_F(OpenFiles, JoinsDroppedShardsAndKeepsEveryFifthSampleForTesting) {
  generate();
  const SampleSet all = network.samples()->training;
  SampleSet first = all, second = all;
  const Eigen::Index half = all.size() / 2;
  for (SampleSet* part : {&first, &second}) {
    const bool later = part == &second;
    part->area = later ? all.area.tail(all.size() - half).eval() : all.area.head(half).eval();
    const auto columns = [&](const Eigen::MatrixXd& values) -> Eigen::MatrixXd {
      return later ? values.rightCols(all.size() - half) : values.leftCols(half);
    };
    part->forces_N = columns(all.forces_N);
    part->displacements_mm = columns(all.displacements_mm);
    part->resistances_ohm = columns(all.resistances_ohm);
  }
  second.origin.firstSample = static_cast<std::size_t>(half);
  second.origin.madeBy = "palp 0.1, avx2";
  saveSamples(inFolder("a.npz").toStdString(), second, false); // in the wrong order
  saveSamples(inFolder("b.h5").toStdString(), first, false);
  network.clear();
  window.showScene("design");
  window.document().open(QStringList{inFolder("a.npz"), inFolder("b.h5")});
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms)) << said.toStdString();
  EXPECT_EQ(window.currentScene().objectName(), "network");
  EXPECT_EQ(network.samples()->training.size() + network.samples()->test.size(), all.size());
  EXPECT_EQ(network.samples()->test.size(), 6) << "one of the six on each area";
  EXPECT_EQ(network.samples()->training.forces_N.leftCols(4), all.forces_N.leftCols(4));
  EXPECT_TRUE(samplesWords(network).contains("made by several programs: ")) << samplesWords(network).toStdString();
}

TEST_F(OpenFiles, RefusesOnePartAloneAndSamplesOfAnotherDesign) {
  generate();
  SampleSet part = network.samples()->training;
  const NetworkSamples* before = network.samples();
  part.origin.firstSample = 36;
  saveSamples(inFolder("second.csv").toStdString(), part, false);
  QString failed;
  QObject::connect(&network.runner(), &JobRunner::failed, [&](const QString& sentence) { failed = sentence; });
  dropOn(window, inFolder("second.csv"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !failed.isEmpty(); }, kPatience_ms));
  EXPECT_TRUE(failed.contains("begin with number 36")) << failed.toStdString();
  part.origin.firstSample = 0;
  part.origin.designFingerprint = "0123456789abcdef";
  saveSamples(inFolder("other.csv").toStdString(), part, false);
  failed.clear();
  dropOn(window, inFolder("other.csv"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !failed.isEmpty(); }, kPatience_ms));
  EXPECT_TRUE(failed.contains("0123456789abcdef")) << failed.toStdString();
  EXPECT_EQ(network.samples(), before) << "what was there stays";
}

TEST_F(OpenFiles, ADroppedFileGoesWhereItBelongs) {
  dropOn(window, QString::fromStdString(resource("paper.json").string()));
  EXPECT_EQ(workbench.project().design, paperDesign());
  EXPECT_TRUE(workbench.file().isEmpty()) << "a design alone is no project to be overwritten";
  const QString decoder = QString::fromStdString(shippedNetwork().string());
  dropOn(window, decoder); // there are no samples to try it on
  EXPECT_EQ(window.currentScene().objectName(), "live");
  EXPECT_EQ(QString::fromStdString(workbench.project().live.network), decoder);
  generate();
  dropOn(window, decoder);
  EXPECT_EQ(window.currentScene().objectName(), "network");
  EXPECT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  QFile recording(inFolder("touch.palprec"));
  ASSERT_TRUE(recording.open(QIODevice::WriteOnly));
  recording.write("PALPREC1");
  recording.close();
  dropOn(window, inFolder("touch.palprec"));
  EXPECT_EQ(window.currentScene().objectName(), "live");
  EXPECT_EQ(workbench.project().live.source, LiveSourceKind::Recording);
}

TEST_F(OpenFiles, ADesignUnderTheFieldOpensSavesAndComesBackAsAny) {
  SensorDesign design = paperDesign();
  design.resistance = FieldLaw{.electrodeRadius_mm = 0.25, .readout = Readout::VirtualGround};
  saveDesign(inFolder("field.json").toStdString(), design, false);
  dropOn(window, inFolder("field.json"));
  EXPECT_EQ(said, "");
  EXPECT_EQ(workbench.project().design, design);
  answerFileDialog(inFolder("project.json"));
  QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.file() == inFolder("project.json"); }, kPatience_ms));
  ASSERT_TRUE(idle());
  EXPECT_FALSE(window.isWindowModified());
  workbench.history().undo();
  EXPECT_EQ(workbench.project().design, design) << "undo ends where a file was opened";
  window.document().startAnew();
  dropOn(window, inFolder("project.json"));
  EXPECT_EQ(said, "");
  EXPECT_EQ(workbench.project().design, design);
  EXPECT_TRUE(idle());
}

TEST_F(OpenFiles, ALargeProjectIsOneThoughItsKeyStandsBehindADesignsAndAllElse) {
  const QString file = inFolder("large.json");
  writeFile(file.toStdString(),
            R"({"design": {"palp_design": 1}, "design_studies": ")" + std::string(100000, 'x') +
                R"(", "palp_project": 2})",
            true);
  EXPECT_EQ(fileKind(file), FileKind::Project);
}

TEST_F(OpenFiles, NamesAWrongFileByWhatItIs) {
  const Project before = workbench.project();
  QImage(4, 4, QImage::Format_RGB32).save(inFolder("picture.json"), "PNG");
  dropOn(window, inFolder("picture.json"));
  EXPECT_TRUE(said.contains("PNG")) << said.toStdString();
  EXPECT_TRUE(said.contains("samples (.csv, .h5, .npz)")) << said.toStdString();
  QFile empty(inFolder("empty.json"));
  ASSERT_TRUE(empty.open(QIODevice::WriteOnly));
  empty.close();
  dropOn(window, inFolder("empty.json"));
  EXPECT_TRUE(said.contains("empty")) << said.toStdString();
  dropOn(window, inFolder("none.json"));
  EXPECT_TRUE(said.contains("cannot be read")) << said.toStdString();
  dropOn(window, inFolder(""));
  EXPECT_TRUE(said.contains("folder")) << said.toStdString();
  EXPECT_EQ(workbench.project(), before);
}

TEST_F(OpenFiles, AProjectComesBackWithItsSamplesAndItsNetwork) {
  generate();
  find<QPushButton>("train").click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(window.isWindowModified()) << "samples that no file holds are unsaved work";
  answerFileDialog(inFolder("p.json"));
  ASSERT_TRUE(window.document().save());
  EXPECT_EQ(window.statusBar()->currentMessage(),
            "Saved " + inFolder("p.json") + "; its samples and networks are in the folder p.palp next to it.");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.isWindowModified(); }, kPatience_ms));
  const Eigen::MatrixXd predicted = network.fit()->prediction.forces_N;

  QFile foreign(inFolder("p.palp/networks/notes.json"));
  ASSERT_TRUE(foreign.open(QIODevice::WriteOnly));
  foreign.close();
  ASSERT_TRUE(window.document().save());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.busy(); }, kPatience_ms));
  EXPECT_TRUE(foreign.exists()) << "a file of somebody else's";

  Workbench fresh(exampleProject());
  NetworkSession other;
  MainWindow next(fresh, other);
  next.show();
  dropOn(next, inFolder("p.json"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return other.fit() != nullptr; }, kPatience_ms)) << said.toStdString();
  EXPECT_EQ(other.fit()->prediction.forces_N, predicted);
  EXPECT_FALSE(next.isWindowModified());
  next.document().startAnew();
  EXPECT_EQ(other.samples(), nullptr) << "what the project held is given back";
  fresh.history().undo();
  EXPECT_EQ(other.samples(), nullptr) << "undo ends where a project begins";
}

TEST_F(OpenFiles, AProjectWithOneBrokenNetworkOpensWithTheOthersAndSavingLeavesItThere) {
  generate();
  for (int k = 0; k < 2; ++k) {
    Project next = workbench.project();
    next.network.chosenSpread = 1 + k; // equal networks stand once in the list
    workbench.edit("spread", next);
    find<QPushButton>("train").click();
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return network.kept().size() == static_cast<std::size_t>(k + 1); }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
  answerFileDialog(inFolder("p.json"));
  ASSERT_TRUE(window.document().save());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window.isWindowModified(); }, kPatience_ms));
  const QDir networks(inFolder("p.palp/networks"));
  const QStringList files = networks.entryList({"*.network.json"}, QDir::Files, QDir::Name);
  ASSERT_EQ(files.size(), 2);
  QFile broken(networks.filePath(files[0]));
  ASSERT_TRUE(broken.open(QIODevice::ReadWrite));
  ASSERT_TRUE(broken.resize(100));
  broken.close();

  Workbench fresh(exampleProject());
  NetworkSession other;
  MainWindow next(fresh, other);
  next.show();
  dropOn(next, inFolder("p.json"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return other.kept().size() == 1; }, kPatience_ms));
  next.showScene("network");
  auto* problem = next.findChild<QLabel*>("trainingProblem");
  EXPECT_TRUE(problem->isVisible());
  EXPECT_TRUE(problem->text().contains(files[0])) << problem->text().toStdString();
  EXPECT_FALSE(next.isWindowModified());
  Project another = fresh.project();
  another.network.chosenSpread = 3;
  fresh.edit("spread", another);
  next.findChild<QPushButton*>("train")->click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return other.kept().size() == 2 && !next.busy(); }, kPatience_ms));
  ASSERT_TRUE(next.document().save());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !next.isWindowModified(); }, kPatience_ms));
  EXPECT_EQ(broken.size(), 100);
  EXPECT_EQ(networks.entryList({"*.network.json"}, QDir::Files).size(), 3);
}

TEST_F(OpenFiles, AsksBeforeTestSamplesOfAnotherFileAreReplaced) {
  generate();
  QFile test(inFolder("mine-test.csv"));
  ASSERT_TRUE(test.open(QIODevice::WriteOnly));
  test.close();
  answerFileDialog(inFolder("mine.csv"));
  find<QPushButton>("saveSamples").click(); // the question is closed, which means no
  EXPECT_TRUE(said.contains("mine-test.csv")) << said.toStdString();
  ASSERT_TRUE(idle());
  EXPECT_EQ(test.size(), 0);
  EXPECT_FALSE(QFile::exists(inFolder("mine.csv")));
}

TEST_F(OpenFiles, SamplesThatTookLongAreAskedAboutHoweverOthersComeAndNotForWhatIsNoFileOfSamples) {
  generate();
  const QString other = inFolder("other.csv"), foreign = inFolder("foreign.csv");
  network.saveSamples(other.toStdString());
  ASSERT_TRUE(idle());
  const_cast<NetworkSamples*>(network.samples())->seconds = 100; // NOLINT: no test waits for samples that take so long
  const auto before = network.sharedSamples();
  writeFile(foreign.toStdString(), "a,b\n1,2\n", true);
  window.showScene("network");
  const auto asked = [&](const QString& file, bool dropped) {
    said.clear();
    if (dropped) {
      dropOn(window, file);
    } else {
      answerFileDialog(file);
      find<QPushButton>("openSamples").click();
    }
    return said;
  };
  for (const bool dropped : {false, true})
    EXPECT_TRUE(asked(other, dropped).contains("have not been saved")) << dropped << said.toStdString();
  for (const bool dropped : {false, true}) {
    EXPECT_EQ(asked(foreign, dropped), QString()) << "nothing would come in their place yet";
    auto* import = window.findChild<ImportDialog*>();
    ASSERT_NE(import, nullptr) << "a table of another program";
    import->reject();
    EXPECT_TRUE(QTest::qWaitFor([&] { return window.findChild<ImportDialog*>() == nullptr; }, kPatience_ms));
  }
  EXPECT_EQ(network.sharedSamples(), before) << "the question was closed, which means no";

  // Opened from a file, after others were there: they stand in one.
  network.generate({2, 77}, workbench.project().mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sharedSamples() != before && !network.working(); }, kPatience_ms));
  network.openSamples({other.toStdString()});
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sharedSamples() == before && !network.working(); }, kPatience_ms));
  EXPECT_EQ(asked(other, true), QString());
}

TEST_F(OpenFiles, OpensADroppedProjectInItsScene) {
  ASSERT_TRUE(solved());
  Project project = quickProject();
  project.load.areas[0].force_N = {0, 0, -2};
  project.view.scene = "resistance";
  project.view.cell = {2, 7};
  const std::string file = inFolder("p.json").toStdString();
  saveProject(file, project);
  dropOn(window, QString::fromStdString(file));
  EXPECT_EQ(said, "");
  EXPECT_EQ(workbench.project(), project);
  EXPECT_EQ(window.currentScene().objectName(), "resistance");
  ASSERT_TRUE(solved());
  settle();
  EXPECT_EQ(find<HeatmapView>("resistanceHeatmap").heatmap().selected, (std::array{2, 7}));
}

TEST_F(OpenFiles, RefusesABrokenFileWithASentenceAndGoesOnWithWhatItHad) {
  ASSERT_TRUE(solved());
  const Project before = workbench.project();
  const QString file = inFolder("p.json");
  saveProject(file.toStdString(), before);
  QFile text(file);
  ASSERT_TRUE(text.open(QIODevice::ReadWrite));
  ASSERT_TRUE(text.resize(text.size() / 3));
  text.close();
  dropOn(window, file);
  EXPECT_TRUE(said.contains("not valid JSON: the file ends early, at line ")) << said.toStdString();
  EXPECT_TRUE(said.contains("is unchanged")) << said.toStdString();
  EXPECT_EQ(workbench.project(), before);
  EXPECT_TRUE(workbench.touch().upToDate());
}

} // namespace
} // namespace palp
