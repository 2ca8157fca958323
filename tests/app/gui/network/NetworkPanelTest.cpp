#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/network/NetworkCharts.h"
#include "app/gui/network/words/FitWords.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/CsvExport.h"
#include "app/gui/views/DataTable.h"
#include "app/study/Resources.h"
#include "app/study/decoding/TrainOptionTable.h"
#include "app/study/live/LiveSource.h"
#include "tests/app/gui/network/NetworkSceneFixture.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>

namespace palp {
namespace {

using NetworkPanel = NetworkScene;

TEST_F(NetworkPanel, SaysErrorsWhereOneLooksUntilTheNextWorkBegins) {
  generate();
  answerFileDialog(QString::fromStdString(resource("paper.json").string())); // a design is no network
  QTest::mouseClick(&find<QPushButton>("openNetwork"), Qt::LeftButton);
  auto& problem = find<QLabel>("trainingProblem");
  ASSERT_TRUE(QTest::qWaitFor([&] { return problem.isVisible(); }, kPatience_ms))
      << problem.text().toStdString() << window.statusBar()->currentMessage().toStdString();
  EXPECT_TRUE(problem.text().contains("paper.json")) << problem.text().toStdString();
  QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
  EXPECT_TRUE(problem.isHidden());
  ASSERT_TRUE(idle());
}

TEST_F(NetworkPanel, TheHintBelowTrainIsWholeAfterAVisitToAnotherScene) {
  const auto& hint = find<QLabel>("trainsAtOnce");
  for (const char* scene : {"design", "network"}) {
    window.showScene(scene);
    settle();
  }
  EXPECT_GE(hint.height(), hint.heightForWidth(hint.width()));
  EXPECT_GT(hint.height(), 1.5 * hint.fontMetrics().height()) << "it has more than one line";
}

TEST_F(NetworkPanel, RowsThatTheDesignDoesNotHaveAreRefusedAtTheField) {
  auto& rows = find<QLineEdit>("rows");
  rows.setFocus();
  rows.selectAll();
  QTest::keyClicks(&rows, "40");
  QTest::keyClick(&rows, Qt::Key_Return);
  EXPECT_TRUE(find<QLabel>("rowsProblem").isVisible());
  EXPECT_EQ(workbench.project().network.rows, "4") << "what cannot be is not used";
  rows.selectAll();
  QTest::keyClicks(&rows, "1,2");
  QTest::keyClick(&rows, Qt::Key_Return);
  EXPECT_TRUE(find<QLabel>("rowsProblem").isHidden());
  EXPECT_EQ(workbench.project().network.rows, "1,2");
}

TEST_F(NetworkPanel, TheDecoderOfTouchesLearnsForceAndPlaceByItself) {
  auto& target = find<QComboBox>("target");
  find<QComboBox>("decoder").setCurrentText("touch");
  EXPECT_EQ(target.currentText(), "Force and position");
  EXPECT_FALSE(target.isEnabled()) << "it has no other";
  EXPECT_EQ(workbench.project().network.target, DecoderTarget::ForceAndPlace);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier); // one edit, taken back as one
  EXPECT_EQ(find<QComboBox>("decoder").currentText(), "rbf");
  EXPECT_EQ(target.currentText(), "Force");
  EXPECT_TRUE(target.isEnabled());
  Project older = workbench.project();
  older.network.decoder = DecoderKind::TouchInversion;
  workbench.edit("an older file", older);
  EXPECT_TRUE(target.isEnabled()) << "what cannot be trained can be mended";
}

TEST_F(NetworkPanel, ADecoderAfterThatOfTouchesLearnsWhatItDidBefore) {
  const auto& target = find<QComboBox>("target");
  for (const char* decoder : {"touch", "ml"}) find<QComboBox>("decoder").setCurrentText(decoder);
  EXPECT_EQ(target.currentText(), "Force");
  EXPECT_EQ(workbench.project().network.target, DecoderTarget::Force);
  find<QComboBox>("target").setCurrentIndex(1);
  for (const char* decoder : {"touch", "ml"}) find<QComboBox>("decoder").setCurrentText(decoder);
  EXPECT_EQ(target.currentText(), "Force and position");
}

TEST_F(NetworkPanel, OldNumbersAreGreyWithTheReasonAndNeverBold) {
  generate();
  trained();
  const auto words = [&] { return find<QLabel>("fitWords").text(); };
  EXPECT_TRUE(words().contains("<b>")) << words().toStdString();
  Project other = workbench.project();
  other.design.block_mm.z() = 6;
  workbench.edit("height", other);
  EXPECT_FALSE(words().contains("<b>"));
  EXPECT_TRUE(words().contains("For an earlier design")) << words().toStdString();
  workbench.history().undo();
  EXPECT_TRUE(words().contains("<b>"));
  network.cancel();
  Project rows = workbench.project();
  rows.network.rows = "all";
  workbench.edit("rows", rows); // not by the panel: nothing trains
  EXPECT_TRUE(words().contains("row-wires 4, now all")) << words().toStdString();
  EXPECT_FALSE(words().contains("<b>"));
}

TEST_F(NetworkPanel, TheOptionsSayWhatTheModeSaysAndWhatDoesNotActIsGrey) {
  QTest::mouseClick(&find<QToolButton>("moreOptions"), Qt::LeftButton);
  const auto first = [&](const char* box) { return find<QComboBox>(box).itemText(0); };
  EXPECT_EQ(first("scaler"), "From mode: global");
  EXPECT_EQ(first("tail"), "From mode: linear");
  find<QDoubleSpinBox>("noise").setValue(0.01);
  EXPECT_EQ(first("scaler"), "From mode: whiten");
  EXPECT_TRUE(find<QLineEdit>("ridge").placeholderText().contains("leave-one-out"));
  find<QComboBox>("mode").setCurrentIndex(1);
  EXPECT_EQ(first("scaler"), "From mode: minmax");
  find<QComboBox>("decoder").setCurrentText("linear");
  EXPECT_FALSE(find<QComboBox>("scaler").isEnabled());
  EXPECT_FALSE(find<QDoubleSpinBox>("spread").isEnabled());
  EXPECT_TRUE(find<QLineEdit>("ridge").isEnabled());
}

TEST_F(NetworkPanel, HasAFieldForEachOptionOfTheFormThatIsDisabledWhereItDoesNotApply) {
  QTest::mouseClick(&find<QToolButton>("moreOptions"), Qt::LeftButton);
  for (const DecoderTraits& decoder : kDecoderTraits) {
    find<QComboBox>("decoder").setCurrentText(decoder.name);
    for (const TrainOption& option : trainOptionTable()) {
      if (!option.inForm) continue;
      QString name;
      for (const QString& word : QString::fromStdString(option.key).split('_'))
        name += name.isEmpty() ? word : word.left(1).toUpper() + word.mid(1);
      EXPECT_EQ(find<QWidget>(name.toLatin1().constData()).isEnabled(), option.applies(decoder.kind))
          << option.name << " of " << decoder.name;
    }
  }
}

TEST_F(NetworkPanel, OneClickTakesThePapersSpreadWhichTheChartMarks) {
  generate();
  trained();
  auto& paper = find<QPushButton>("paperSpread");
  EXPECT_EQ(paper.text(), "Paper's: 1.5");
  QTest::mouseClick(&paper, Qt::LeftButton);
  EXPECT_EQ(workbench.project().network.chosenSpread, 1.5);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == 1.5; }, kPatience_ms));
  const ChartSpec& chart = find<ChartView>("sweepError").chart();
  ASSERT_FALSE(chart.series.empty());
  EXPECT_EQ(chart.series.back().x, (std::vector<double>{1.5, 1.5}));
  std::vector<std::string> now;
  for (const ChartSeries& series : chart.series)
    if (series.name.ends_with("trained now")) now.push_back(series.name);
  EXPECT_EQ(now, (std::vector<std::string>{"Fx, trained now", "Fy, trained now", "Fz, trained now"}));
}

