#include "model/DesignError.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

constexpr double kFriction = 0.5, kPress_N = 2;

LoadCase pressedAside(double aside_N, double friction = kFriction) {
  LoadCase load;
  load.indenters = {{IndenterShape::Sphere, 100, 0, {15, 15}, friction, Press{{aside_N, 0, -kPress_N}}}};
  return load;
}

LoadCase movedAside(double aside_mm, double depth_mm = 0.4) {
  LoadCase load;
  load.indenters = {{IndenterShape::Sphere, 12, 0, {15, 15}, kFriction, Motion{depth_mm, {aside_mm, 0}}}};
  return load;
}

const HyperelasticProblem& block() {
  static const HyperelasticProblem problem = [] {
    MeshOptions options;
    options.mapped = {{15, 15, 4}};
    return HyperelasticProblem(paperDesign(), sensorMesh(paperDesign(), options));
  }();
  return problem;
}

const IndenterState& end(const Solution& solution) {
  return solution.state().indenters[0];
}

TEST(ContactPath, OfOneStepIsTheLoadItself) {
  const auto path = block().solvePath({pressedAside(0.4)});
  const Solution alone = block().solve(pressedAside(0.4));
  ASSERT_EQ(path.size(), 1U);
  ASSERT_TRUE(alone.converged) << alone.stopReason;
  EXPECT_TRUE(path[0].state().displacements_mm == alone.state().displacements_mm);
}

TEST(ContactPath, EachStepGoesOnFromWhereTheOneBeforeEnded) {
  const auto path = block().solvePath({movedAside(0), movedAside(0.1), movedAside(0.2)});
  ASSERT_EQ(path.size(), 3U);
  for (std::size_t step = 0; step < path.size(); ++step) {
    ASSERT_TRUE(path[step].converged) << path[step].stopReason;
    EXPECT_NEAR(end(path[step]).translation_mm.x(), 0.1 * double(step), 1e-12);
    EXPECT_LT((path[step].reaction_N + end(path[step]).force_N).norm(), 1e-7 * end(path[step]).force_N.norm());
    if (step > 0) {
      EXPECT_TRUE(path[step].increments.front().displacements_mm == path[step - 1].state().displacements_mm);
    }
  }
  EXPECT_GT(end(path[2]).force_N.x(), end(path[1]).force_N.x());
  EXPECT_GT(end(path[1]).force_N.x(), 0);
}

TEST(ContactPath, ALoadFromRestNeedsFewStepsAside) {
  for (const double share : {0.4, 0.8}) {
    const double aside_N = share * kFriction * kPress_N;
    const Solution alone = block().solve(pressedAside(aside_N));
    const auto path = block().solvePath({pressedAside(0), pressedAside(0.25 * aside_N), pressedAside(0.5 * aside_N),
                                         pressedAside(0.75 * aside_N), pressedAside(aside_N)}); // in four steps each
    ASSERT_EQ(path.size(), 5U);
    ASSERT_TRUE(alone.converged && path.back().converged) << alone.stopReason << path.back().stopReason;
    const Eigen::Matrix3Xd& often = path.back().state().displacements_mm;
    EXPECT_LT((alone.state().displacements_mm - often).norm(), 0.01 * often.norm()) << share;
    EXPECT_NEAR(end(alone).translation_mm.x(), end(path.back()).translation_mm.x(),
                0.01 * end(path.back()).translation_mm.x())
        << share;
  }
}

TEST(ContactPath, FrictionRemembersTheWayAndForcesWithoutItDoNot) {
  const double aside_N = 0.8 * kFriction * kPress_N;
  const auto path =
      block().solvePath({pressedAside(aside_N), pressedAside(0), pressedAside(-aside_N), pressedAside(0)});
  ASSERT_EQ(path.size(), 4U);
  for (const Solution& step : path) ASSERT_TRUE(step.converged) << step.stopReason;
  const double left = end(path[1]).translation_mm.x();
  EXPECT_GT(left, 0.01 * end(path[0]).translation_mm.x()) << "it does not come back by itself";
  EXPECT_NEAR(end(path[3]).translation_mm.x(), -left, 0.05 * left) << "a loop is as wide on both sides";

  LoadCase deep = pressedAside(0, 0), light = deep;
  light.indenters[0].control = Press{{0, 0, -0.5 * kPress_N}};
  const auto there = block().solvePath({light, deep, light});
  ASSERT_EQ(there.size(), 3U);
  ASSERT_TRUE(there[2].converged) << there[2].stopReason;
  const Eigen::Matrix3Xd &before = there[0].state().displacements_mm, &after = there[2].state().displacements_mm;
  EXPECT_LT((after - before).norm(), 1e-6 * before.norm());
}

TEST(ContactPath, ForcesOnAreasGoAlong) {
  LoadCase first = pressedAside(0, 0);
  LoadCase second = first;
  second.areas = {{0, {0, 0, -1}}};
  const auto path = block().solvePath({first, second});
  const Solution alone = block().solve(second);
  ASSERT_EQ(path.size(), 2U);
  ASSERT_TRUE(path[1].converged && alone.converged);
  const Eigen::Matrix3Xd& u = alone.state().displacements_mm;
  EXPECT_LT((path[1].state().displacements_mm - u).norm(), 1e-6 * u.norm()) << "without friction the way is nothing";
}

TEST(ContactPath, IsRefusedWhereTheIndenterChanges) {
  LoadCase larger = pressedAside(0);
  larger.indenters[0].radius_mm = 13;
  LoadCase none;
  EXPECT_THROW(static_cast<void>(block().solvePath({})), DesignError);
  EXPECT_THROW(static_cast<void>(block().solvePath({none})), DesignError);
  EXPECT_THROW(static_cast<void>(block().solvePath({pressedAside(0), larger})), DesignError);
  EXPECT_THROW(static_cast<void>(block().solvePath({pressedAside(0), movedAside(0)})), DesignError);
  EXPECT_THROW(static_cast<void>(block().solvePath({pressedAside(0), none})), DesignError);
}

} // namespace
} // namespace palp
