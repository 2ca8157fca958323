#include "app/gui/jobs/ResultFiles.h"
#include "app/gui/network/FitWords.h"
#include "app/gui/network/NetworkCharts.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/CsvExport.h"
#include "app/gui/views/DataTable.h"
#include "app/study/Resources.h"
#include "app/study/live/LiveSource.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAbstractItemView>
#include <QClipboard>
#include <QComboBox>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QStatusBar>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QToolButton>

#include <limits>
#include <set>

namespace palp {
namespace {

class NetworkScene : public WindowFixture {
protected:
  NetworkScene() {
    window.showScene("network");
    EXPECT_TRUE(solved());
  }
  void generate() {
    QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
  void trained() {
    QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
};

TEST_F(NetworkScene, GoesOnWithSamplesWhereItWasStopped) {
  Project more = workbench.project();
  more.samples.perArea = 400; // so many that the cancel comes first
  workbench.edit("more", more);
  for (int wait_ms = 100; network.samples() == nullptr && network.stoppedAt()[0] == 0; wait_ms += 100) {
    QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
    QTest::qWait(wait_ms); // longer each time: it may still have been meshing
    network.cancel();
    ASSERT_TRUE(idle());
  }
  ASSERT_EQ(network.samples(), nullptr) << "all samples were made before the cancel";
  EXPECT_TRUE(find<QPushButton>("generate").text().contains("Go on"));
  EXPECT_TRUE(find<QLabel>("samplesWords").text().contains("Stopped at sample"));
  generate();
  const SampleSet resumed = network.samples()->training;
  // A whole run gives the same samples.
  NetworkSession other;
  other.setDesign(workbench.project().design);
  other.generate(workbench.project().samples, workbench.project().mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return other.samples() != nullptr; }, kPatience_ms));
  EXPECT_EQ(resumed.forces_N, other.samples()->training.forces_N);
  EXPECT_EQ(resumed.displacements_mm, other.samples()->training.displacements_mm);
  EXPECT_EQ(network.samples()->test.resistances_ohm, other.samples()->test.resistances_ohm);
}

TEST_F(NetworkScene, DrawsNoChartAgainForALoadThatItDoesNotShow) {
  settle();
  auto& chart = find<ChartView>("sweepError");
  const int before = chart.renderCount();
  Project changed = workbench.project();
  changed.load.areas[0].force_N.z() += 1;
  workbench.edit("another load", changed);
  settle();
  EXPECT_EQ(chart.renderCount(), before);
  changed.network.input = InputKind::Resistance; // the paper's points are others
  workbench.edit("another input", changed);
  settle();
  EXPECT_EQ(chart.renderCount(), before + 1);
}

TEST_F(NetworkScene, TriesANetworkOfAFileInTheBackgroundAndSaysWhyAnotherCannotBe) {
  generate();
  answerFileDialog(QString::fromStdString(shippedNetwork().string()));
  QTest::mouseClick(&find<QPushButton>("openNetwork"), Qt::LeftButton);
  EXPECT_EQ(network.fit(), nullptr) << "read while the window waited";
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  EXPECT_EQ(network.fit()->settings.input, InputKind::Resistance);
  EXPECT_EQ(network.fit()->prediction.forces_N.cols(), network.samples()->test.size());
  ASSERT_TRUE(idle());
  const NetworkFit* good = network.fit();
  answerFileDialog(QString::fromStdString(resource("paper.json").string())); // a design is no network
  QTest::mouseClick(&find<QPushButton>("openNetwork"), Qt::LeftButton);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return window.statusBar()->currentMessage().contains("paper.json"); }, kPatience_ms))
      << window.statusBar()->currentMessage().toStdString();
  EXPECT_EQ(network.fit(), good);
}

TEST_F(NetworkScene, PutsEveryDecoderOnTheSameAxes) {
  generate();
  find<QComboBox>("input").setCurrentIndex(1);
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == allDecoderKinds().size(); }, kPatience_ms));
  ASSERT_TRUE(idle());
  settle();
  std::size_t trained = 0;
  for (const DecoderTrial& trial : network.trials()) trained += trial.refusal.isEmpty() ? 1 : 0;
  EXPECT_GE(trained, 4u);
  EXPECT_EQ(find<ChartView>("trialsTime").chart().series.size(), trained);
  EXPECT_EQ(find<ChartView>("trialsError").chart().series.size(), trained);
}

