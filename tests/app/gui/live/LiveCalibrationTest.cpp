// Calibration with known loads, and the network in use.

#include "app/gui/live/LiveCalibration.h"
#include "app/gui/live/panels/KnownLoad.h"
#include "app/gui/project/ProjectFile.h"
#include "tests/app/gui/live/LiveOperatorFixture.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableWidget>

#include <cmath>
#include <functional>

namespace palp {
namespace {

class LiveCalibrating : public LiveOperator {
protected:
  LiveCalibration& calibration() { return find<LiveCalibration>("calibration"); }
  /// Labelled frames of whatever is pressed now, with these forces in z.
  bool collect(int frames, double force_N) {
    const Agreeing agreeing;
    page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
    type<QSpinBox>("labelFrames", "1");
    for (int k = 0; k < frames; ++k) {
      type<QSpinBox>("labelArea", QString::number(k % 6));
      type<QDoubleSpinBox>("label_Fz", QString::number(force_N * k));
      const Eigen::Index before = calibration().frames().samples().size();
      click("collect");
      if (!wait([&] { return calibration().frames().samples().size() == before + 1; })) return false;
    }
    return true;
  }
  /// Also where it is asked about.
  void useFit() {
    const Agreeing agreeing;
    click("useCalibration");
  }
  bool fit() {
    click("fitCalibration");
    return wait([&] { return calibration().calibration().has_value() && !calibration().runner().running(); });
  }
};

TEST_F(LiveCalibrating, GoesBackToTheNetworkBeforeACalibrationAndMarksBothInTheRecording) {
  ASSERT_TRUE(waitForArrow());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  ASSERT_TRUE(collect(9, -0.5));
  ASSERT_TRUE(fit());
  const std::string before = page.host().network().decoder()->trainedWith;
  useFit();
  auto& name = find<QLabel>("networkName");
  EXPECT_TRUE(wait([&] { return name.text().startsWith("calibrated, 9 frames, 2"); })) << name.text().toStdString();
  const Eigen::MatrixXd calibrated_N = page.host().network().decoder()->residual_N;
  click("networkBack");
  EXPECT_TRUE(wait([&] { return name.text().startsWith("Built-in network"); })) << name.text().toStdString();
  EXPECT_NE(page.host().network().decoder()->residual_N, calibrated_N);
  EXPECT_EQ(page.host().network().decoder()->trainedWith, before);
  ASSERT_TRUE(wait([&] { return !find<QPushButton>("shippedNetwork").isEnabled(); })) << "it is in use";
  ASSERT_TRUE(waitForFrames());
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(wait([&] { return marksOf(file).size() == 2; }));
  EXPECT_EQ(marksOf(file)[0].rfind("network: calibrated, 9 frames", 0), 0U) << marksOf(file)[0];
  EXPECT_EQ(marksOf(file)[1].rfind("network: Built-in network", 0), 0U) << marksOf(file)[1];
}

TEST_F(LiveCalibrating, FramesAndNetworkInUseArePartOfTheProjectAndAnotherProjectHasNeither) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(collect(9, -0.5));
  EXPECT_EQ(workbench.modification(), Workbench::Modified::Calibration);
  ASSERT_TRUE(fit());
  useFit();
  ASSERT_NE(workbench.project().live.calibrated, nullptr);
  const Eigen::MatrixXd calibrated_N = page.host().network().decoder()->residual_N;
  const Project saved = parseProject(projectText(workbench.project()), "x.json", {});

  workbench.replace(exampleProject());
  EXPECT_TRUE(wait([&] { return page.host().network().calibrated() == nullptr && !page.host().network().loading(); }));
  EXPECT_EQ(page.host().network().name(), "Built-in network");
  EXPECT_EQ(page.host().network().nameBefore(), "") << "the network of the project before";
  EXPECT_EQ(calibration().frames().samples().size(), 0);
  EXPECT_FALSE(calibration().calibration().has_value());

