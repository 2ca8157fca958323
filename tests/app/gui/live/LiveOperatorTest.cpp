// What an operator looks at and sets: the simulated board, curves, scales, alarms, the touch by hand.

#include "app/gui/views/HeatmapView.h"
#include "app/gui/views/StripChart.h"
#include "tests/app/gui/live/LiveOperatorFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSignalSpy>
#include <QSpinBox>

#include <array>
#include <cmath>

namespace palp {
namespace {

TEST_F(LiveOperator, DrawsNoCurveThroughTheTimeThatTheBoardWasOut) {
  ASSERT_TRUE(waitForFrames(20));
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Searching));
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Streaming));
  ASSERT_TRUE(waitForFrames(20));
  for (const char* name : {"forceCurves", "changeCurves"}) {
    ASSERT_TRUE(wait([&] {
      const std::vector<StripSeries>& series = find<StripChart>(name).chart().series;
      return !series.empty() &&
             std::any_of(series[0].y.begin(), series[0].y.end(), [](double y) { return std::isnan(y); });
    })) << name;
  }
}

TEST_F(LiveOperator, SaysNothingAgainstTheUntouchedDemoAndDoubtsADriftingBoard) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(waitForFrames(150));
  for (const LiveHistory::Entry& entry : page.host().history().entries()) EXPECT_EQ(entry.frame->forces.doubt, "");
  EXPECT_TRUE(wait([&] { return find<QLabel>("liveTrust").text() == "plausible"; }));
  type<QDoubleSpinBox>("warming", "100");
  EXPECT_TRUE(wait([&] { return find<QLabel>("liveTrust").text() == "implausible"; }));
  EXPECT_EQ(find<QLabel>("liveTrust").property("role"), "problem");
}

TEST_F(LiveOperator, SuggestsATareWhereTheBoardHasDriftedUntilItIsDone) {
  ASSERT_TRUE(waitForFrames());
  find<QCheckBox>("touchHeld").click();
  type<QDoubleSpinBox>("touch_Fz", "0");
  type<QDoubleSpinBox>("warming", "20");
  ASSERT_TRUE(wait([&] { return find<QPushButton>("tare").text() == "Tare now (drifted)"; }));
  EXPECT_TRUE(find<QLabel>("liveClimateUnit").text().contains("N: tare"));
  type<QDoubleSpinBox>("warming", "0");
  click("tare");
  EXPECT_TRUE(wait([&] { return page.host().status().tared && find<QPushButton>("tare").text() == "Tare"; }));
}

TEST_F(LiveOperator, ThePanelsAreNoWiderThanTheirPlace) {
  ASSERT_TRUE(waitForFrames());
  for (const char* name : {"plug", "networkBack", "record", "alarmLimit", "forceScale", "touch_Fz", "openAgain"}) {
    auto& widget = find<QWidget>(name);
    EXPECT_LE(widget.mapTo(&page, QPoint(widget.width(), 0)).x(), 8 + 340) << name;
  }
}

TEST_F(LiveOperator, TheSimulatedBoardSimulatesTheProjectsDesign) {
  Project small = workbench.project();
  small.design.lower.wire_mm.resize(12);
  if (small.design.lower.along_mm.size() > 1) small.design.lower.along_mm.resize(12);
  small.mesh.mapped = {6, 6, 2};
  ASSERT_TRUE(check(small.design).empty()) << check(small.design)[0].sentence;
  workbench.edit("fewer wires", small);
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(wait([&] { return find<QLabel>("simulatedDesign").text().contains("not the project's"); }));
  click("simulateDesign");
  ASSERT_TRUE(wait([&] { return page.host().simulatesOwnDesign(); })) << said.join("; ").toStdString();
  ASSERT_TRUE(wait([&] { return page.host().status().info && page.host().status().info->columnWires == 12; }));
  EXPECT_TRUE(waitForArrow()) << page.host().status().decoderProblem;
  EXPECT_TRUE(wait([&] { return find<QLabel>("networkName").text().startsWith("Network of the simulated design"); }));
  recordTo(folder.filePath("own.palprec"));
  ASSERT_TRUE(startsToRecord());
  workbench.history().undo(); // the paper's design again, and its board and network
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(page.host().status().recording) << "a recording is of one sensor";
  EXPECT_EQ(page.host().status().info->columnWires, 12);
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(wait([&] { return page.host().status().info && page.host().status().info->columnWires == 30; }));
  EXPECT_TRUE(wait([&] { return find<QLabel>("networkName").text().startsWith("Built-in network"); }));
  EXPECT_TRUE(waitForArrow());
}