TEST_F(NetworkScene, AKeystrokeInTheDesignLosesNothingThatWasTrained) {
  generate();
  QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("sweep"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sweepPoints().size() == 3; }, kPatience_ms));
  ASSERT_TRUE(idle());
  const NetworkSamples* samples = network.samples();
  const NetworkFit* fit = network.fit();
  window.showScene("design");
  auto& height = find<QLineEdit>("block_mm[2]");
  height.setFocus();
  height.selectAll();
  QTest::keyClicks(&height, "6");
  ASSERT_EQ(workbench.project().design.block_mm.z(), 6);
  EXPECT_EQ(network.samples(), samples) << "they are still to be looked at";
  EXPECT_FALSE(network.upToDate());
  EXPECT_FALSE(find<QPushButton>("train").isEnabled()) << "but are not of this design";
  for (const char* words : {"samplesWords", "fitWords"})
    EXPECT_TRUE(find<QLabel>(words).text().contains("an earlier design (block size along z 5 -&gt; 6 mm since)") ||
                find<QLabel>(words).text().contains("an earlier design (block size along z 5 -> 6 mm since)"))
        << find<QLabel>(words).text().toStdString();
  window.showScene("network");
  generate();
  EXPECT_NE(network.samples(), samples) << "samples of the other design";
  EXPECT_EQ(network.fit(), nullptr);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(workbench.project().design.block_mm.z(), 5);
  EXPECT_EQ(network.samples(), samples);
  EXPECT_EQ(network.fit(), fit);
  EXPECT_EQ(network.sweepPoints().size(), 3u);
  EXPECT_TRUE(network.upToDate());
}

TEST_F(NetworkScene, SaysErrorsWhereOneLooksUntilTheNextWorkBegins) {
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

TEST_F(NetworkScene, RowsThatTheDesignDoesNotHaveAreRefusedAtTheField) {
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

TEST_F(NetworkScene, OldNumbersAreGreyWithTheReasonAndNeverBold) {
  generate();
  trained();
  const auto words = [&] { return find<QLabel>("fitWords").text(); };
  EXPECT_TRUE(words().contains("<b>")) << words().toStdString();
  Project other = workbench.project();
  other.design.block_mm.z() = 6;
  workbench.edit("height", other);
  EXPECT_FALSE(words().contains("<b>"));
  EXPECT_TRUE(words().contains("Of an earlier design")) << words().toStdString();
  workbench.history().undo();
  EXPECT_TRUE(words().contains("<b>"));
  network.cancel();
  Project rows = workbench.project();
  rows.network.rows = "all";
  workbench.edit("rows", rows); // not by the panel: nothing trains
  EXPECT_TRUE(words().contains("row-wires 4, now all")) << words().toStdString();
  EXPECT_FALSE(words().contains("<b>"));
}

TEST_F(NetworkScene, NamesTheNetworkThatWasOpenedAndWhatItReads) {
  generate();
  answerFileDialog(QString::fromStdString(shippedNetwork().string()));
  QTest::mouseClick(&find<QPushButton>("openNetwork"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  const QString words = find<QLabel>("fitWords").text();
  EXPECT_TRUE(words.contains("Opened: " + QFileInfo(network.fit()->file).fileName())) << words.toStdString();
  EXPECT_TRUE(words.contains("from resistances, row-wires all")) << words.toStdString();
}

TEST_F(NetworkScene, GoesBackToAnEarlierNetworkWithItsSettings) {
  generate();
  trained();
  const double first = network.fit()->decoder.report.spread;
  find<QDoubleSpinBox>("spread").setValue(3); // trains at once
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == 3; }, kPatience_ms));
  ASSERT_TRUE(idle());
  auto& list = find<DataTable>("trainedNetworks");
  ASSERT_EQ(list.rowCount(), 2);
  find<QTabWidget>("networkTabs").setCurrentIndex(3);
  list.setCurrentCell(1, 0);
  QTest::mouseClick(&find<QPushButton>("goBack"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == first; }, kPatience_ms));
  EXPECT_EQ(workbench.project().network.spread, first);
  EXPECT_TRUE(find<QLabel>("fitWords").text().contains("<b>"));
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("takeAway"), Qt::LeftButton);
  EXPECT_EQ(list.rowCount(), 1);
}

