#include "app/gui/jobs/samples/ResultFiles.h"
#include "io/AtomicFile.h"
#include "io/ImportSamples.h"
#include "tests/app/gui/network/NetworkSceneFixture.h"

#include <QLabel>
#include <QSpinBox>
#include <QTemporaryDir>

#include <cmath>

namespace palp {
namespace {

namespace fs = std::filesystem;

constexpr int kRigRows = 12, kRigColumns = 3, kRigAreas = 8; // the design that is open has 10, 30 and 6

/// Samples of a rig of which no design is open, in the Network scene.
class ImportedSamples : public NetworkScene {
protected:
  /// A table in which each resistance answers the force and the area in its own way.
  fs::path imported(const std::string& name, int samples, double zero_ohm) const {
    std::string table = "pad,Fx,Fy,Fz";
    for (int k = 0; k < kRigRows * kRigColumns; ++k)
      table += ",R" + std::to_string(k / kRigColumns) + "_" + std::to_string(k % kRigColumns);
    for (int i = 0; i < samples; ++i) {
      const double x = std::sin(1.7 * i), y = std::sin(2.9 * i + 1), z = -3 + 2 * std::sin(4.1 * i + 2);
      const int pad = i % kRigAreas;
      table += "\n" + std::to_string(pad) + "," + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z);
      for (int k = 0; k < kRigRows * kRigColumns; ++k)
        table += "," + std::to_string(500 + 5 * (x * std::sin(k) + y * std::cos(3 * k) + z * std::sin(5 * k)) +
                                      2 * std::sin(k * (pad + 1)));
    }
    writeFile(folder() / (name + "-table.csv"), table + "\n", true);
    writeFile(
        folder() / (name + ".json"),
        R"({"palp_import": 1, "resistances": {"columns": "R{row}_{column}", "row_wires": 12, "column_wires": 3,)"
        R"( "unit": "code", "ohm_per_code": 1, "zero_ohm": )" +
            std::to_string(zero_ohm) +
            R"(}, "forces": {"columns": ["Fx", "Fy", "Fz"], "unit": "N"}, "area": {"column": "pad", "count": 8}})",
        true);
    const fs::path samplesFile = folder() / (name + ".h5");
    importSamples({{folder() / (name + "-table.csv")}, folder() / (name + ".json"), nullptr, samplesFile, true}, {},
                  {});
    return samplesFile;
  }
  /// The samples from these files are those that are there.
  void open(const std::vector<fs::path>& files) {
    network.openSamples(files);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms))
        << find<QLabel>("trainingProblem").text().toStdString();
    ASSERT_TRUE(idle());
  }
  /// The settings for what a board reads.
  void readAllResistances() {
    Project next = workbench.project();
    next.network.input = InputKind::Resistance;
    next.network.rows = "all";
    next.network.noise = 1e-4;
    workbench.edit("resistances", next);
  }
  [[nodiscard]] fs::path folder() const { return folder_.path().toStdString(); }

private:
  QTemporaryDir folder_;
};

TEST_F(ImportedSamples, OpenAndTrainWithoutADesign) {
  open({imported("train", 240, 0), imported("tried", 80, 0)});
  EXPECT_TRUE(network.upToDate());
  EXPECT_EQ(network.samples()->training.size(), 240);
  EXPECT_EQ(network.samples()->test.size(), 80) << "the file that is named second tests";
  EXPECT_TRUE(find<QLabel>("samplesWords").text().contains("train.h5 (measured"))
      << find<QLabel>("samplesWords").text().toStdString();
  EXPECT_EQ(find<QSpinBox>("testArea").maximum(), kRigAreas - 1);

  auto& rows = find<QLineEdit>("rows");
  rows.selectAll();
  QTest::keyClicks(&rows, "11"); // a row-wire that the design does not have
  QTest::keyClick(&rows, Qt::Key_Return);
  EXPECT_TRUE(find<QLabel>("rowsProblem").isHidden());
  EXPECT_EQ(workbench.project().network.rows, "11");

  readAllResistances();
  trained();
  EXPECT_EQ(network.fit()->decoder.designFingerprint, network.samples()->training.origin.designFingerprint);
  EXPECT_LT(network.fit()->error.error.rmsePercentOfRange.maxCoeff(), 5);
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == decodersWith(&DecoderTraits::ofAreas).size(); },
                              kPatience_ms));
  ASSERT_TRUE(idle());
  for (const DecoderTrial& trial : network.trials())
    EXPECT_EQ(trial.refusal.isEmpty(),
              trial.kind != DecoderKind::TwoStepBackPropagation && trial.kind != DecoderKind::TwoStepGaussNewton)
        << "those need the displacements or the design: " << trial.refusal.toStdString();

  const fs::path results = folder() / "project.palp"; // with the project
  saveResults(results, network.results(), {});
  const OpenedResults again = openResults(results, workbench.project().design, {});
  EXPECT_EQ(again.problems, std::vector<std::string>{});
  EXPECT_EQ(again.ofOtherDesigns, 0);
  EXPECT_EQ(again.results.kept.size(), 1U);
  ASSERT_TRUE(again.results.samples);
  EXPECT_EQ(again.results.samples->training.resistances_ohm, network.samples()->training.resistances_ohm);
}

TEST_F(ImportedSamples, OfTwoRigsAreRefusedAndASingleFileTestsWithEveryFifth) {
  const fs::path one = imported("train", 80, 0);
  const fs::path other = imported("test", 40, 7); // lies beside it, and is of another rig
  network.openSamples({one, other});
  auto& problem = find<QLabel>("trainingProblem");
  ASSERT_TRUE(QTest::qWaitFor([&] { return problem.text().contains("another design or rig"); }, kPatience_ms))
      << problem.text().toStdString();
  EXPECT_EQ(network.samples(), nullptr);
  open({one});
  EXPECT_EQ(network.samples()->training.size(), 64) << "two of the ten on each area test";
  EXPECT_TRUE(network.samples()->split);
}

} // namespace
} // namespace palp
