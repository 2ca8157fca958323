#include "model/Indenter.h"

#include "model/LoadCase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace palp {

namespace {

Indenter indenterOf(IndenterShape shape, double radius = 3, double rim = 0.5) {
  Indenter indenter;
  indenter.shape = shape;
  indenter.radius_mm = radius;
  indenter.rim_mm = rim;
  indenter.place_mm = {15, 15};
  return indenter;
}

constexpr IndenterShape allShapes[] = {IndenterShape::Sphere,    IndenterShape::Pin,       IndenterShape::Flat,
                                       IndenterShape::CylinderX, IndenterShape::CylinderY, IndenterShape::Plane};

std::string refusal(const Indenter& indenter) {
  return whyInvalid(indenter, paperDesign()).value_or("");
}

} // namespace

TEST(Indenter, NormalIsTheGradientOfTheDistanceAndCurvatureThatOfTheNormal) {
  constexpr double step = 1e-5;
  for (const IndenterShape shape : allShapes)
    for (const Eigen::Vector3d& x : {Eigen::Vector3d(0.4, -0.3, 0.1), Eigen::Vector3d(1.5, 2.2, 0.3),
                                     Eigen::Vector3d(-2.4, 1.9, 4.5), Eigen::Vector3d(0.1, 0.2, -0.7)}) {
      const Indenter indenter = indenterOf(shape);
      const IndenterDistance here = distance(indenter, x);
      EXPECT_NEAR(here.normal.norm(), 1, 1e-14);
      for (int d = 0; d < 3; ++d) {
        const IndenterDistance up = distance(indenter, x + step * Eigen::Vector3d::Unit(d));
        const IndenterDistance down = distance(indenter, x - step * Eigen::Vector3d::Unit(d));
        EXPECT_NEAR((up.gap_mm - down.gap_mm) / (2 * step), here.normal(d), 1e-9) << shapeName(shape);
        EXPECT_LT(((up.normal - down.normal) / (2 * step) - here.curvature_per_mm.col(d)).norm(), 1e-8)
            << shapeName(shape);
      }
    }
}

TEST(Indenter, TouchesTheFaceBelowItsTip) {
  for (const IndenterShape shape : allShapes) {
    const IndenterDistance tip = distance(indenterOf(shape), Eigen::Vector3d::Zero());
    EXPECT_NEAR(tip.gap_mm, 0, 1e-15) << shapeName(shape);
    EXPECT_EQ(tip.normal, Eigen::Vector3d(-Eigen::Vector3d::UnitZ())) << shapeName(shape);
  }
}

TEST(Indenter, ASphereEndsAboveItsCentreAndAPinGoesOn) {
  const Eigen::Vector3d beside(3, 0, 8);
  EXPECT_NEAR(distance(indenterOf(IndenterShape::Pin), beside).gap_mm, 0, 1e-15);
  EXPECT_NEAR(distance(indenterOf(IndenterShape::Sphere), beside).gap_mm, std::sqrt(34.) - 3, 1e-14);
}

TEST(Indenter, HasANameForEachShape) {
  for (const IndenterShape shape : allShapes) EXPECT_EQ(indenterShape(shapeName(shape)), shape);
  EXPECT_FALSE(indenterShape("cone"));
}

TEST(Indenter, PressesFirstAndGoesAsideThenWithFrictionAlone) {
  Indenter indenter = indenterOf(IndenterShape::Sphere);
  indenter.friction = 0.5;
  indenter.control = Press{{0.4, -0.2, -3}};
  const auto force_N = [&](double fraction) { return indenter.at(fraction).press()->force_N; };
  EXPECT_EQ(force_N(pressShare / 4), Eigen::Vector3d(0, 0, -0.75));
  EXPECT_EQ(force_N(4 / 6.), Eigen::Vector3d(0, 0, -3)) << "to the last digit, at the fourth of six steps";
  EXPECT_LT((force_N((1 + pressShare) / 2) - Eigen::Vector3d(0.2, -0.1, -3)).norm(), 1e-15);
  EXPECT_LT((force_N(1) - Eigen::Vector3d(0.4, -0.2, -3)).norm(), 1e-15);
  indenter.control = Motion{1, {0, 0}};
  EXPECT_EQ(indenter.at(0.25).motion()->depth_mm, 0.25) << "straight down it grows in proportion";
}