TEST_F(NetworkScene, ComparesWithTheNetworkThatWasShownBefore) {
  generate();
  trained();
  const double first = network.fit()->decoder.report.spread;
  const auto trainedWith = [&](double spread) {
    return QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == spread; }, kPatience_ms) && idle();
  };
  find<QDoubleSpinBox>("spread").setValue(3);
  ASSERT_TRUE(trainedWith(3));
  ASSERT_NE(network.before(), nullptr);
  EXPECT_EQ(network.before()->decoder.report.spread, first);
  find<QTabWidget>("networkTabs").setCurrentIndex(3);
  find<DataTable>("trainedNetworks").setCurrentCell(1, 0);
  QTest::mouseClick(&find<QPushButton>("goBack"), Qt::LeftButton);
  ASSERT_TRUE(trainedWith(first));
  find<QDoubleSpinBox>("spread").setValue(2);
  ASSERT_TRUE(trainedWith(2));
  EXPECT_EQ(network.before()->decoder.report.spread, first) << "not that which was trained last";
}

TEST_F(NetworkScene, ASpreadThatIsDraggedLeavesOneNetworkInTheListAndOneThatIsTypedItsOwn) {
  generate();
  trained();
  auto& slider = find<QSlider>("spreadSlider");
  const auto moveTo = [&](int step) {
    slider.setSliderPosition(step);
    const double spread = workbench.project().network.spread;
    return QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == spread; }, kPatience_ms) && idle();
  };
  slider.setSliderDown(true); // tells that it is pressed
  for (const int step : {170, 180, 190}) ASSERT_TRUE(moveTo(step));
  slider.setSliderDown(false);
  EXPECT_EQ(network.kept().size(), 2u) << "the one that was asked for, and the last of those of the movement";
  slider.setSliderDown(true);
  ASSERT_TRUE(moveTo(200));
  slider.setSliderDown(false);
  EXPECT_EQ(network.kept().size(), 3u) << "another movement";
  for (const double spread : {2.0, 3.0, 4.0}) {
    find<QDoubleSpinBox>("spread").setValue(spread);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == spread; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
  EXPECT_EQ(network.kept().size(), 6u);
}