  workbench.replace(saved);
  EXPECT_TRUE(wait([&] { return page.host().network().name().startsWith("calibrated, 9 frames"); }));
  EXPECT_EQ(page.host().network().decoder()->residual_N, calibrated_N);
  EXPECT_EQ(calibration().frames().samples().size(), 9);
  EXPECT_FALSE(find<QTableWidget>("labelledFrames").item(8, 2)->text().isEmpty());
  EXPECT_FALSE(workbench.modified());
  ASSERT_TRUE(wait([&] { return find<QPushButton>("shippedNetwork").isEnabled(); }));
  click("shippedNetwork");
  EXPECT_TRUE(wait([&] { return page.host().network().name() == "Built-in network"; }));
  EXPECT_EQ(workbench.project().live.calibrated, nullptr);
  EXPECT_TRUE(workbench.modified());
}

TEST_F(LiveCalibrating, SaysThatTheLabelsDoNotBelongToTheFrames) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(collect(12, -0.5)); // whatever was pressed
  auto& table = find<QTableWidget>("labelledFrames");
  EXPECT_FALSE(table.item(0, 2)->text().isEmpty()) << "what the network said stands beside the label";
  ASSERT_TRUE(fit());
  EXPECT_TRUE(find<QLabel>("calibrationReport").text().contains("Poor fit"));
  EXPECT_TRUE(find<QLabel>("calibrationReport").text().contains("the model under these labels"));
  const auto worst = static_cast<int>(calibration().calibration()->report.worstSample);
  EXPECT_TRUE(find<QLabel>("calibrationReport").text().contains(QString("row %1 of the table").arg(worst + 1)))
      << "the table counts from 1";
}

TEST_F(LiveCalibrating, AsksBeforeABadFitIsUsedAndItsDeviationsHoldWhatItLeft) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(collect(12, -0.5)); // whatever was pressed
  ASSERT_TRUE(fit());
  const double usual_N = page.host().history().last()->forces.standardDeviation_N(2, 0);
  answerQuestion(QMessageBox::No);
  click("useCalibration");
  EXPECT_TRUE(find<QLabel>("networkName").text().startsWith("Built-in network"));
  useFit();
  ASSERT_TRUE(wait([&] { return find<QLabel>("networkName").text().startsWith("calibrated, 12 frames"); }));
  const double left_N = calibration().calibration()->report.rmseAfter_N(2);
  EXPECT_GT(left_N, 3 * usual_N);
  EXPECT_TRUE(wait([&] {
    const LiveFrame* last = page.host().history().last();
    return last->forces.valid && last->forces.standardDeviation_N(2, 0) >= left_N;
  }));
  EXPECT_TRUE(wait([&] { return find<QLabel>("liveTrustUnit").text().contains("calibrated with 12 frames"); }))
      << find<QLabel>("liveTrustUnit").text().toStdString();
}

TEST_F(LiveCalibrating, SaysThatTheNetworkSeesTheLoadOnAnotherArea) {
  ASSERT_TRUE(waitForArrow());
  use([](LiveSettings& live) {
    live.simulation.held = true;
    live.simulation.heldArea = 5;
    live.simulation.heldForce_N = {0, 0, -3};
  });
  ASSERT_TRUE(wait([&] {
    const LiveFrame* last = page.host().history().last();
    return last != nullptr && last->forces.area == 5 && last->forces.areaConfidence > 0.99 &&
           last->forces.shown == std::vector<bool>{true};
  }));
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  type<QSpinBox>("labelFrames", "5");
  type<QSpinBox>("labelArea", "0");
  type<QDoubleSpinBox>("label_Fz", "-3");
  click("collect");
  ASSERT_TRUE(wait([&] { return calibration().frames().samples().size() == 1; }));
  EXPECT_TRUE(isRed("calibrationProblem"));
  const QString words = find<QLabel>("calibrationProblem").text();
  EXPECT_TRUE(words.contains("area 5") && words.contains("area 0")) << words.toStdString();
  EXPECT_EQ(page.unsavedFrames(), 1) << "they are asked about at quitting";
  type<QSpinBox>("labelArea", "5");
  click("collect");
  ASSERT_TRUE(wait([&] { return calibration().frames().samples().size() == 2; }));
  EXPECT_TRUE(find<QLabel>("calibrationProblem").text().isEmpty())
      << find<QLabel>("calibrationProblem").text().toStdString();
  answerFileDialog(folder.filePath("frames.csv"));
  click("saveFrames");
  EXPECT_TRUE(calibration().writer().running()) << "off the window's thread";
  EXPECT_EQ(page.unsavedFrames(), 2) << "they are in no file yet";
  EXPECT_TRUE(wait([&] { return page.unsavedFrames() == 0; }));
  EXPECT_EQ(said.filter("Saved the labelled frames to ").size(), 1) << said.join('|').toStdString();
}

