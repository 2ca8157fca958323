#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/live/LiveBoards.h"
#include "app/gui/live/LivePage.h"
#include "app/gui/network/NetworkCharts.h"
#include "app/gui/network/NetworkTables.h"
#include "app/gui/network/words/FitWords.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/CsvExport.h"
#include "app/gui/views/DataTable.h"
#include "app/study/Resources.h"
#include "app/study/live/LiveSource.h"
#include "tests/app/gui/network/NetworkSceneFixture.h"

#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QTemporaryDir>

#include <limits>

namespace palp {
namespace {

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
  EXPECT_TRUE(find<QPushButton>("generate").text().contains("Continue"));
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

TEST_F(NetworkScene, PutsEveryDecoderOnTheSameAxes) {
  generate();
  find<QComboBox>("input").setCurrentIndex(1);
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == decodersWith(&DecoderTraits::ofAreas).size(); },
                              kPatience_ms));
  ASSERT_TRUE(idle());
  settle();
  std::size_t trained = 0;
  for (const DecoderTrial& trial : network.trials()) trained += trial.refusal.isEmpty() ? 1 : 0;
  EXPECT_GE(trained, 4u);
  EXPECT_EQ(find<ChartView>("trialsTime").chart().series.size(), trained);
  EXPECT_EQ(find<ChartView>("trialsError").chart().series.size(), trained);
}

TEST_F(NetworkScene, AnUndoneSettingBringsItsNetworkBack) {
  generate();
  trained();
  const double before = network.fit()->error.error.rmsePercentOfRange[0];
  find<QComboBox>("decoder").setCurrentText("linear"); // trains at once
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->settings.decoder == DecoderKind::Linear; }, kPatience_ms));
  ASSERT_TRUE(idle());
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->settings.decoder == DecoderKind::Rbf; }, kPatience_ms));
  EXPECT_EQ(network.fit()->error.error.rmsePercentOfRange[0], before);
  EXPECT_EQ(network.kept().size(), 2u);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_TRUE(QTest::qWaitFor([&] { return network.fit()->settings.decoder == DecoderKind::Linear; }, kPatience_ms))
      << "and done again";
}

TEST_F(NetworkScene, ANetworkOfResistancesGoesToLiveByOneButton) {
  generate();
  trained();
  auto& button = find<QPushButton>("useInLive");
  EXPECT_FALSE(button.isEnabled()) << "no board reads displacements";
  QTest::mouseClick(&find<QPushButton>("forLive"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return button.isEnabled(); }, kPatience_ms));
  ASSERT_TRUE(idle());
  QTemporaryDir folder;
  const QString file = folder.filePath("hand.json");
  answerFileDialog(file);
  QTest::mouseClick(&button, Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.project().live.network == file.toStdString(); }, kPatience_ms));
  EXPECT_TRUE(find<QWidget>("live").isVisible());
  EXPECT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("networkName").text().contains("hand.json"); }, kPatience_ms))
      << find<QLabel>("networkName").text().toStdString();

  // Another one into the same file: Live reads it again.
  auto& host = find<LiveBoards>("live").page().host();
  ASSERT_TRUE(idle());
  ASSERT_EQ(host.network().decoder()->kind, DecoderKind::Rbf);
  window.showScene("network");
  find<QComboBox>("decoder").setCurrentText("linear");
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->settings.decoder == DecoderKind::Linear; }, kPatience_ms));
  ASSERT_TRUE(idle());
  answerFileDialog(file);
  QTimer yes; // to the question whether the file may be replaced
  QObject::connect(&yes, &QTimer::timeout, &yes, [] {
    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
      QTest::mouseClick(box->button(QMessageBox::Yes), Qt::LeftButton);
  });
  yes.start(20);
  QTest::mouseClick(&button, Qt::LeftButton);
  EXPECT_TRUE(QTest::qWaitFor([&] { return host.network().decoder()->kind == DecoderKind::Linear; }, kPatience_ms));

  // The network that Live began with comes back by its button, and the project says so.
  Project own = workbench.project();
  own.live.network.clear();
  workbench.edit("Palp's own", own);
  ASSERT_TRUE(QTest::qWaitFor([&] { return host.network().file().empty(); }, kPatience_ms));
  ASSERT_EQ(host.network().nameBefore(), "hand.json");
  auto& back = find<QPushButton>("networkBack");
  ASSERT_TRUE(QTest::qWaitFor([&] { return back.isEnabled(); }, kPatience_ms));
  QTest::mouseClick(&back, Qt::LeftButton);
  EXPECT_EQ(host.network().decoder()->kind, DecoderKind::Linear);
  EXPECT_EQ(workbench.project().live.network, file.toStdString());
}