TEST_F(NetworkScene, EveryEditKeepsItsNetworkAndEqualOnesStandOnce) {
  generate();
  trained();
  for (const char* decoder : {"linear", "poly2", "gp"}) {
    find<QComboBox>("decoder").setCurrentText(decoder);
    ASSERT_TRUE(QTest::qWaitFor([&] { return name(network.fit()->decoder.kind) == decoder; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
  EXPECT_EQ(network.kept().size(), 4u) << find<DataTable>("trainedNetworks").csv().toStdString();
  const NetworkFit* before = network.fit();
  QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != before; }, kPatience_ms));
  EXPECT_EQ(network.kept().size(), 4u) << "what is trained again stands once";
}

TEST_F(NetworkScene, ANetworkIsNamedInTheList) {
  generate();
  trained();
  find<QTabWidget>("networkTabs").setCurrentIndex(3);
  auto& list = find<DataTable>("trainedNetworks");
  auto& field = find<QLineEdit>("networkName");
  EXPECT_FALSE(field.isEnabled()) << "none is marked";
  list.setCurrentCell(0, 0);
  list.setFocus();
  QTest::keyClick(&list, Qt::Key_F2);
  ASSERT_TRUE(QTest::qWaitFor([&] { return field.hasFocus(); }, kPatience_ms));
  QTest::keyClicks(&field, "the first, clean");
  QTest::keyClick(&field, Qt::Key_Return);
  EXPECT_EQ(list.item(0, 0)->text(), "the first, clean");
  EXPECT_TRUE(find<QLabel>("fitWords").text().contains("the first, clean"));
  EXPECT_EQ(list.item(0, 6)->text(), "rbf") << list.csv().toStdString();
  EXPECT_TRUE(list.item(0, 1)->font().bold());
  EXPECT_TRUE(window.isWindowModified()) << "the name is part of the work";
}

TEST_F(NetworkScene, AFullListDropsTheOldestWithoutANameAndIsOpenedAsItWas) {
  NetworkSession session; // without a window that draws every one
  session.setDesign(workbench.project().design);
  session.generate(workbench.project().samples, workbench.project().mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.samples() != nullptr; }, kPatience_ms));
  const std::size_t most = NetworkSession::kKeptNetworks;
  const auto spread = [](std::size_t k) { return 1 + 0.01 * static_cast<double>(k); };
  for (std::size_t k = 0; k < most + 3; ++k) {
    NetworkSettings settings = workbench.project().network;
    settings.spread = spread(k);
    session.train(settings);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return session.fit() != nullptr && session.fit()->decoder.report.spread == settings.spread; },
        kPatience_ms));
    if (k == 0) session.rename(0, "the first, clean");
  }
  ASSERT_EQ(session.kept().size(), most + 1);
  EXPECT_EQ(session.kept().back()->name, "the first, clean");
  EXPECT_EQ(session.kept()[most - 1]->settings.spread, spread(3)) << "the two oldest without a name have gone";
  const QTemporaryDir folder;
  saveResults(folder.path().toStdString(), session.results(), {});
  const NetworkResults opened = openResults(folder.path().toStdString(), workbench.project().design, {}).results;
  EXPECT_EQ(opened.listed(), session.results().listed());
  session.rename(most, {});
  saveResults(folder.path().toStdString(), session.results(), {});
  EXPECT_EQ(openResults(folder.path().toStdString(), workbench.project().design, {}).results.kept.size(), most)
      << "without its name it is one too many";
}

TEST_F(NetworkScene, NetworksThatWereTestedWithNoiseAreOpenedWithTheErrorsThatTheyHad) {
  generate();
  find<QComboBox>("input").setCurrentIndex(1);
  find<QDoubleSpinBox>("noise").setValue(0.01);
  find<QDoubleSpinBox>("testNoise").setValue(0.02);
  find<QSpinBox>("trainSeed").setValue(7);
  trained();
  auto& rows = find<QLineEdit>("rows");
  rows.setFocus();
  rows.selectAll();
  QTest::keyClicks(&rows, "all");
  QTest::keyClick(&rows, Qt::Key_Return);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->settings.rows == "all"; }, kPatience_ms));
  ASSERT_TRUE(idle());
  const QTemporaryDir folder;
  saveResults(folder.path().toStdString(), network.results(), {});
  const NetworkResults opened = openResults(folder.path().toStdString(), workbench.project().design, {}).results;
  ASSERT_EQ(opened.kept.size(), network.kept().size());
  for (std::size_t k = 0; k < opened.kept.size(); ++k) {
    EXPECT_EQ(opened.kept[k]->error.error.rmsePercentOfRange, network.kept()[k]->error.error.rmsePercentOfRange);
    EXPECT_EQ(opened.kept[k]->triedOn.lock(), opened.samples) << "not of other samples";
  }
  ASSERT_TRUE(opened.fit);
  EXPECT_EQ(opened.fit->error.error.rmsePercentOfRange, network.fit()->error.error.rmsePercentOfRange);
}

TEST_F(NetworkScene, TheNoiseBoundStandsBesideTheErrorsAndBelowTheDecoders) {
  Project more = workbench.project();
  more.samples.perArea = 20; // a curved response in three forces has ten coefficients
  workbench.edit("more", more);
  generate();
  find<QComboBox>("input").setCurrentIndex(1);
  find<QDoubleSpinBox>("noise").setValue(0.01);
  trained();
  const auto words = [&] { return find<QLabel>("fitWords").text(); };
  EXPECT_FALSE(words().contains("Cramer-Rao bound [% of range]")) << "without noise there is none";
  EXPECT_TRUE(words().contains("A noise of the test puts")) << words().toStdString();
  find<QDoubleSpinBox>("testNoise").setValue(0.01);
  const NoiseBound bound = noiseBound(network.samples()->training, InputKind::Resistance, {4}, 1e-4);
  const QString fx = QString::number(bound.withPriorPercent[0], 'g', 3);
  ASSERT_TRUE(QTest::qWaitFor([&] { return words().contains("Cramer-Rao bound [% of range]") && words().contains(fx); },
                              kPatience_ms))
      << fx.toStdString() << " in " << words().toStdString();
  EXPECT_GT(network.fit()->error.error.rmsePercentOfRange[0], bound.withPriorPercent[0]);
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == allDecoderKinds().size(); }, kPatience_ms));
  ASSERT_TRUE(idle());
  auto& table = find<DataTable>("trialsTable");
  const int last = table.rowCount() - 1;
  EXPECT_EQ(last, static_cast<int>(allDecoderKinds().size()));
  EXPECT_EQ(table.item(last, 0)->text(), "bound");
  EXPECT_EQ(table.item(last, 5)->text(), QString::number(bound.withPriorPercent[0], 'g', 6));
}