TEST_F(NetworkPanel, AnEditOfTheSamplesLeavesTheNetworkToItsLastDigit) {
  Project next = workbench.project();
  next.network.chosenSpread = 6.4511948120390123;
  next.network.noise = next.network.testNoise = 1.0 / 3e4;
  next.network.automaticSpread = false;
  workbench.edit("as a sweep found it", next);
  auto& seed = find<QSpinBox>("seed");
  seed.setValue(seed.value() + 1);
  EXPECT_EQ(workbench.project().network, next.network);
  EXPECT_NE(workbench.project().samples.seed, next.samples.seed);
  find<QSpinBox>("centers").setValue(7); // reads all of the panel
  next.network.centers = 7;
  EXPECT_EQ(workbench.project().network, next.network);
}

TEST_F(NetworkPanel, AnEmptyRidgeIsTheModesAgainAndAnUnfinishedOneIsTheOneBefore) {
  QTest::mouseClick(&find<QToolButton>("moreOptions"), Qt::LeftButton);
  auto& ridge = find<QLineEdit>("ridge");
  const auto type = [&](const QString& text, Qt::Key end) {
    ridge.setFocus();
    ridge.selectAll();
    QTest::keyClick(&ridge, Qt::Key_Delete);
    QTest::keyClicks(&ridge, text);
    QTest::keyClick(&ridge, end);
    settle();
  };
  type("1e-8", Qt::Key_Return);
  ASSERT_TRUE(workbench.project().network.ridge.has_value());
  EXPECT_EQ(*workbench.project().network.ridge, 1e-8);
  type("1e-", Qt::Key_Tab);
  EXPECT_EQ(ridge.text(), "1e-08");
  EXPECT_EQ(*workbench.project().network.ridge, 1e-8);
  for (const Qt::Key end : {Qt::Key_Return, Qt::Key_Tab}) {
    type("1e-8", Qt::Key_Return);
    type("", end);
    EXPECT_FALSE(workbench.project().network.ridge.has_value()) << "the placeholder says the mode's";
    EXPECT_EQ(ridge.text(), "");
  }
}

