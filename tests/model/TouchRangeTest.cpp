#include "model/TouchRange.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace palp {
namespace {

TouchRange rubbed() {
  TouchRange range = touchesOf(paperDesign());
  range.leastFriction = 0.3;
  range.mostFriction = 0.8;
  return range;
}

TEST(TouchRange, DrawsTouchesThatCanPressInsideOfEveryRange) {
  const SensorDesign design = paperDesign();
  const TouchRange range = rubbed();
  ASSERT_EQ(whyInvalid(range, design), std::nullopt);
  EXPECT_EQ(inWords(range), "sphere:3..6@3,3,27,27 press 0.5..6 friction 0.3..0.8 cone 0.7");
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double aside = 0;
  constexpr int count = 4000;
  for (std::size_t i = 0; i < count; ++i) {
    const Indenter touch = touchAt(range, 5, i);
    EXPECT_EQ(whyInvalid(touch, design), std::nullopt);
    EXPECT_EQ(touch, touchAt(range, 5, i));
    EXPECT_NE(touch, touchAt(range, 6, i));
    EXPECT_TRUE(touch.radius_mm >= 3 && touch.radius_mm <= 6);
    EXPECT_TRUE((touch.place_mm.array() >= 3).all() && (touch.place_mm.array() <= 27).all());
    const Eigen::Vector3d force = touch.press()->force_N;
    EXPECT_TRUE(force.z() <= -0.5 && force.z() >= -6);
    const double share = force.head<2>().norm() / (touch.friction * -force.z());
    EXPECT_LE(share, 0.7 * (1 + 1e-12));
    mean += touch.place_mm / count;
    aside += share * share / count;
  }
  // Uniform: standard errors 24 / sqrt(12 * 4000) = 0.11 mm; of a disc of radius 0.7 the mean square is 0.245 (0.002).
  EXPECT_LT((mean - Eigen::Vector2d(15, 15)).cwiseAbs().maxCoeff(), 0.5);
  EXPECT_NEAR(aside, 0.245, 0.012);
}

TEST(TouchRange, FrictionlessTouchesPressStraightDown) {
  const TouchRange range = touchesOf(paperDesign());
  for (std::size_t i = 0; i < 50; ++i) {
    const Eigen::Vector3d force = touchAt(range, 1, i).press()->force_N;
    EXPECT_EQ(force.x(), 0);
    EXPECT_FALSE(std::signbit(force.x()));
    EXPECT_EQ(force.y(), 0);
  }
}

TEST(TouchRange, AGridIsGoneThroughInTurn) {
  TouchRange range = touchesOf(paperDesign());
  range.grid = {4, 2};
  EXPECT_EQ(touchAt(range, 1, 0).place_mm, Eigen::Vector2d(6, 9));
  EXPECT_EQ(touchAt(range, 1, 5).place_mm, Eigen::Vector2d(12, 21));
  EXPECT_EQ(touchAt(range, 9, 13).place_mm, Eigen::Vector2d(12, 21));
}

TEST(TouchRange, TwoAtOnceHaveRoomBesideEachOther) {
  const SensorDesign design = paperDesign();
  for (const IndenterShape shape : {IndenterShape::Sphere, IndenterShape::CylinderX, IndenterShape::CylinderY})
    for (const double width_mm : {24., 30.}) { // the first is just as wide as it must be
      TouchRange range = rubbed();
      range.shape = shape;
      range.atOnce = 2;
      range.low_mm.setConstant((30 - width_mm) / 2);
      range.high_mm.setConstant((30 + width_mm) / 2);
      if (shape == IndenterShape::Sphere) range.high_mm.y() = range.low_mm.y(); // along a line
      ASSERT_EQ(whyInvalid(range, design), std::nullopt);
      for (std::size_t i = 0; i < 500; ++i) {
        const std::vector<Indenter> touches = touchesAt(range, 5, i);
        ASSERT_EQ(touches.size(), 2u);
        EXPECT_EQ(touches[0], touchAt(range, 5, i));
        EXPECT_EQ(whyInvalid(touches[1], design), std::nullopt);
        const Eigen::Vector2d apart_mm = touches[1].place_mm - touches[0].place_mm;
        const double along_mm = shape == IndenterShape::CylinderX   ? std::abs(apart_mm.y())
                                : shape == IndenterShape::CylinderY ? std::abs(apart_mm.x())
                                                                    : apart_mm.norm();
        EXPECT_GE(along_mm, touches[0].radius_mm + touches[1].radius_mm) << shapeName(shape) << ' ' << i;
        EXPECT_EQ(touches, touchesAt(range, 5, i));
      }
    }
  EXPECT_EQ(touchesAt(rubbed(), 5, 3), std::vector{touchAt(rubbed(), 5, 3)});
}

// In the middle of the least region nothing is far enough away but the corners.
TEST(TouchRange, TheOtherOfTwoFallsBackOnTheFarCorner) {
  TouchRange range = touchesOf(paperDesign());
  range.atOnce = 2;
  range.smallest_mm = range.largest_mm = 6;
  range.low_mm = {3, 15};
  range.high_mm = {27, 15};
  int corners = 0;
  for (std::size_t i = 0; i < 3000; ++i) {
    const std::vector<Indenter> touches = touchesAt(range, 1, i);
    EXPECT_GE((touches[1].place_mm - touches[0].place_mm).norm(), 12);
    corners += touches[1].place_mm.x() == 3 || touches[1].place_mm.x() == 27 ? 1 : 0;
  }
  EXPECT_GT(corners, 0);
}

TEST(TouchRange, SaysWhyNothingCanBeDrawn) {
  const SensorDesign design = paperDesign();
  const auto why = [&](const auto& change) {
    TouchRange range = touchesOf(design);
    change(range);
    return whyInvalid(range, design).value_or("");
  };
  EXPECT_NE(why([](TouchRange& r) { r.smallest_mm = 7; }).find("sizes: got 7..6"), std::string::npos);
  EXPECT_NE(why([](TouchRange& r) { r.largest_mm = std::numeric_limits<double>::infinity(); }).find("sizes"),
            std::string::npos);
  EXPECT_NE(why([](TouchRange& r) { r.leastPress_N = 0; }).find("presses: got 0..6"), std::string::npos);
  EXPECT_NE(why([](TouchRange& r) { r.mostFriction = 2.1; }).find("friction: got 0..2.1"), std::string::npos);
  EXPECT_NE(why([](TouchRange& r) { r.cone = 1; }).find("cone: got 1"), std::string::npos);
  EXPECT_NE(why([](TouchRange& r) { r.low_mm.x() = 28; }).find("region: got 28,3,27,27"), std::string::npos);
  EXPECT_NE(why([](TouchRange& r) { r.high_mm.y() = 31; }).find("a position on the top face"), std::string::npos);
  EXPECT_NE(why([](TouchRange& r) { r.grid = {3, 0}; }).find("grid: got 3x0"), std::string::npos);
  EXPECT_NE(why([](TouchRange& r) { r.atOnce = 3; }).find("at once: got 3, expected 1 or 2"), std::string::npos);
  EXPECT_NE(why([](TouchRange& r) {
              r.atOnce = 2;
              r.high_mm = {10, 10};
            }).find("24 mm wide"),
            std::string::npos);
  EXPECT_NE(why([](TouchRange& r) {
              r.atOnce = 2;
              r.grid = {3, 3};
            }).find("grid"),
            std::string::npos);
  EXPECT_NE(why([](TouchRange& r) {
              r.shape = IndenterShape::Flat;
              r.rim_mm = 9;
            }).find("rim"),
            std::string::npos);
}

TEST(TouchRange, KnowsTheAreaUnderAPlace) {
  const SensorDesign design = paperDesign();
  for (int area = 0; area < design.areas.count(); ++area) {
    const Rectangle under = design.areaRectangle(area);
    EXPECT_EQ(areaUnder(design, (under.low_mm + under.high_mm) / 2), area);
  }
  EXPECT_EQ(areaUnder(design, {30, 30}), 5);
}

} // namespace
} // namespace palp