TEST_F(NetworkScene, TheOptionsSayWhatTheModeSaysAndWhatDoesNotActIsGrey) {
  QTest::mouseClick(&find<QToolButton>("moreOptions"), Qt::LeftButton);
  const auto first = [&](const char* box) { return find<QComboBox>(box).itemText(0); };
  EXPECT_EQ(first("scaler"), "as the mode says: global");
  EXPECT_EQ(first("tail"), "as the mode says: linear");
  find<QDoubleSpinBox>("noise").setValue(0.01);
  EXPECT_EQ(first("scaler"), "as the mode says: whiten");
  EXPECT_TRUE(find<QLineEdit>("ridge").placeholderText().contains("leave-one-out"));
  find<QComboBox>("mode").setCurrentIndex(1);
  EXPECT_EQ(first("scaler"), "as the mode says: minmax");
  find<QComboBox>("decoder").setCurrentText("linear");
  EXPECT_FALSE(find<QComboBox>("scaler").isEnabled());
  EXPECT_FALSE(find<QDoubleSpinBox>("spread").isEnabled());
  EXPECT_TRUE(find<QLineEdit>("ridge").isEnabled());
}

TEST_F(NetworkScene, OneClickTakesThePapersSpreadWhichTheChartMarks) {
  generate();
  trained();
  auto& paper = find<QPushButton>("paperSpread");
  EXPECT_EQ(paper.text(), "the paper's: 1.5");
  QTest::mouseClick(&paper, Qt::LeftButton);
  EXPECT_EQ(workbench.project().network.spread, 1.5);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == 1.5; }, kPatience_ms));
  const ChartSpec& chart = find<ChartView>("sweepError").chart();
  ASSERT_FALSE(chart.series.empty());
  EXPECT_EQ(chart.series.back().x, (std::vector<double>{1.5, 1.5}));
  std::vector<std::string> now;
  for (const ChartSeries& series : chart.series)
    if (series.name.ends_with("trained now")) now.push_back(series.name);
  EXPECT_EQ(now, (std::vector<std::string>{"Fx, trained now", "Fy, trained now", "Fz, trained now"}));
}

TEST_F(NetworkScene, OpeningTheSamplesThatAreThereKeepsWhatWasMadeOfThem) {
  generate();
  trained();
  const QTemporaryDir folder;
  const QString file = folder.filePath("samples.csv");
  answerFileDialog(file);
  QTest::mouseClick(&find<QPushButton>("saveSamples"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return QFileInfo::exists(file) && !window.busy(); }, kPatience_ms));
  const NetworkFit* fit = network.fit();
  answerFileDialog(file);
  QTest::mouseClick(&find<QPushButton>("openSamples"), Qt::LeftButton);
  auto& said = find<QLabel>("trainingProblem");
  ASSERT_TRUE(QTest::qWaitFor([&] { return said.text().contains("there already"); }, kPatience_ms))
      << said.text().toStdString();
  EXPECT_EQ(network.fit(), fit);
  EXPECT_EQ(said.property("role").toString(), "hint") << "nothing is wrong: it is not red";
}