TEST_F(NetworkPanel, TheFoldedOptionsTrainAsTheCommandThatIsShownSays) {
  generate();
  auto& more = find<QToolButton>("moreOptions");
  EXPECT_FALSE(find<QComboBox>("scaler").isVisible());
  QTest::mouseClick(&more, Qt::LeftButton);
  EXPECT_TRUE(find<QComboBox>("scaler").isVisible());
  find<QComboBox>("scaler").setCurrentText("minmax");
  find<QComboBox>("tail").setCurrentText("bias");
  auto& ridge = find<QLineEdit>("ridge");
  ridge.setFocus();
  QTest::keyClicks(&ridge, "0.001");
  QTest::keyClick(&ridge, Qt::Key_Return);
  find<QDoubleSpinBox>("testNoise").setValue(0.1);
  trained();
  EXPECT_DOUBLE_EQ(network.fit()->decoder.report.ridge, 0.001);
  const QString trainedWith = QString::fromStdString(network.fit()->decoder.trainedWith);
  const QString commands = window.currentScene().commands(workbench.project(), "sensor.json");
  for (const char* option : {"--scaler minmax", "--tail bias", "--ridge 0.001"}) {
    EXPECT_TRUE(trainedWith.contains(option)) << trainedWith.toStdString();
    EXPECT_TRUE(commands.contains(option)) << commands.toStdString();
  }
  EXPECT_TRUE(commands.contains("--noise 0.001 --seed")) << commands.toStdString();
  EXPECT_FALSE(commands.contains("palp sweep")) << "none was made: " << commands.toStdString();
  const double noisy = network.fit()->error.error.rmsePercentOfRange.norm();
  find<QDoubleSpinBox>("testNoise").setValue(0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->settings.testNoise == 0; }, kPatience_ms));
  EXPECT_LT(network.fit()->error.error.rmsePercentOfRange.norm(), noisy);
}

TEST_F(NetworkPanel, IsSetForABoardByOneClick) {
  EXPECT_EQ(workbench.project().network.input, InputKind::Displacement);
  QTest::mouseClick(&find<QPushButton>("forLive"), Qt::LeftButton);
  const NetworkSettings& now = workbench.project().network;
  EXPECT_EQ(now.input, InputKind::Resistance);
  EXPECT_EQ(now.rows, "all");
  EXPECT_DOUBLE_EQ(now.noise, workbench.project().live.simulation.noise);
  EXPECT_DOUBLE_EQ(now.testNoise, now.noise);
  EXPECT_FALSE(find<QPushButton>("forLive").isEnabled()) << "it is so";
  workbench.history().undo();
  EXPECT_EQ(workbench.project().network.input, InputKind::Displacement) << "one edit";
}