TEST_F(LiveCalibrating, AsksWhereTheLabelIsClearlyNotWhatPresses) {
  use([](LiveSettings& live) {
    live.simulation.held = true;
    live.simulation.heldForce_N = {0, 0, 0};
  });
  ASSERT_TRUE(waitForFrames(40));
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  EXPECT_TRUE(wait([&] { return find<QLabel>("calibrationReport").text().contains("Touch by hand"); }));
  type<QSpinBox>("labelFrames", "3");
  type<QSpinBox>("labelArea", "2");
  type<QDoubleSpinBox>("labelMass", "500");
  QString asked;
  const auto answer = [&](const std::function<QAbstractButton*(QMessageBox&)>& chosen) {
    auto* timer = new QTimer(&page);
    QObject::connect(timer, &QTimer::timeout, timer, [&asked, timer, chosen] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr) return;
      timer->stop();
      asked = box->text();
      QTest::mouseClick(chosen(*box), Qt::LeftButton);
    });
    timer->start(20);
  };
  answer([](QMessageBox& box) { return box.button(QMessageBox::No); });
  click("collect");
  EXPECT_TRUE(asked.contains("(0.00, 0.00, -4.90) N") && asked.contains("as at rest")) << asked.toStdString();
  EXPECT_FALSE(calibration().frames().collecting());
  answer([](QMessageBox& box) { return box.findChild<QAbstractButton*>("putSimulatedLoad"); });
  click("collect");
  EXPECT_FALSE(calibration().frames().collecting());
  EXPECT_EQ(workbench.project().live.simulation.heldArea, 2);
  EXPECT_NEAR(workbench.project().live.simulation.heldForce_N[2], -4.903, 1e-3);
  ASSERT_TRUE(wait([&] { return find<QLabel>("reads_Fz").text().toDouble() < -4; }));
  ASSERT_TRUE(waitForFrames(3));
  asked.clear();
  click("collect"); // without a question
  ASSERT_TRUE(wait([&] { return calibration().frames().samples().size() == 1; })) << asked.toStdString();
  type<QDoubleSpinBox>("label_Fz", "0"); // the weight lies there still
  answer([](QMessageBox& box) { return box.button(QMessageBox::No); });
  click("collect");
  EXPECT_TRUE(asked.contains("check that the sensor is at rest")) << asked.toStdString();
  EXPECT_EQ(calibration().frames().samples().size(), 1);
}

TEST_F(LiveCalibrating, NoButtonIsCutAtTheUsualSizeAndBackSaysWhyItIsGrey) {
  page.resize(1360, 850); // in a window of 1500 x 940
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  ASSERT_TRUE(waitForFrames());
  for (const char* name : {"loadFrames", "saveFrames", "removeFrame", "fitCalibration", "useCalibration",
                           "saveCalibration", "backFromCalibration"}) {
    auto& button = find<QPushButton>(name);
    EXPECT_TRUE(wait([&] { return button.visibleRegion().boundingRect() == button.rect(); })) << name;
  }
  EXPECT_FALSE(find<QPushButton>("backFromCalibration").isEnabled());
  EXPECT_TRUE(find<QPushButton>("backFromCalibration").toolTip().contains("there is none"));
}

TEST_F(LiveCalibrating, RefusesALoadThatMovesInsideAMean) {
  ASSERT_TRUE(waitForArrow());
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  type<QSpinBox>("labelFrames", "120"); // longer than a touch of the demo
  const Agreeing agreeing;
  click("collect");
  ASSERT_TRUE(isRed("calibrationProblem"));
  EXPECT_TRUE(find<QLabel>("calibrationProblem").text().contains("moved")) << "nothing was said";
  EXPECT_EQ(calibration().frames().samples().size(), 0);
}

TEST_F(LiveCalibrating, ANetworkThatCannotBeUsedLeavesTheOneInUse) {
  ASSERT_TRUE(waitForArrow());
  const QString broken = folder.filePath("broken.json");
  QFile file(broken);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("{\"palp_network\": 1}");
  file.close();
  answerFileDialog(broken);
  click("chooseNetwork");
  ASSERT_TRUE(isRed("networkProblem"));
  EXPECT_TRUE(find<QLabel>("networkProblem").text().contains("broken.json"));
  EXPECT_EQ(workbench.project().live.network, "");
  EXPECT_TRUE(page.host().network().decoder().has_value());
  EXPECT_TRUE(find<QLabel>("networkName").text().startsWith("Built-in network"));
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(page.host().history().last()->forces.valid);
}

TEST_F(LiveCalibrating, TheNetworkOfPalpIsHadBackAfterOneThatWasRefined) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(collect(9, -0.5));
  ASSERT_TRUE(fit());
  useFit();
  ASSERT_TRUE(wait([&] { return find<QPushButton>("shippedNetwork").isEnabled(); }));
  click("shippedNetwork");
  auto& name = find<QLabel>("networkName");
  EXPECT_TRUE(wait([&] { return name.text().startsWith("Built-in network"); })) << name.text().toStdString();
  EXPECT_TRUE(page.host().network().nameBefore().isEmpty());
}

TEST_F(LiveCalibrating, ARecordingIsNamedWhereANetworkIsWanted) {
  ASSERT_TRUE(waitForArrow());
  const QString file = folder.filePath("touch.palprec");
  ASSERT_TRUE(records(file, 5));
  use([&](LiveSettings& live) { live.network = file.toStdString(); });
  ASSERT_TRUE(isRed("networkProblem"));
  EXPECT_TRUE(find<QLabel>("networkProblem")
                  .text()
                  .contains("touch.palprec: is a recording, not a network. Still in use: Built-in network"))
      << find<QLabel>("networkProblem").text().toStdString();
}