TEST_F(LiveOperator, AMovingIndenterDrivesTheBoardAndItsTruePlaceStandsBesideTheDecodedOne) {
  Project coarse = workbench.project();
  coarse.mesh.mapped = {20, 20, 1}; // nodes near enough that the lightest touch meets some
  workbench.edit("a coarse mesh", coarse);
  ASSERT_TRUE(waitForFrames());
  find<QCheckBox>("movingIndenter").click();
  // Touches are solved and learned first: a minute and a half of CPU.
  const auto moves = [&] { return page.host().simulatesOwnDesign(); };
  ASSERT_TRUE(wait(moves) || wait(moves) || wait(moves)) << said.join("; ").toStdString();
  const auto decoded = [&]() -> std::optional<Eigen::Vector2d> {
    const auto& arrows = block().arrows();
    return arrows.empty() || block().stale() ? std::nullopt : arrows[0].place_mm;
  };
  ASSERT_TRUE(wait([&] { return decoded() && block().truth_mm(); })) << page.host().status().decoderProblem;
  const Eigen::Vector2d wandered = *block().truth_mm();
  // By hand: pressed in the picture, dragged, and by keys.
  find<QCheckBox>("touchHeld").click();
  block().setFocus();
  const auto hand = [&]() -> const SimulationSettings& { return workbench.project().live.simulation; };
  const QPoint middle = block().rect().center();
  QTest::mousePress(&block(), Qt::LeftButton, {}, middle);
  QTest::mouseRelease(&block(), Qt::LeftButton, {}, middle);
  const Eigen::Vector2d pressed(hand().heldPlace_mm.data());
  EXPECT_NE(pressed, wandered);
  drag(block(), middle, middle + QPoint(30, 0));
  EXPECT_GT(hand().heldPlace_mm[0], pressed.x() + 1);
  const double before = hand().heldPlace_mm[1];
  QTest::keyClick(&block(), Qt::Key_Up);
  EXPECT_NEAR(hand().heldPlace_mm[1], before + 0.5, 1e-9);
  const Eigen::Vector2d held(hand().heldPlace_mm.data());
  EXPECT_TRUE(wait([&] { return block().truth_mm() && (*block().truth_mm() - held).norm() < 0.01; }));
  // Of a mesh as coarse as this the answer jumps from node to node: nearer to the right one of two places is what it
  // can say.
  const std::array<Eigen::Vector2d, 2> places{{{8, 8}, {22, 22}}};
  for (const std::size_t k : {0U, 1U}) {
    use([&](LiveSettings& live) {
      live.simulation.heldPlace_mm = {places[k].x(), places[k].y()};
      live.simulation.heldForce_N[2] = -4;
    });
    EXPECT_TRUE(wait([&] {
      return decoded() && block().truth_mm() == places[k] &&
             (*decoded() - places[k]).norm() < 0.5 * (*decoded() - places[1 - k]).norm();
    })) << k;
  }
  find<QCheckBox>("movingIndenter").click();
  EXPECT_TRUE(wait([&] { return !block().truth_mm(); }));
}

TEST_F(LiveOperator, PullingOutAndPluggingInMovesNoButton) {
  ASSERT_TRUE(waitForFrames());
  auto& plug = find<QPushButton>("plug");
  QPoint place;
  ASSERT_TRUE(wait([&] { // the layout is done
    const QPoint before = std::exchange(place, plug.mapTo(&page, QPoint()));
    return place == before && plug.isVisible();
  }));
  for (int k = 0; k < 2; ++k) {
    click("plug");
    ASSERT_TRUE(waitForState(LiveState::Searching));
    ASSERT_TRUE(wait([&] { return plug.text() == "Plug in" && !banner().isEmpty(); }));
    EXPECT_EQ(plug.mapTo(&page, QPoint()), place);
    click("plug");
    ASSERT_TRUE(waitForState(LiveState::Streaming));
    ASSERT_TRUE(wait([&] { return plug.text() == "Unplug" && banner().isEmpty(); }));
    EXPECT_EQ(plug.mapTo(&page, QPoint()), place);
  }
}

