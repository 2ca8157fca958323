// What a decoded frame looks like: arrows and words.

#include "app/gui/live/LiveDrawings.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

LiveFrame pressed() {
  LiveFrame frame;
  frame.forces.valid = true;
  frame.forces.forces_N = Eigen::Vector3d(0, 0, -2);
  frame.forces.standardDeviation_N = Eigen::Vector3d::Constant(0.01);
  frame.forces.shown = {true};
  frame.forces.area = 4;
  frame.forces.areaConfidence = 1;
  return frame;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + '\n';
  return all;
}

TEST(LiveDrawings, AnArrowStandsWhereTheTouchWasDecoded) {
  LiveFrame frame = pressed();
  ASSERT_EQ(arrowsOf(frame.forces).size(), 1U);
  EXPECT_FALSE(arrowsOf(frame.forces)[0].place_mm) << "in the middle of its area";
  EXPECT_EQ(joined(forceLines(frame, {})).find("touch at"), std::string::npos);
  frame.forces.place_mm = Eigen::Vector2d(12.34, 5.678);
  frame.forces.placeDeviation_mm = Eigen::Vector2d(0.02, 0.3);
  const LiveArrow arrow = arrowsOf(frame.forces)[0];
  EXPECT_EQ(arrow.place_mm, frame.forces.place_mm);
  EXPECT_EQ(arrow.deviation_mm, frame.forces.placeDeviation_mm);
  EXPECT_NE(joined(forceLines(frame, {})).find("touch at (12.34, 5.68) mm, deviation (0.02, 0.3) mm"),
            std::string::npos)
      << joined(forceLines(frame, {}));
}

TEST(LiveDrawings, NothingStandsWhereNothingStandsOutOfTheNoise) {
  LiveFrame frame = pressed();
  frame.forces.shown = {false};
  EXPECT_TRUE(arrowsOf(frame.forces).empty());
  EXPECT_NE(joined(forceLines(frame, {})).find("no touch"), std::string::npos);
}

TEST(LiveDrawings, AtRestTheWordsHoldTheForceThatTheCurvesDraw) {
  LiveFrame frame = pressed();
  frame.forces.shown = {false};
  frame.forces.forces_N = Eigen::Vector3d(0, 0, 0.58);
  frame.forces.standardDeviation_N = Eigen::Vector3d(0.001, 0.001, 0.6);
  const std::string words = joined(forceLines(frame, {}));
  EXPECT_NE(words.find("no touch: (0.00, 0.00, 0.58) N is within its deviation, (0.001, 0.001, 0.6) N"),
            std::string::npos)
      << words;
}

TEST(LiveDrawings, AComponentThatTheNetworkDoesNotGiveIsNotMeasured) {
  LiveFrame frame = pressed();
  frame.forces.standardDeviation_N = Eigen::Vector3d(0, 0, 0.07);
  frame.forces.measured.resize(3, 1);
  frame.forces.measured << false, false, true;
  const std::string words = joined(forceLines(frame, {}));
  EXPECT_NE(words.find("standard deviation Fz 0.07 N\nFx, Fy not measured\n"), std::string::npos) << words;
  EXPECT_EQ(arrowsOf(frame.forces)[0].measured, (std::array{false, false, true}));
  LiveHistory history;
  history.add(std::make_shared<LiveFrame>(frame));
  const StripSpec curves = forceCurves(history, {}, nullptr);
  ASSERT_EQ(curves.series.size(), 1U) << "no curve of 0.00 N";
  EXPECT_EQ(curves.series[0].name, "Fz");
  EXPECT_TRUE(curves.title.contains("Fx, Fy not measured")) << curves.title.toStdString();
}

TEST(LiveDrawings, DoubtedForcesLookDoubtfulInTheCurves) {
  LiveHistory history;
  for (int k = 0; k < 6; ++k) {
    LiveFrame frame = pressed();
    frame.frame.time_s = frame.frame.hostTime_s = 0.02 * k;
    if (k == 2 || k == 3) frame.forces.doubt = "no known touch";
    history.add(std::make_shared<LiveFrame>(frame));
  }
  const StripSpec curves = forceCurves(history, {}, nullptr);
  ASSERT_EQ(curves.doubts.size(), 1U);
  EXPECT_NEAR(curves.doubts[0].from_s, 0.04, 1e-9);
  EXPECT_NEAR(curves.doubts[0].to_s, 0.08, 1e-9) << "to the first frame that is trusted again";
  EXPECT_EQ(curves.doubts[0].why, "no known touch");
}

TEST(LiveDrawings, WhatTheDeviationDoesNotHoldStandsBesideIt) {
  const std::string words = joined(forceLines(pressed(), {}, "the network is not calibrated"));
  EXPECT_NE(words.find("the network is not calibrated"), std::string::npos) << words;
}

} // namespace
} // namespace palp
