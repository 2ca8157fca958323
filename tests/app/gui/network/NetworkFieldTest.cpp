#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/jobs/samples/SampleFiles.h"
#include "app/study/decoding/DecoderTraining.h"
#include "app/study/touch/SampleGenerator.h"
#include "io/DesignFile.h"
#include "tests/app/gui/WindowFixture.h"

#include <QDir>
#include <QFile>
#include <QLabel>
#include <QProcess>
#include <QPushButton>
#include <QTemporaryDir>

namespace palp {
namespace {

/// The Network scene of a design under the conduction field.
class NetworkField : public WindowFixture {
protected:
  NetworkField() {
    Project next = workbench.project();
    next.design.resistance = FieldLaw{.readout = Readout::VirtualGround};
    next.design.areas = {1, 2}; // few states
    next.load.areas[0].area = 0;
    next.mesh.mapped = {5, 5, 2};
    next.samples.perArea = 1;
    next.network.input = InputKind::Resistance;
    next.network.rows = "all";
    workbench.edit("field", next);
    window.showScene("network");
    EXPECT_TRUE(solved());
  }
  void click(const char* name) { QTest::mouseClick(&find<QPushButton>(name), Qt::LeftButton); }
  void generate() {
    ASSERT_TRUE(find<QPushButton>("generate").isEnabled());
    click("generate");
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms))
        << find<QLabel>("trainingProblem").text().toStdString();
    ASSERT_TRUE(idle());
  }
  static QByteArray bytes(const QString& file) {
    QFile in(file);
    return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
  }
};

TEST_F(NetworkField, MakesTheSamplesThatPalpMakesToTheByte) {
  const QString program = QDir(QCoreApplication::applicationDirPath()).filePath("palp");
  if (!QFile::exists(program)) GTEST_SKIP() << program.toStdString() << " was not built";
  const QTemporaryDir folder;
  const QString design = folder.filePath("design.json"), theirs = folder.filePath("palp.csv");
  saveDesign(design.toStdString(), workbench.project().design, true);
  for (const bool surrogate : {false, true}) {
    Project next = workbench.project();
    next.samples.surrogate = surrogate;
    workbench.edit("surrogate", next);
    generate();
    const QString ours = folder.filePath(surrogate ? "surrogate.csv" : "full.csv");
    saveSampleFiles(ours.toStdString(), *network.samples());
    for (const bool test : {false, true}) {
      if (test && surrogate) continue; // another minute for what the full solves show
      QStringList arguments{"sample", design, "--per-area", "1",    "--mapped", "5x5x2",
                            "--seed", "1",    "-o",         theirs, "--force"};
      if (test) arguments[7] = QString::number(network.samples()->test.origin.seed);
      if (surrogate) arguments << "--surrogate";
      QProcess palp;
      palp.start(program, arguments);
      ASSERT_TRUE(palp.waitForFinished(kPatience_ms));
      ASSERT_EQ(palp.exitCode(), 0) << palp.readAllStandardError().toStdString();
      const QString file = test ? QString::fromStdString(testFileOf(ours.toStdString()).string()) : ours;
      EXPECT_FALSE(bytes(file).isEmpty());
      EXPECT_EQ(bytes(file), bytes(theirs)) << surrogate << test;
    }
    network.clear();
  }
}

TEST_F(NetworkField, TrainsSweepsAndComparesOnThem) {
  Project next = workbench.project();
  next.samples.perArea = 12;
  workbench.edit("more", next);
  generate();
  click("train");
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(idle());
  const NetworkSettings& settings = workbench.project().network;
  const SensorDesign& design = workbench.project().design;
  const Decoder alone = trainDecoder(network.samples()->training, &design, settings.trainOptions());
  EXPECT_EQ(network.fit()->prediction.forces_N.cols(), network.samples()->test.size());
  const auto found = triedOn(alone, *network.samples());
  EXPECT_EQ(network.fit()->decoder.report.spread, alone.report.spread) << "as palp train";
  EXPECT_GT(found->prediction.forces_N.cols(), 0);
  click("sweep");
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sweepPoints().size() == 3; }, kPatience_ms));
  ASSERT_TRUE(idle());
  click("compare");
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == decodersWith(&DecoderTraits::ofAreas).size(); },
                              kPatience_ms));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(network.trials()[0].refusal.isEmpty()) << network.trials()[0].refusal.toStdString();
}

TEST_F(NetworkField, SaysWhichSurrogateIsFittedAndStops) {
  Project next = workbench.project();
  next.samples.surrogate = true;
  workbench.edit("surrogate", next);
  QStringList said;
  QObject::connect(&network.runner(), &JobRunner::progressed, &window,
                   [&](double, const QString& words) { said << words; });
  click("generate");
  ASSERT_TRUE(QTest::qWaitFor([&] { return said.filter("Surrogate of area").size() > 0; }, kPatience_ms));
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  EXPECT_EQ(network.samples(), nullptr);
  generate();
  EXPECT_EQ(network.samples()->training.size(), 2);
}

} // namespace
} // namespace palp