TEST_F(LiveOperator, ZoomsAndMovesACurveWhileTheLiveOneWaits) {
  ASSERT_TRUE(waitForArrow());
  auto& chart = find<StripChart>("forceCurves");
  const double window_s = chart.chart().window_s;
  wheel(chart, 120);
  EXPECT_TRUE(chart.held());
  EXPECT_LT(chart.chart().window_s, window_s);
  const double end_s = chart.chart().end_s;
  ASSERT_TRUE(waitForFrames());
  EXPECT_EQ(chart.chart().end_s, end_s) << "it runs on under the eyes";
  drag(chart, chart.rect().center(), chart.rect().center() + QPoint(60, 0));
  EXPECT_LT(chart.chart().end_s, end_s);
  const auto timesIn = [](const QString& csv) {
    std::vector<double> times;
    for (const QString& row : csv.split('\n', Qt::SkipEmptyParts).mid(1))
      times.push_back(row.section(',', 0, 0).toDouble());
    return times;
  };
  const auto onlySeen = [&] { // how many came so early is the machine's affair
    const std::vector<double> times = timesIn(chart.asCsv());
    EXPECT_TRUE(times.empty() || times.back() - times.front() <= chart.chart().window_s + 1e-5)
        << "of what is not seen nothing is saved";
  };
  onlySeen();
  QTest::mouseDClick(&chart, Qt::LeftButton, {}, chart.rect().center());
  EXPECT_FALSE(chart.held());
  EXPECT_TRUE(wait([&] { return chart.chart().end_s > end_s && chart.chart().window_s == window_s; }));
  ASSERT_TRUE(waitForFrames(30));
  onlySeen();
  const QStringList lines = chart.asCsv().split('\n', Qt::SkipEmptyParts);
  EXPECT_TRUE(lines[0].startsWith("t_s,\"Fx force [N]\",\"Fy force [N]\",\"Fz force [N]\",\"sd of Fx"));
  ASSERT_GT(lines.size(), 20);
  EXPECT_EQ(lines[1].count(','), 6);
}

TEST_F(LiveOperator, ScalesTheForceAsOneLikes) {
  ASSERT_TRUE(waitForArrow());
  auto& chart = find<StripChart>("forceCurves");
  auto& scale = find<QComboBox>("forceScale");
  scale.setCurrentIndex(scale.findData(2.0));
  EXPECT_EQ(workbench.project().live.forceScale, ForceScale::Fixed);
  EXPECT_TRUE(wait([&] { return chart.chart().yRange == std::array{-2.0, 2.0}; }));
  scale.setCurrentIndex(scale.findData(-1.0));
  EXPECT_TRUE(wait([&] { return chart.chart().yRange != std::array{-2.0, 2.0}; }));
  double low = 0;
  for (const StripSeries& series : chart.chart().series)
    for (const double y : series.y)
      if (std::isfinite(y)) low = std::min(low, y);
  EXPECT_LE(chart.chart().yRange[0], low);
}

TEST_F(LiveOperator, AForceBeyondTheNetworksRangeIsInThePicture) {
  ASSERT_TRUE(waitForArrow());
  auto& chart = find<StripChart>("forceCurves");
  const double usual_N = chart.chart().yRange[0];
  use([](LiveSettings& live) {
    live.simulation.held = true;
    live.simulation.heldArea = 1;
    live.simulation.heldForce_N = {0, 0, -9};
  });
  ASSERT_TRUE(wait([&] {
    const LiveFrame* last = page.host().history().last();
    return last != nullptr && last->forces.valid && last->forces.forces_N.minCoeff() < usual_N - 0.5;
  }));
  EXPECT_TRUE(wait([&] {
    double low = 0;
    for (const StripSeries& series : chart.chart().series)
      for (const double y : series.y)
        if (std::isfinite(y)) low = std::min(low, y);
    return low < usual_N && chart.chart().yRange[0] <= low;
  }));
}

