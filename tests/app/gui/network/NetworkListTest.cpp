#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/network/NetworkCharts.h"
#include "app/gui/network/words/FitWords.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/CsvExport.h"
#include "app/gui/views/DataTable.h"
#include "app/study/Resources.h"
#include "app/study/live/LiveSource.h"
#include "tests/app/gui/network/NetworkSceneFixture.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QTabWidget>
#include <QTemporaryDir>

namespace palp {
namespace {

using NetworkList = NetworkScene;

TEST_F(NetworkList, TriesANetworkOfAFileInTheBackgroundAndSaysWhyAnotherCannotBe) {
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

TEST_F(NetworkList, NamesTheNetworkThatWasOpenedAndWhatItReads) {
  generate();
  answerFileDialog(QString::fromStdString(shippedNetwork().string()));
  QTest::mouseClick(&find<QPushButton>("openNetwork"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
  const QString words = find<QLabel>("fitWords").text();
  EXPECT_TRUE(words.contains("Opened: " + QFileInfo(network.fit()->file).fileName())) << words.toStdString();
  EXPECT_TRUE(words.contains("from resistances, row-wires all")) << words.toStdString();
}

TEST_F(NetworkList, GoesBackToAnEarlierNetworkWithItsSettings) {
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
  EXPECT_EQ(workbench.project().network.chosenSpread, first);
  EXPECT_TRUE(find<QLabel>("fitWords").text().contains("<b>"));
  ASSERT_TRUE(idle());
  QTest::mouseClick(&find<QPushButton>("takeAway"), Qt::LeftButton);
  EXPECT_EQ(list.rowCount(), 1);
}

TEST_F(NetworkList, TakesAwayAllThatAreMarkedAndBringsThemBackToWhereTheyWere) {
  generate();
  trained();
  for (const double spread : {2., 3.}) {
    find<QDoubleSpinBox>("spread").setValue(spread);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == spread; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
  auto& list = find<DataTable>("trainedNetworks");
  ASSERT_EQ(list.rowCount(), 3);
  find<QTabWidget>("networkTabs").setCurrentIndex(3);
  const auto kept = network.kept();
  EXPECT_FALSE(find<QPushButton>("bringBack").isEnabled());
  list.setCurrentCell(2, 0);
  EXPECT_EQ(find<QPushButton>("takeAway").text(), "Remove");
  list.selectionModel()->select(list.model()->index(0, 0), QItemSelectionModel::Select | QItemSelectionModel::Rows);
  EXPECT_EQ(find<QPushButton>("takeAway").text(), "Remove 2") << "what goes is said before";
  QTest::mouseClick(&find<QPushButton>("takeAway"), Qt::LeftButton);
  ASSERT_EQ(list.rowCount(), 1);
  EXPECT_EQ(network.kept()[0], kept[1]);
  QTest::mouseClick(&find<QPushButton>("bringBack"), Qt::LeftButton);
  EXPECT_EQ(network.kept(), kept);
  EXPECT_TRUE(network.results().removed.empty());
  EXPECT_FALSE(find<QPushButton>("bringBack").isEnabled());
}

TEST_F(NetworkList, GoingBackToANetworkOfAnEarlierDesignBringsTheDesignToo) {
  generate();
  trained();
  const SensorDesign design = workbench.project().design;
  Project next = workbench.project();
  next.design.block_mm.z() = 6;
  workbench.edit("another block", next);
  ASSERT_FALSE(network.upToDate());
  find<QTabWidget>("networkTabs").setCurrentIndex(3);
  find<DataTable>("trainedNetworks").setCurrentCell(0, 0);
  QTest::mouseClick(&find<QPushButton>("goBack"), Qt::LeftButton);
  EXPECT_EQ(workbench.project().design, design);
  EXPECT_TRUE(network.upToDate()) << "samples and network hold again";
  EXPECT_TRUE(workbench.history().undoText().contains("6 -> 5 mm")) << workbench.history().undoText().toStdString();
  workbench.history().undo();
  EXPECT_EQ(workbench.project().design.block_mm.z(), 6);
}

TEST_F(NetworkList, ComparesWithTheNetworkThatWasShownBefore) {
  generate();
  trained();
  const double first = network.fit()->decoder.report.spread;
  const auto trainedWith = [&](double spread) {
    return QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == spread; }, kPatience_ms) && idle();
  };
  find<QDoubleSpinBox>("spread").setValue(3);
  EXPECT_EQ(workbench.history().undoText(), QString("Change the spread (spread %1 -> 3)").arg(first));
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

TEST_F(NetworkList, ASpreadThatIsDraggedLeavesOneNetworkInTheListAndOneThatIsTypedItsOwn) {
  generate();
  trained();
  auto& slider = find<QSlider>("spreadSlider");
  const auto moveTo = [&](int step) {
    slider.setSliderPosition(step);
    const double spread = workbench.project().network.chosenSpread;
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

TEST_F(NetworkList, EveryEditKeepsItsNetworkAndEqualOnesStandOnce) {
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

TEST_F(NetworkList, ANetworkIsNamedInTheList) {
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
  EXPECT_EQ(list.item(0, 8)->text(), "rbf") << list.csv().toStdString();
  EXPECT_TRUE(list.item(0, 1)->font().bold());
  EXPECT_TRUE(window.isWindowModified()) << "the name is part of the work";
}

TEST_F(NetworkList, AFullListDropsTheOldestWithoutANameAndIsOpenedAsItWas) {
  NetworkSession session; // without a window that draws every one
  session.setDesign(workbench.project().design);
  session.generate(workbench.project().samples, workbench.project().mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.samples() != nullptr; }, kPatience_ms));
  const std::size_t most = NetworkSession::kKeptNetworks;
  const auto spread = [](std::size_t k) { return 1 + 0.01 * static_cast<double>(k); };
  for (std::size_t k = 0; k < most + 3; ++k) {
    NetworkSettings settings = workbench.project().network;
    settings.chosenSpread = spread(k);
    session.train(settings);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return session.fit() != nullptr && session.fit()->decoder.report.spread == settings.chosenSpread; },
        kPatience_ms));
    if (k == 0) session.rename(0, "the first, clean");
  }
  ASSERT_EQ(session.kept().size(), most + 1);
  EXPECT_EQ(session.kept().back()->name, "the first, clean");
  EXPECT_EQ(session.kept()[most - 1]->settings.chosenSpread, spread(3)) << "the two oldest without a name have gone";
  const QTemporaryDir folder;
  saveResults(folder.path().toStdString(), session.results(), {});
  const NetworkResults opened = openResults(folder.path().toStdString(), workbench.project().design, {}).results;
  EXPECT_EQ(opened.listed(), session.results().listed());
  session.rename(most, {});
  saveResults(folder.path().toStdString(), session.results(), {});
  EXPECT_EQ(openResults(folder.path().toStdString(), workbench.project().design, {}).results.kept.size(), most)
      << "without its name it is one too many";
}

TEST_F(NetworkList, NetworksThatWereTestedWithNoiseAreOpenedWithTheErrorsThatTheyHad) {
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

TEST_F(NetworkList, TheMarkInTheListStaysWithItsNetworkAndEachEditKeepsOne) {
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

TEST_F(NetworkList, TheListOfNetworksIsKeptBesideTheProject) {
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

} // namespace
} // namespace palp