TEST(Indenter, RefusesWhatCannotPressInASentence) {
  const auto pressed = [](const Eigen::Vector3d& force, double friction) {
    Indenter indenter = indenterOf(IndenterShape::Sphere);
    indenter.control = Press{force};
    indenter.friction = friction;
    return refusal(indenter);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pressed({0, 0, -6}, 0), "");
  EXPECT_EQ(pressed({2, 0, -6}, 0.5), "");
  EXPECT_EQ(pressed({0, 0, 1}, 0),
            "sphere at (15, 15) mm: force: got (0, 0, 1) N, expected FZ below 0, because an indenter presses");
  EXPECT_NE(pressed({1, 0, -6}, 0).find("no tangential force without friction"), std::string::npos);
  EXPECT_NE(pressed({4, 0, -6}, 0.5).find("x 6 N = 3 N"), std::string::npos);
  EXPECT_NE(pressed({0, 0, -6}, -0.1).find("friction: got -0.1, expected 0 to 2"), std::string::npos);
  EXPECT_NE(pressed({0, 0, -6}, 2.5).find("friction: got 2.5"), std::string::npos);
  EXPECT_NE(pressed({0, 0, -6}, nan).find("friction: got nan"), std::string::npos);
  EXPECT_NE(pressed({nan, 0, -6}, 0.5).find("finite"), std::string::npos);
  EXPECT_NE(pressed({0, 0, -2e6}, 0).find("1e6"), std::string::npos);
}

TEST(Indenter, RefusesPlacesOffTheBodyAndSizesThatAreNone) {
  Indenter indenter = indenterOf(IndenterShape::Flat);
  EXPECT_EQ(refusal(indenter), "");
  indenter.rim_mm = 3.5;
  EXPECT_NE(refusal(indenter).find("rim radius: got 3.5 mm, expected 0 to the punch's radius, 3 mm"),
            std::string::npos);
  indenter = indenterOf(IndenterShape::Sphere, 0);
  EXPECT_NE(refusal(indenter).find("radius: got 0 mm"), std::string::npos);
  indenter = indenterOf(IndenterShape::Sphere);
  indenter.place_mm.x() = 31;
  EXPECT_NE(refusal(indenter).find("a position on the top face"), std::string::npos);
  indenter = indenterOf(IndenterShape::CylinderX);
  indenter.place_mm.x() = 99; // along its axis it goes across the whole block
  EXPECT_EQ(refusal(indenter), "");
}

TEST(Indenter, RefusesMotionsThroughTheBlockOrOffIt) {
  Indenter indenter = indenterOf(IndenterShape::Sphere);
  for (const double depth : {0., -1., 4.6, std::numeric_limits<double>::quiet_NaN()}) {
    indenter.control = Motion{depth, {0, 0}};
    EXPECT_NE(refusal(indenter).find("depth"), std::string::npos) << depth;
  }
  indenter.control = Motion{1, {16, 0}};
  EXPECT_NE(refusal(indenter).find("shift: got (16, 0) mm"), std::string::npos);
  indenter.control = Motion{1, {2, -2}};
  EXPECT_EQ(refusal(indenter), "");
  EXPECT_EQ(whyInvalid(LoadCase{{}, {}, {indenter}}, paperDesign()), std::nullopt);
  indenter.radius_mm = 0.5;
  indenter.control = Motion{1, {0, 0}};
  EXPECT_NE(refusal(indenter).find("of the sphere, 1 mm; a pin"), std::string::npos) << refusal(indenter);
  indenter.shape = IndenterShape::Pin;
  EXPECT_EQ(refusal(indenter), "");
  indenter.friction = 3;
  EXPECT_TRUE(whyInvalid(LoadCase{{}, {}, {indenter}}, paperDesign()));
}

} // namespace palp