TEST_F(LiveOperator, AnAlarmGoesOffIsSeenAndMarked) {
  ASSERT_TRUE(waitForFrames());
  const QString file = folder.filePath("touch.palprec");
  recordTo(file);
  ASSERT_TRUE(startsToRecord());
  type<QDoubleSpinBox>("alarmLimit", "-1");
  find<QCheckBox>("alarmOn").click();
  ASSERT_TRUE(wait([&] { return banner().contains("is below -1 N"); }));
  EXPECT_TRUE(wait([&] { return said.join(' ').contains("is below -1 N"); }));
  EXPECT_EQ(find<StripChart>("forceCurves").chart().limits, std::vector<double>{-1});
  ASSERT_TRUE(wait([&] { return banner().isEmpty(); })) << "the touch has gone";
  ASSERT_TRUE(stopsToRecord());
  ASSERT_TRUE(wait([&] { return !marksOf(file).empty(); }));
  EXPECT_EQ(marksOf(file)[0].rfind("alarm: Fz", 0), 0U) << marksOf(file)[0];
}

TEST_F(LiveOperator, AnAlarmTintsItsTimeAndItsWordsStandOnce) {
  ASSERT_TRUE(waitForFrames());
  type<QDoubleSpinBox>("alarmLimit", "-1");
  find<QCheckBox>("alarmOn").click();
  ASSERT_TRUE(wait([&] { return page.host().status().alarms >= 2; }));
  const auto& chart = find<StripChart>("forceCurves").chart();
  ASSERT_TRUE(wait([&] { return chart.spans.size() >= 2; }));
  ASSERT_FALSE(chart.marks.empty());
  for (const auto& [t_s, words] : chart.marks) EXPECT_TRUE(words.startsWith("alarm: Fz")) << words.toStdString();
  for (const auto& [from_s, to_s] : chart.spans) EXPECT_LE(to_s - from_s, 3) << "longer than a touch";
  EXPECT_GT(chart.spans[0][1], chart.spans[0][0]);
}

TEST_F(LiveOperator, ATareUnderALoadIsAskedFor) {
  ASSERT_TRUE(waitForFrames());
  find<QCheckBox>("touchHeld").click();
  type<QDoubleSpinBox>("touch_Fz", "-2");
  type<QSpinBox>("tareFrames", "3");
  const auto reads = [&](double fz_N) {
    return wait([&] {
      const LiveFrame* last = page.host().history().last();
      return last != nullptr && last->forces.valid && last->forces.shown[0] && last->forces.doubt.empty() &&
             std::abs(last->forces.forces_N(2, 0) - fz_N) < 0.1;
    });
  };
  ASSERT_TRUE(reads(-2));
  ASSERT_TRUE(waitForFrames(40)); // it is held
  answerQuestion(QMessageBox::No);
  click("tare");
  ASSERT_TRUE(waitForFrames(10));
  EXPECT_FALSE(page.host().status().tared);
  EXPECT_FALSE(page.host().status().taring);
  answerQuestion(QMessageBox::Yes);
  click("tare");
  EXPECT_TRUE(wait([&] { return page.host().status().tared; }));
}

TEST_F(LiveOperator, AnArrowOfTheLossesLeadsPastThatOfAllReports) {
  ASSERT_TRUE(waitForFrames());
  auto& losses = find<QSpinBox>("dropEvery");
  losses.setFocus();
  QTest::keyClick(&losses, Qt::Key_Up);
  EXPECT_EQ(losses.value(), 10);
  for (int k = 0; k < 9; ++k) QTest::keyClick(&losses, Qt::Key_Down);
  EXPECT_EQ(losses.text(), "none");
  EXPECT_EQ(workbench.project().live.simulation.dropEvery, 0);
}

