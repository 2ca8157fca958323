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
  EXPECT_NE(joined(forceLines(frame, {})).find("at rest"), std::string::npos);
}

} // namespace
} // namespace palp
