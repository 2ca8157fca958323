#include "app/gui/jobs/samples/SampleFiles.h"
#include "app/gui/network/words/ErrorWords.h"
#include "app/gui/project/Command.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/DataTable.h"
#include "tests/app/gui/network/NetworkSceneFixture.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QTemporaryDir>

#include <cmath>

namespace palp {
namespace {

/// Twenty touches of a large sphere on a mesh so coarse that it touches some nodes.
class SampledTouches : public NetworkScene {
protected:
  SampledTouches() {
    Project next = workbench.project();
    next.mesh.mapped = {12, 12, 3};
    next.network.rows = "all";
    next.network.input = InputKind::Resistance;
    workbench.edit("a coarse mesh", next);
    choose("sampleKind", 1);
    setNumber("touchRadiusMaximum", 9);
    setNumber("touchRadiusMinimum", 7);
    setNumber("touchPressMaximum", 3);
    setNumber("touchPressMinimum", 1);
    auto& count = find<QSpinBox>("touchCount");
    count.setFocus();
    count.selectAll();
    QTest::keyClicks(&count, "20");
    QTest::keyClick(&count, Qt::Key_Return);
  }
  /// Of places that are all wrong by more than the block is wide.
  void expectWarningOfAGuess() {
    NetworkFit wrong = *network.fit();
    wrong.prediction.places_mm.array() += 40;
    const auto [its, guess] = againstAGuess(*network.samples(), wrong);
    EXPECT_LT(guess.places_mm.maxCoeff(), 12) << "24 mm wide";
    EXPECT_GT(its.places_mm.minCoeff(), 20);
    const QString words = guessWords(network, wrong);
    EXPECT_TRUE(words.contains("worse than always predicting")) << words.toStdString();
    EXPECT_TRUE(words.contains("position x") && words.contains("position y") && !words.contains("Fz"))
        << words.toStdString();
  }
  [[nodiscard]] const TouchSampling& touches() const { return *workbench.project().samples.touches; }
};

TEST_F(SampledTouches, AreThoseOfTheCommandLine) {
  EXPECT_FALSE(find<QSpinBox>("perArea").isVisible());
  EXPECT_EQ(touches().count, 20);
  EXPECT_EQ(touches().smallest_mm, 7);
  EXPECT_EQ(touches().largest_mm, 9);
  EXPECT_EQ(touches().margin_mm, 3) << "as palp sample has it";
  const QString commands = sampleCommands(workbench.project(), "sensor.json");
  EXPECT_TRUE(commands.startsWith(
      "palp sample sensor.json --touch sphere:7..9@3,3,27,27 --force-range 1..3 --count 20 --seed 1 --mapped 12x12x3"))
      << commands.toStdString();
  const Project back = parseProject(projectText(workbench.project()), "p.json", exampleProject());
  EXPECT_EQ(back.samples, workbench.project().samples);

  setNumber("touchMargin", 16);
  EXPECT_FALSE(find<QPushButton>("generate").isEnabled());
  EXPECT_TRUE(find<QLabel>("touchProblem").text().contains("Margin to the edges: got 16 mm, expected at most 15 mm"))
      << find<QLabel>("touchProblem").text().toStdString();
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(touches().margin_mm, 3);
  EXPECT_TRUE(find<QPushButton>("generate").isEnabled());

  choose("sampleKind", 0);
  EXPECT_FALSE(workbench.project().samples.touches);
  EXPECT_TRUE(find<QSpinBox>("perArea").isVisible());
  choose("sampleKind", 1);
  EXPECT_EQ(touches().count, 20) << "they are as they were";
}

TEST_F(SampledTouches, TeachANetworkForceAndPlace) {
  generate();
  ASSERT_EQ(network.samples()->training.size(), 20);
  ASSERT_EQ(network.samples()->test.size(), 20);
  for (Eigen::Index i = 0; i < 20; ++i) {
    const Indenter drawn = touchAt(rangeOf(touches(), workbench.project().design), 1, static_cast<std::size_t>(i));
    EXPECT_EQ(network.samples()->training.touches(kTouchX_mm, i), drawn.place_mm.x());
    EXPECT_EQ(network.samples()->training.forces_N(2, i), drawn.press()->force_N.z());
  }
  trained();
  EXPECT_FALSE(find<ChartView>("placeError").isVisibleTo(&window)) << "forces alone were learned";
  EXPECT_FALSE(find<QLabel>("fitWords").text().contains("position x"));
  choose("target", 1); // trains at once
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->error.place.has_value(); }, kPatience_ms));
  ASSERT_TRUE(idle());
  settle();
  EXPECT_LT(network.fit()->error.place->median_mm, 6) << "a guess is some 11 mm off";
  EXPECT_TRUE(find<QLabel>("fitWords").text().contains("position x")) << "in the table of errors";
  EXPECT_FALSE(find<QLabel>("fitWords").text().contains("worse than always predicting"));
  expectWarningOfAGuess();
  EXPECT_TRUE(find<QLabel>("fitWords").text().contains("Its positions are"))
      << find<QLabel>("fitWords").text().toStdString();
  EXPECT_EQ(find<ChartView>("placeError").chart().series[0].x.size(), 20u);

  EXPECT_FALSE(find<QLabel>("fitWords").text().contains("Bounds (Cramer-Rao")) << "without noise there are none";
  setNumber("noise", 0.01);
  setNumber("testNoise", 0.01);
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return find<QLabel>("fitWords").text().contains("Bounds (Cramer-Rao"); }, kPatience_ms))
      << find<QLabel>("fitWords").text().toStdString();
  ASSERT_TRUE(idle());
  EXPECT_FALSE(find<QLabel>("fitWords").text().contains("by its own model")) << "radial bases say none";
  SampleBounds learned; // training a decoder that says them takes most of a minute
  learned.learned.assign(20, {Eigen::Vector3d(0.1, 0.1, 0.125), Eigen::Vector2d(0.3, 0.4)});
  EXPECT_TRUE(boundWords(network, *network.fit(), &learned)
                  .contains("at each touch, by its own model, medians): Fz 0.125 N, position 0.5 mm; its errors are "));

  QTemporaryDir folder;
  const std::filesystem::path file = folder.filePath("touches.csv").toStdString();
  network.saveSamples(file);
  ASSERT_TRUE(QTest::qWaitFor([&] { return std::filesystem::exists(file) && !network.writer().running(); }, 10000));
  const NetworkSamples opened = openSampleFiles({file}, workbench.project().design, {});
  EXPECT_EQ(opened.test.touches, network.samples()->test.touches);
  EXPECT_EQ(countWords(opened.settings), "20 touches");
}

TEST(ErrorWords, AForceThatWasNeverTrainedHasNoError) {
  Decoder decoder;
  decoder.low_N = Eigen::Vector3d(0, -1, -6);
  decoder.high_N = Eigen::Vector3d(0, 1, 0);
  const Eigen::VectorXd errors = ofForces(Eigen::Vector3d(0, 0, 2), decoder);
  EXPECT_TRUE(std::isnan(errors(0)));
  EXPECT_EQ(errors(1), 0) << "it was trained and is right";
  EXPECT_EQ(errors(2), 2) << "of one sign alone";
}

} // namespace
} // namespace palp