TEST_F(LiveOperator, HoldsATouchWhereOnePressesAndHowOneTypes) {
  ASSERT_TRUE(waitForArrow());
  find<QCheckBox>("touchHeld").click();
  type<QSpinBox>("touchArea", "4");
  type<QDoubleSpinBox>("touch_Fz", "-3");
  const auto reads = [&](int area, double fz_N) {
    return wait([&] {
      const LiveFrame* last = page.host().history().last();
      return last != nullptr && last->forces.valid && last->forces.area == area &&
             std::abs(last->forces.forces_N(2, 0) - fz_N) < 0.05;
    });
  };
  ASSERT_TRUE(reads(4, -3));
  // The arrow is drawn where the area is: a press somewhere else moves the touch there.
  QSignalSpy pressed(&block(), &LiveView::areaPressed);
  for (int k = 11; k < 100 && (pressed.isEmpty() || pressed.back()[0] == 4); ++k)
    QTest::mouseClick(&block(), Qt::LeftButton, {},
                      {block().width() * (k % 10) / 10, block().height() * (k / 10) / 10});
  ASSERT_FALSE(pressed.isEmpty());
  const int area = pressed.back()[0].toInt();
  EXPECT_NE(area, 4);
  EXPECT_EQ(find<QSpinBox>("touchArea").value(), area);
  EXPECT_TRUE(reads(area, -3));
  find<QCheckBox>("touchHeld").click();
  EXPECT_TRUE(wait([&] { return page.host().history().last()->forces.area != area; }))
      << "it goes over the areas again";
}

TEST_F(LiveOperator, TakesDecimalsAsTheyAreTyped) {
  ASSERT_TRUE(waitForFrames());
  find<QCheckBox>("touchHeld").click();
  type<QDoubleSpinBox>("touch_Fz", "-3.75");
  EXPECT_EQ(workbench.project().live.simulation.heldForce_N[2], -3.75);
  type<QDoubleSpinBox>("alarmLimit", "-4.25");
  EXPECT_EQ(workbench.project().live.alarm.limit_N, -4.25);
  type<QDoubleSpinBox>("warming", "0.35");
  EXPECT_EQ(workbench.project().live.simulation.warming_degC, 0.35);
}

TEST_F(LiveOperator, AnAlarmOfTheSizeIsOneAboveAndAMarkIsSetByReturn) {
  ASSERT_TRUE(waitForFrames());
  find<QComboBox>("alarmForce").setCurrentIndex(static_cast<int>(ForceQuantity::Size)); // of -5 N below, which never is
  EXPECT_EQ(workbench.project().live.alarm, (ForceAlarm{ForceQuantity::Size, AlarmSide::Above, 5}));
  QTest::keyClicks(&find<QLineEdit>("markText"), "poke");
  QTest::keyClick(&find<QLineEdit>("markText"), Qt::Key_Return);
  EXPECT_TRUE(find<QLineEdit>("markText").text().isEmpty()) << "it is set";
  EXPECT_TRUE(said.join(' ').contains("Marked")) << said.join(' ').toStdString();
}

TEST_F(LiveOperator, SetsATouchByKeysAlone) {
  ASSERT_TRUE(waitForArrow());
  const auto hand = [&]() -> const SimulationSettings& { return workbench.project().live.simulation; };
  block().setFocus();
  QTest::keyClick(&block(), Qt::Key_Return);
  EXPECT_TRUE(hand().held);
  QTest::keyClick(&block(), Qt::Key_Right);
  EXPECT_EQ(hand().heldArea, 1);
  QTest::keyClick(&block(), Qt::Key_Right, Qt::ShiftModifier);
  QTest::keyClick(&block(), Qt::Key_Plus);
  QTest::keyClick(&block(), Qt::Key_Plus);
  QTest::keyClick(&block(), Qt::Key_Minus);
  EXPECT_NEAR(hand().heldForce_N[0], 0.1, 1e-12);
  EXPECT_NEAR(hand().heldForce_N[2], -2.1, 1e-12);
  EXPECT_TRUE(wait([&] {
    const LiveFrame* last = page.host().history().last();
    return last->forces.valid && last->forces.area == 1 && std::abs(last->forces.forces_N(2, 0) + 2.1) < 0.05;
  }));
  for (int k = 0; k < 20; ++k) QTest::keyClick(&block(), Qt::Key_Left);
  EXPECT_EQ(hand().heldArea, 0) << "there is no area beyond the edge";
  QTest::keyClick(&block(), Qt::Key_Return);
  EXPECT_FALSE(hand().held);
  QTest::keyClick(&block(), Qt::Key_Right);
  EXPECT_EQ(hand().heldArea, 0) << "nothing is pressed without the hand";
}