TEST_F(NetworkScene, AnEditOfTheNetworkDoesNotEndTheMakingOfSamples) {
  generate();
  trained();
  Project more = workbench.project();
  more.samples.perArea = 400; // so many that the edit comes first
  workbench.edit("more", more);
  QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
  ASSERT_TRUE(network.generating());
  EXPECT_FALSE(find<QPushButton>("train").isEnabled());
  find<QComboBox>("decoder").setCurrentText("linear");
  EXPECT_EQ(workbench.project().network.decoder, DecoderKind::Linear) << "the setting is taken";
  EXPECT_TRUE(network.generating()) << "and nothing is trained on the old samples";
  network.train(workbench.project().network);
  EXPECT_TRUE(network.generating()) << "whoever asks";
  EXPECT_TRUE(find<QLabel>("trainingProblem").text().contains("Samples are being generated"));
  network.cancel();
  ASSERT_TRUE(idle());
  EXPECT_TRUE(find<QPushButton>("train").isEnabled());
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

TEST_F(NetworkScene, TheNoiseBoundStandsBesideTheErrorsAndBelowTheDecoders) {
  Project more = workbench.project();
  more.samples.perArea = 20; // a curved response in three forces has ten coefficients
  workbench.edit("more", more);
  generate();
  find<QComboBox>("input").setCurrentIndex(1);
  find<QDoubleSpinBox>("noise").setValue(0.01);
  trained();
  const auto words = [&] { return find<QLabel>("fitWords").text(); };
  EXPECT_FALSE(words().contains("Cramer-Rao bound, with prior [% of range]")) << "without noise there is none";
  EXPECT_TRUE(words().contains("Set \"Test noise\" to see")) << words().toStdString();
  find<QDoubleSpinBox>("testNoise").setValue(0.01);
  const NoiseBound bound = noiseBound(network.samples()->training, InputKind::Resistance, {4}, 1e-4);
  const QString fx = QString::number(bound.withPriorPercent[0], 'g', 3);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return words().contains("Cramer-Rao bound, with prior [% of range]") && words().contains(fx); },
      kPatience_ms))
      << fx.toStdString() << " in " << words().toStdString();
  EXPECT_GT(network.fit()->error.error.rmsePercentOfRange[0], bound.withPriorPercent[0]);
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == decodersWith(&DecoderTraits::ofAreas).size(); },
                              kPatience_ms));
  ASSERT_TRUE(idle());
  auto& table = find<DataTable>("trialsTable");
  const int last = table.rowCount() - 1;
  EXPECT_EQ(last, static_cast<int>(decodersWith(&DecoderTraits::ofAreas).size()));
  EXPECT_EQ(table.item(last, 0)->text(), "bound");
  EXPECT_EQ(table.item(last, 1)->text(), QString::number(bound.withPriorPercent[0], 'g', 6));
}

TEST_F(NetworkScene, ADecoderOfTheComparisonIsTrainedAndListedByOneButton) {
  generate();
  trained();
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == decodersWith(&DecoderTraits::ofAreas).size(); },
                              kPatience_ms));
  ASSERT_TRUE(idle());
  auto& table = find<DataTable>("trialsTable");
  auto& train = find<QPushButton>("trainMarked");
  EXPECT_FALSE(train.isEnabled()) << "no row is marked";
  QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, table.visualItemRect(table.item(0, 0)).center());
  table.selectionModel()->setCurrentIndex(table.model()->index(table.rowCount() - 1, 0), QItemSelectionModel::NoUpdate);
  ASSERT_TRUE(train.isEnabled()) << "the cursor alone marks nothing";
  const std::size_t listed = network.kept().size();
  int row = 0;
  while (row < table.rowCount() && table.item(row, 0)->text() != "linear") ++row;
  ASSERT_LT(row, table.rowCount());
  QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, table.visualItemRect(table.item(row, 0)).center());
  QTest::mouseClick(&train, Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->settings.decoder == DecoderKind::Linear; }, kPatience_ms));
  ASSERT_TRUE(idle());
  EXPECT_EQ(network.kept().size(), listed + 1);
  EXPECT_EQ(network.fit()->error.error.rmsePercentOfRange,
            network.trials()[static_cast<std::size_t>(row)].error.rmsePercentOfRange)
      << "the numbers of the table";
  EXPECT_EQ(workbench.project().network.decoder, DecoderKind::Linear);
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
  const std::uint64_t seed = workbench.project().samples.seed;
  find<QSpinBox>("seed").setValue(static_cast<int>(seed) + 5);
  answerFileDialog(file);
  QTest::mouseClick(&find<QPushButton>("openSamples"), Qt::LeftButton);
  auto& said = find<QLabel>("trainingProblem");
  ASSERT_TRUE(QTest::qWaitFor([&] { return said.text().contains("already loaded"); }, kPatience_ms))
      << said.text().toStdString();
  EXPECT_EQ(network.fit(), fit);
  EXPECT_EQ(said.property("role").toString(), "hint") << "nothing is wrong: it is not red";
  EXPECT_EQ(workbench.project().samples.seed, seed) << "the panel says how they were made";
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
  EXPECT_EQ(workbench.project().network.chosenSpread, best);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit()->decoder.report.spread == best; }, kPatience_ms));
}