TEST_F(NetworkPanel, EscapeInAnOpenDropDownClosesOnlyThat) {
  Project next = workbench.project();
  next.samples.perArea = 100;
  next.mesh = {}; // the default one: seconds
  workbench.edit("many samples", next);
  QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.busy(); }, kPatience_ms));
  auto& decoder = find<QComboBox>("decoder");
  decoder.setFocus();
  decoder.showPopup();
  ASSERT_TRUE(network.runner().running());
  ASSERT_TRUE(QTest::qWaitFor([&] { return decoder.view()->isVisible(); }, kPatience_ms));
  QTest::keyClick(window.windowHandle(), Qt::Key_Escape); // as the desktop delivers it
  ASSERT_TRUE(QTest::qWaitFor([&] { return !decoder.view()->isVisible(); }, kPatience_ms));
  settle();
  EXPECT_TRUE(network.runner().running()) << "the samples go on";
  network.runner().cancel();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !network.runner().running(); }, kPatience_ms));
  EXPECT_EQ(network.samples(), nullptr);
}

TEST_F(NetworkPanel, WarnsOfABadSystemAsTheCommandLineDoes) {
  generate();
  Project next = workbench.project();
  next.network.chosenSpread = 10000;
  next.network.solver = LeastSquaresMethod::PivotedQr; // of the plain system, without a ridge
  next.network.ridge = 0;
  workbench.edit("a bad system", next);
  trained();
  const std::vector<std::string>& warnings = network.fit()->decoder.report.warnings;
  ASSERT_FALSE(warnings.empty());
  for (const std::string& warning : warnings)
    EXPECT_TRUE(find<QLabel>("fitWords").text().contains("Warning: " + QString::fromStdString(warning).toHtmlEscaped()))
        << warning;
}

TEST_F(NetworkPanel, NoiseIsUnderstoodAsAShareWithAnExponentAndAsPercentAndSaysWhatWasTaken) {
  struct Typed {
    const char* keys;
    double share;
    const char* shown;
  };
  for (const Typed& typed :
       {Typed{"1e-4", 1e-4, "0.01 %"}, Typed{"2e-2%", 2e-4, "0.02 %"}, Typed{"0.03", 3e-4, "0.03 %"},
        Typed{"0.04%", 4e-4, "0.04 %"}, Typed{"5E-6", 5e-6, "0.0005 %"}})
    for (const char* name : {"noise", "testNoise"}) {
      auto& noise = find<QDoubleSpinBox>(name);
      noise.setFocus();
      noise.selectAll();
      QTest::keyClicks(&noise, typed.keys);
      QTest::keyClick(&noise, Qt::Key_Return);
      EXPECT_NEAR(noise.value(), 100 * typed.share, 1e-12) << typed.keys;
      EXPECT_EQ(noise.text(), typed.shown) << typed.keys;
      const QString words = find<QLabel>("noiseWords").text();
      EXPECT_TRUE(words.contains(QString("%1 (%2 ppm)").arg(typed.shown).arg(1e6 * typed.share)))
          << words.toStdString();
    }
  EXPECT_DOUBLE_EQ(workbench.project().network.noise, 5e-6);
  EXPECT_DOUBLE_EQ(workbench.project().network.testNoise, 5e-6);
  auto& floor = find<QDoubleSpinBox>("resistanceNoise"); // in Design; it has words before its number
  floor.selectAll();
  QTest::keyClicks(&floor, "1e-4");
  QTest::keyClick(&floor, Qt::Key_Return);
  EXPECT_DOUBLE_EQ(workbench.project().view.resistanceNoise, 1e-4);
}

TEST_F(NetworkPanel, SaysTheErrorInNewtonAndWhetherItWasTestedWithNoise) {
  generate();
  find<QDoubleSpinBox>("noise").setValue(0.01);
  trained();
  const QString words = find<QLabel>("fitWords").text();
  EXPECT_TRUE(words.contains("mean [N]")) << words.toStdString();
  for (const double mean : network.fit()->error.error.meanAbsolute)
    EXPECT_TRUE(words.contains("\">" + QString::number(mean, 'g', 3) + "<")) << words.toStdString();
  EXPECT_TRUE(words.contains("tested without noise")) << words.toStdString();
}

} // namespace
} // namespace palp