TEST_F(LiveOperator, SaysWhyAPressInThePictureDoesNothing) {
  ASSERT_TRUE(waitForArrow());
  QTest::mouseClick(&block(), Qt::LeftButton, {}, block().rect().center());
  EXPECT_TRUE(said.join(' ').contains("Touch by hand"));
  EXPECT_FALSE(workbench.project().live.simulation.held);
}

TEST_F(LiveOperator, ReadsZoomsAndMovesACurveByKeysAlone) {
  ASSERT_TRUE(waitForArrow());
  ASSERT_TRUE(waitForFrames(60)); // forces where the cursor will stand, 0.3 s back
  auto& chart = find<StripChart>("forceCurves");
  chart.setFocus();
  EXPECT_TRUE(chart.reading().isEmpty());
  for (int k = 0; k < 3; ++k) QTest::keyClick(&chart, Qt::Key_Left, Qt::ControlModifier);
  EXPECT_TRUE(chart.reading().contains("Fz ")) << chart.reading().toStdString();
  const QStringList lines = chart.reading().split('\n'); // time and three forces, one below the other
  ASSERT_GE(lines.size(), 4) << chart.reading().toStdString();
  EXPECT_TRUE(lines[0].startsWith("time ") && lines[0].endsWith(" s")) << lines[0].toStdString();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(lines[axis + 1].endsWith(" N")) << lines[axis + 1].toStdString();
    EXPECT_TRUE(lines[axis + 1].contains(QChar(0xb1))) << "its deviation: " << lines[axis + 1].toStdString();
  }
  EXPECT_FALSE(chart.held()) << "the cursor alone holds nothing";
  EXPECT_FALSE(chart.accessibleDescription().isEmpty());
  const double window_s = chart.chart().window_s;
  const double height = chart.chart().yRange[1] - chart.chart().yRange[0];
  QTest::keyClick(&chart, Qt::Key_Plus);
  EXPECT_LT(chart.chart().window_s, window_s);
  QTest::keyClick(&chart, Qt::Key_PageUp);
  EXPECT_LT(chart.chart().yRange[1] - chart.chart().yRange[0], height);
  const double end_s = chart.chart().end_s;
  QTest::keyClick(&chart, Qt::Key_Left);
  EXPECT_LT(chart.chart().end_s, end_s);
  QTest::keyClick(&chart, Qt::Key_Escape);
  EXPECT_FALSE(chart.held());
}

TEST_F(LiveOperator, AnAlarmGoesOffOutOfSightAndIsToldUntilTheSceneIsSeen) {
  ASSERT_TRUE(waitForFrames());
  type<QDoubleSpinBox>("alarmLimit", "-1");
  find<QCheckBox>("alarmOn").click();
  ASSERT_TRUE(wait([&] { return page.host().status().alarms > 0; }));
  page.hide();
  const std::uint64_t before = page.host().status().alarms;
  said.clear();
  ASSERT_TRUE(wait([&] { return page.host().status().alarms > before + 1; })) << "nobody watches";
  EXPECT_TRUE(said.join(' ').contains("is below -1 N"));
  EXPECT_EQ(page.lamp().kind, LiveLampState::Kind::Alarm);
  page.show();
  EXPECT_TRUE(wait([&] { return page.lamp().kind == LiveLampState::Kind::Streams; })) << "the alarm was seen";
  find<QCheckBox>("alarmOn").click();
  page.hide();
  QSignalSpy looked(&page, &LivePage::looked);
  EXPECT_TRUE(wait([&] {
    looked.clear();
    QTest::qWait(700); // more than twice as long as there is between two looks
    return looked.isEmpty();
  })) << "it still looks";
  EXPECT_EQ(page.lamp().kind, LiveLampState::Kind::Waits) << "that nothing is read is seen in other scenes";
  EXPECT_TRUE(page.lamp().words.startsWith("Live is waiting"));
}

} // namespace
} // namespace palp