TEST_F(NetworkScene, TheSweepsTableHasEveryPointAndItsBestSpreadIsTakenOver) {
  generate();
  trained();
  QTest::mouseClick(&find<QPushButton>("sweep"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sweepPoints().size() == 3; }, kPatience_ms));
  ASSERT_TRUE(idle());
  auto& table = find<DataTable>("sweepTable");
  ASSERT_EQ(table.rowCount(), 3);
  EXPECT_EQ(table.csv().count('\n'), 4);
  EXPECT_TRUE(table.csv().startsWith("spread,Fx Eq. (13) [%]")) << table.csv().toStdString();
  table.setRangeSelected({0, 0, 1, 1}, true);
  table.setFocus();
  QTest::keyClick(&table, Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(QApplication::clipboard()->text().count('\t'), 2);
  QTest::mouseClick(&find<QPushButton>("bestSpread"), Qt::LeftButton);
  double best = 0, error = std::numeric_limits<double>::infinity();
  for (const SweepPoint& point : network.sweepPoints())
    if (point.error.rmsePercentOfRange.norm() < error) {
      error = point.error.rmsePercentOfRange.norm();
      best = point.spread;
    }
  EXPECT_EQ(workbench.project().network.spread, best);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == best; }, kPatience_ms));
}

TEST_F(NetworkScene, TheFoldedOptionsTrainAsTheCommandThatIsShownSays) {
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
  EXPECT_TRUE(commands.contains("--test-noise 0.001")) << commands.toStdString();
  const double noisy = network.fit()->error.error.rmsePercentOfRange.norm();
  find<QDoubleSpinBox>("testNoise").setValue(0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->settings.testNoise == 0; }, kPatience_ms));
  EXPECT_LT(network.fit()->error.error.rmsePercentOfRange.norm(), noisy);
}

TEST_F(NetworkScene, TheMarkInTheListStaysWithItsNetworkAndEachEditKeepsOne) {
  generate();
  trained();
  auto& list = find<DataTable>("trainedNetworks");
  find<QTabWidget>("networkTabs").setCurrentIndex(3);
  list.setCurrentCell(0, 0);
  find<QDoubleSpinBox>("spread").setValue(2);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.kept().size() == 2; }, kPatience_ms));
  ASSERT_TRUE(idle());
  EXPECT_EQ(list.currentRow(), 1);
  find<QComboBox>("scaler").setCurrentText("minmax"); // another edit: the network of the spread stays
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.kept().size() == 3; }, kPatience_ms));
  EXPECT_EQ(list.currentRow(), 2);
  EXPECT_TRUE(list.item(0, 0)->toolTip().contains("scaler minmax")) << list.item(0, 0)->toolTip().toStdString();
  EXPECT_TRUE(list.csv().section('\n', 1, 1).contains(",minmax,")) << list.csv().toStdString();
}