TEST_F(LiveCalibrating, TakesAKnownLoadAsAMassThatRestsOnTheAreaOrPullsItSideways) {
  ASSERT_TRUE(waitForArrow());
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  type<QDoubleSpinBox>("labelMass", "100");
  const auto force_N = [&](const char* axis) { return find<QDoubleSpinBox>(axis).value(); };
  EXPECT_NEAR(force_N("label_Fz"), -0.980665, 1e-4); // 0.1 kg times 9.80665 m/s2
  EXPECT_EQ(force_N("label_Fx"), 0);
  auto& direction = find<QComboBox>("labelDirection");
  direction.setFocus();
  QTest::keyClick(&direction, Qt::Key_Down);
  EXPECT_EQ(direction.currentText(), "along +x");
  EXPECT_NEAR(force_N("label_Fx"), 0.980665, 1e-4);
  EXPECT_EQ(force_N("label_Fz"), 0) << "the thread carries none of it";
  type<QDoubleSpinBox>("label_Fy", "-0.2");
  EXPECT_EQ(find<QDoubleSpinBox>("labelMass").text(), "none") << "a force that was typed is no mass";
  EXPECT_NEAR(force_N("label_Fx"), 0.980665, 1e-4);
}

TEST_F(LiveCalibrating, SuggestsThreeWeightsAndShowsWhatTheNetworkReadsBesideTheLabel) {
  ASSERT_TRUE(waitForArrow());
  page.findChild<QTabWidget*>("curveTabs")->setCurrentIndex(1);
  const double most_N = -page.host().network().decoder()->low_N(2);
  double before_N = most_N;
  for (const char* name : {"suggestedMass0", "suggestedMass1", "suggestedMass2"}) {
    click(name);
    const double push_N = -find<QDoubleSpinBox>("label_Fz").value();
    EXPECT_GT(push_N, 0) << name;
    EXPECT_LE(push_N, before_N) << name;
    before_N = push_N;
  }
  click("suggestedMass0");
  EXPECT_GT(-find<QDoubleSpinBox>("label_Fz").value(), 0.35 * most_N) << "the heaviest uses the network's range";
  EXPECT_TRUE(wait([&] {
    bool ok = false;
    const double reads_N = find<QLabel>("reads_Fz").text().toDouble(&ok);
    return ok && reads_N < 0;
  })) << "the demo presses";
  type<QSpinBox>("labelFrames", "1");
  const Agreeing agreeing;
  click("collect");
  ASSERT_TRUE(wait([&] { return calibration().frames().samples().size() == 1; }));
  auto& table = find<QTableWidget>("labelledFrames");
  const auto third = [&](int column) { return table.item(0, column)->text().split(", ").value(2).toDouble(); };
  EXPECT_NEAR(third(1), find<QDoubleSpinBox>("label_Fz").value(), 1e-3);
  EXPECT_NEAR(third(2), calibration().frames().predicted_N()(2, 0), 1e-3);
}

TEST(SuggestedMasses, AreOfAnOrdinarySetOfWeightsWithinTheRange) {
  EXPECT_EQ(suggestedMasses_g(3), (std::array<double, 3>{200, 100, 50})); // 306 g
  EXPECT_EQ(suggestedMasses_g(0.03), (std::array<double, 3>{2, 1, 0}));   // 3.06 g
  EXPECT_EQ(suggestedMasses_g(0), (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(suggestedMasses_g(std::nan("")), (std::array<double, 3>{0, 0, 0}));
}

TEST_F(LiveCalibrating, FitsOnlyWhereThereAreFramesEnoughAndSaysHowManyThereAre) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(collect(7, -0.5));
  EXPECT_FALSE(find<QPushButton>("fitCalibration").isEnabled());
  EXPECT_TRUE(find<QLabel>("calibrationReport").text().contains("7 of 8 so far"))
      << find<QLabel>("calibrationReport").text().toStdString();
  ASSERT_TRUE(collect(1, -0.5));
  EXPECT_TRUE(find<QPushButton>("fitCalibration").isEnabled());
  ASSERT_TRUE(fit());
  const auto report = [&] { return find<QLabel>("calibrationReport").text(); };
  EXPECT_FALSE(report().contains("The frames have changed"));
  find<QTableWidget>("labelledFrames").selectRow(3);
  click("removeFrame");
  EXPECT_TRUE(report().contains("The frames have changed since the fit: 7 now, 8 are needed"))
      << report().toStdString();
}

} // namespace
} // namespace palp