TEST_F(NetworkScene, ADecoderOfOneSpreadIsAPointThereAndOneOfNoneALineWithoutMarkers) {
  DecoderTrial rbf;
  rbf.spread = 12.5;
  rbf.error.eq13Percent = Eigen::Vector3d::Constant(0.5);
  DecoderTrial linear = rbf;
  linear.kind = DecoderKind::Linear;
  linear.spread = 0;
  linear.error.eq13Percent = Eigen::Vector3d::Constant(0.25);
  const ChartSpec chart = trialsErrorChart({rbf, linear}, {}, InputKind::Resistance);
  ASSERT_EQ(chart.series.size(), 2U);
  EXPECT_EQ(chart.series[0].style, ChartSeries::Style::Points);
  EXPECT_EQ(chart.series[0].x, std::vector<double>{12.5});
  EXPECT_EQ(chart.series[1].style, ChartSeries::Style::Line);
  EXPECT_EQ(chart.series[1].x.back(), 12.5) << "the width goes as far as the point";
  const QStringList rows = chartCsv(chart).trimmed().split('\n');
  ASSERT_EQ(rows.size(), 3) << "one a decoder below the heads";
  EXPECT_EQ(rows[1], "rbf,12.5,0.5");
  EXPECT_EQ(rows[2], "linear,,0.25");
}

TEST_F(NetworkScene, TheTableOfDecodersSaysNothingOfAForceThatWasNeverTrainedAndWhichPlacesAreBest) {
  DecoderTrial first;
  first.error.rmsePercentOfRange = first.error.eq13Percent = Eigen::Vector3d(0, 2, 3);
  first.place = PlaceError{Eigen::Vector2d(0.6, 0.7), 0.5, {}};
  DecoderTrial second = first;
  second.kind = DecoderKind::TouchInversion;
  second.error.rmsePercentOfRange.y() = 4;
  second.place->median_mm = 0.25;
  NetworkSamples samples;
  samples.training.forces_N = Eigen::Matrix3Xd::Ones(3, 2);
  samples.training.forces_N.row(0).setZero();
  const TableText table = trialsTable({first, second}, nullptr, &samples);
  EXPECT_EQ(table.rows[0].mid(1, 6), QStringList({"-", "2", "3", "-", "2", "3"}));
  SweepPoint point;
  point.error = first.error;
  point.report.leaveOneOut = Eigen::Vector3d(0, 2, 3);
  EXPECT_EQ(sweepTable({point}, &samples).rows[0].mid(1, 9),
            QStringList({"-", "2", "3", "-", "2", "3", "-", "2", "3"}));
  EXPECT_EQ(bestTrial({first, second}), 0U) << "by the force";
  EXPECT_EQ(bestPlace({first, second}), 1U);
  EXPECT_EQ(bestPlace({DecoderTrial()}), std::nullopt) << "it learned none";
}

TEST_F(NetworkScene, AComparisonOfOtherSettingsIsFaintWithTheReason) {
  generate();
  QTest::mouseClick(&find<QPushButton>("compare"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.trials().size() == decodersWith(&DecoderTraits::ofAreas).size(); },
                              kPatience_ms));
  ASSERT_TRUE(idle());
  EXPECT_FALSE(find<ChartView>("trialsError").faint());
  find<QDoubleSpinBox>("noise").setValue(0.01);
  EXPECT_TRUE(find<ChartView>("trialsError").faint());
  EXPECT_TRUE(find<QLabel>("trialsWords").text().contains("noise of the training 0 %, now 0.01 %"))
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