TEST_F(NetworkScene, IsSetForABoardByOneClick) {
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

TEST_F(NetworkScene, EscapeInAnOpenDropDownClosesOnlyThat) {
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

TEST_F(NetworkScene, WarnsOfABadSystemAsTheCommandLineDoes) {
  generate();
  Project next = workbench.project();
  next.network.spread = 10000;
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

TEST_F(NetworkScene, EveryDecoderIsSeenInTheirChartWhereItsLineLiesOnAnother) {
  DecoderTrial one;
  one.error.eq13Percent = Eigen::Vector3d::Constant(0.5);
  std::vector<DecoderTrial> trials(3, one);
  trials[1].kind = DecoderKind::Linear;
  trials[2].kind = DecoderKind::GaussianProcess;
  const ChartSpec chart = trialsErrorChart(trials, {}, InputKind::Resistance);
  ASSERT_EQ(chart.series.size(), 3U);
  std::set<double> marks;
  for (const ChartSeries& level : chart.series) {
    EXPECT_EQ(level.style, ChartSeries::Style::LineAndPoints);
    EXPECT_FALSE(level.legendWords().empty());
    ASSERT_EQ(level.x.size(), 3U);
    marks.insert(level.x[1]);
  }
  EXPECT_EQ(marks.size(), 3U) << "no marker hides another";
}

TEST_F(NetworkScene, NoiseIsUnderstoodAsAShareWithAnExponentAndAsPercentAndSaysWhatWasTaken) {
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
      EXPECT_TRUE(words.contains(QString("%1 (a share of %2)").arg(typed.shown).arg(typed.share)))
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

TEST_F(NetworkScene, SaysTheErrorInNewtonAndWhetherItWasTestedWithNoise) {
  generate();
  find<QDoubleSpinBox>("noise").setValue(0.01);
  trained();
  const QString words = find<QLabel>("fitWords").text();
  EXPECT_TRUE(words.contains("mean [N]")) << words.toStdString();
  for (const double mean : network.fit()->error.error.meanAbsolute)
    EXPECT_TRUE(words.contains("&nbsp;" + QString::number(mean, 'g', 3) + "<")) << words.toStdString();
  EXPECT_TRUE(words.contains("tested without noise")) << words.toStdString();
}

TEST_F(NetworkScene, AComparisonOfOtherSettingsIsFaintWithTheReason) {
  generate();
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == allDecoderKinds().size(); }, kPatience_ms));
  ASSERT_TRUE(idle());
  EXPECT_FALSE(find<ChartView>("trialsError").faint());
  find<QDoubleSpinBox>("noise").setValue(0.01);
  EXPECT_TRUE(find<ChartView>("trialsError").faint());
  EXPECT_TRUE(find<QLabel>("trialsWords").text().contains("noise 0 %, now 0.01 %"))
      << find<QLabel>("trialsWords").text().toStdString();
}

TEST_F(NetworkScene, EveryChartGivesItsPoints) {
  ChartSpec spec;
  spec.xLabel = "spread";
  spec.yLabel = "relative error, Eq. (13) [%]";
  spec.series.resize(1);
  spec.series[0].name = "Fx";
  spec.series[0].x = {1, 2};
  spec.series[0].y = {0.5, 0.25};
  EXPECT_EQ(chartCsv(spec), "series,spread,\"relative error, Eq. (13) [%]\"\nFx,1,0.5\nFx,2,0.25\n");
}

TEST_F(NetworkScene, TheListOfNetworksIsKeptBesideTheProject) {
  generate();
  find<QDoubleSpinBox>("spread").setValue(2);
  trained();
  find<QDoubleSpinBox>("spread").setValue(3);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == 3; }, kPatience_ms));
  ASSERT_TRUE(idle());
  const QTemporaryDir folder;
  saveResults(folder.path().toStdString(), network.results(), {});
  const NetworkResults opened = openResults(folder.path().toStdString(), workbench.project().design, {}).results;
  ASSERT_EQ(opened.kept.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(opened.kept[k]->settings, network.kept()[k]->settings);
    EXPECT_EQ(opened.kept[k]->made, network.kept()[k]->made);
    EXPECT_EQ(opened.kept[k]->error.error.rmsePercentOfRange, network.kept()[k]->error.error.rmsePercentOfRange);
  }
  EXPECT_EQ(opened.fit, opened.kept[0]) << "the one that was shown";
  auto& list = find<DataTable>("trainedNetworks");
  list.setCurrentCell(1, 0);
  find<QTabWidget>("networkTabs").setCurrentIndex(3);
  QTest::mouseClick(&find<QPushButton>("takeAway"), Qt::LeftButton);
  saveResults(folder.path().toStdString(), network.results(), {});
  const OpenedResults less = openResults(folder.path().toStdString(), workbench.project().design, {});
  ASSERT_EQ(less.results.kept.size(), 1u);
  EXPECT_EQ(less.results.kept[0]->made, opened.kept[0]->made);
}

TEST_F(NetworkScene, GeneratesTrainsAndSweepsFromTheNetworkScene) {
  window.showScene("network");
  EXPECT_FALSE(find<QPushButton>("train").isEnabled());
  QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
  EXPECT_EQ(network.samples()->training.size(), 36);
  EXPECT_NE(network.samples()->training.forces_N, network.samples()->test.forces_N);
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  ASSERT_TRUE(idle());
  const NetworkFit* first = network.fit();
  find<QDoubleSpinBox>("spread").setValue(2.5); // the error follows
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != first; }, kPatience_ms));
  EXPECT_EQ(network.fit()->decoder.report.spread, 2.5);
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("sweep"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.sweepPoints().size() == 3; }, kPatience_ms));
}

} // namespace
} // namespace palp
