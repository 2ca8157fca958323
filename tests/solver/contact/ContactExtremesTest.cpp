#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"
#include "solver/contact/ContactPoints.h"
#include "solver/contact/ContactSteps.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace palp {
namespace {

struct ExtremeTouch {
  std::string name;
  Indenter indenter;
};
void PrintTo(const ExtremeTouch& extreme, std::ostream* out) {
  *out << extreme.name;
}

class ExtremeContact : public testing::TestWithParam<ExtremeTouch> {};

/// Where a touch is not reached, the last state that was is an equilibrium, and a sentence says why.
TEST_P(ExtremeContact, ConvergesOrEndsWithTheLastEquilibriumAndAReason) {
  MeshOptions options;
  options.mapped = {{20, 20, 4}};
  const SensorDesign design = paperDesign();
  LoadCase load;
  load.indenters = {GetParam().indenter};
  const Solution solution = HyperelasticProblem(design, sensorMesh(design, options)).solve(load);
  const IndenterState& state = solution.state().indenters[0];
  if (!solution.converged) {
    EXPECT_FALSE(solution.stopReason.empty());
    EXPECT_LT(solution.reachedLoadFraction, 1);
    EXPECT_EQ(solution.reachedLoadFraction, solution.state().loadFraction);
  } else if (const Motion* motion = GetParam().indenter.motion()) {
    EXPECT_NEAR(state.translation_mm.z(), -motion->depth_mm, 1e-12);
    EXPECT_LT((state.translation_mm.head<2>() - motion->shift_mm).norm(), 1e-12);
  }
  ASSERT_GT(solution.reachedLoadFraction, 0) << solution.stopReason;
  EXPECT_LT((solution.reaction_N + state.force_N).norm(), 1e-7 * state.force_N.norm());
  EXPECT_LT(state.force_N.z(), 0);
}

/// Its place is in the middle of four corners, 0.1 mm above each of them when its tip is on the face.
TEST(ContactOfFewNodes, ASphereBetweenNodesGoesDownUntilItMeetsThem) {
  MeshOptions options;
  options.mapped = {{15, 15, 4}};
  const SensorDesign design = paperDesign();
  LoadCase load;
  load.indenters = {{IndenterShape::Sphere, 8, 0, {5, 7}, 1, Press{{0, 0, -0.5}}}};
  const Solution solution = HyperelasticProblem(design, sensorMesh(design, options)).solve(load);
  ASSERT_TRUE(solution.converged) << solution.stopReason;
  EXPECT_LT((solution.state().indenters[0].force_N - Eigen::Vector3d(0, 0, -0.5)).norm(), 1e-8);
  EXPECT_GE(solution.state().indenters[0].touchingNodes, 1);
}

/// Corners 2 mm apart: two of them touch at first, and their slope pushes the sphere aside.
TEST(ContactOfFewNodes, FrictionHoldsASphereOnTwoNodes) {
  MeshOptions options;
  options.mapped = {{15, 15, 4}};
  const SensorDesign design = paperDesign();
  LoadCase load;
  load.indenters = {{IndenterShape::Sphere, 8, 0, {15, 7.5}, 0.5, Press{{0.2, 0, -3}}}};
  const Solution solution = HyperelasticProblem(design, sensorMesh(design, options)).solve(load);
  ASSERT_TRUE(solution.converged) << solution.stopReason;
  const IndenterState& state = solution.state().indenters[0];
  EXPECT_LT((state.force_N - Eigen::Vector3d(0.2, 0, -3)).norm(), 1e-7);
  EXPECT_LT(state.translation_mm.head<2>().norm(), 0.5) << "it does not slide off";
  for (const LoadIncrement& increment : solution.increments) {
    if (increment.loadFraction > 0) {
      EXPECT_LT(increment.indenters[0].translation_mm.head<2>().norm(), 0.5);
    }
  }
}

/// A block of the paper's rubber that a sharp punch fills to a quarter.
SensorDesign smallBlock() {
  SensorDesign design = paperDesign();
  design.block_mm = {12, 12, 5};
  design.areas = {1, 1};
  design.upper = {{4, 8}, {{4, 8}}, {{4}}};
  design.lower = {{3, 6}, {{6}}, {{1}}};
  return design;
}

Solution pressed(const SensorDesign& design, const Indenter& indenter, int cells) {
  MeshOptions options;
  options.mapped = {{cells, cells, 3}};
  LoadCase load;
  load.indenters = {indenter};
  return HyperelasticProblem(design, sensorMesh(design, options)).solve(load);
}

int stepsBegun(const Solution& solution) {
  return static_cast<int>(std::count_if(solution.newton.begin(), solution.newton.end(),
                                        [](const NewtonStep& step) { return step.iteration == 0; }));
}

/// The pressure at its rim has no limit: the finer the mesh, the less of the load is reached.
TEST(ContactWithoutAnEnd, ASharpPunchEndsAfterSomeStepsWithTheShareReachedAndTheRim) {
  for (const double rim_mm : {0., 0.01}) {
    const Solution solution =
        pressed(smallBlock(), {IndenterShape::Flat, 3, rim_mm, {6, 6}, 0, Motion{2.5, {0, 0}}}, 12);
    ASSERT_FALSE(solution.converged) << rim_mm;
    EXPECT_LT(solution.reachedLoadFraction, 1);
    EXPECT_LT(stepsBegun(solution), 40) << "not down to a thousandth of the load";
    EXPECT_NE(solution.stopReason.find("between load fractions"), std::string::npos) << solution.stopReason;
    EXPECT_NE(solution.stopReason.find("the rim radius of "), std::string::npos) << solution.stopReason;
  }
}

/// Both refused before: "meets no node of the mesh".
TEST(ContactWithoutAnEnd, ABallDeeperThanItsDiameterEndsWithItsRadius) {
  for (const Indenter& ball : {Indenter{IndenterShape::Sphere, 1, 0, {6, 6}, 0, Motion{1.9, {0, 0}}},
                               Indenter{IndenterShape::Sphere, 0.8, 0, {6, 6}, 0, Press{{0, 0, -20}}}}) {
    const Solution solution = pressed(smallBlock(), ball, 24);
    EXPECT_LT(stepsBegun(solution), 40);
    if (solution.converged) continue;
    EXPECT_NE(solution.stopReason.find("deeper than its radius"), std::string::npos) << solution.stopReason;
  }
}

TEST(TouchablePoints, OfABallBelowTheFaceAreThoseItPassedOnItsWay) {
  const SensorDesign design = smallBlock();
  MeshOptions options;
  options.mapped = {{24, 24, 1}};
  const Mesh mesh = sensorMesh(design, options);
  const auto touchable = [&](double depth_mm, double margin) {
    LoadCase load;
    load.indenters = {{IndenterShape::Sphere, 1.1, 0, {6, 6}, 0, Motion{depth_mm, {0, 0}}}};
    return touchablePoints(mesh, design, {load}, margin).size();
  };
  EXPECT_EQ(touchable(1.1, 1), 13U) << "as wide as the ball";
  EXPECT_EQ(touchable(2.1, touchableMargin), 13U);
  EXPECT_EQ(touchable(0.8, touchableMargin * marginGrowth), 13U);
}

const Motion kAMillimetreDeep{1, {0, 0}}, kSlidByAMillimetre{0.6, {1, 0}};

INSTANTIATE_TEST_SUITE_P(
    Touches, ExtremeContact,
    testing::Values(
        ExtremeTouch{"a third of the radius deep", {IndenterShape::Sphere, 3, 0, {15, 15}, 0, kAMillimetreDeep}},
        ExtremeTouch{"punch over the edge", {IndenterShape::Flat, 3, 0.3, {29, 15}, 0, Press{{0, 0, -3}}}},
        ExtremeTouch{"across the block", {IndenterShape::CylinderX, 3, 0, {15, 15}, 0, Motion{0.5, {0, 0}}}},
        ExtremeTouch{"pulled aside", {IndenterShape::Sphere, 5, 0, {15, 15}, 0.6, Press{{2, 0, -4}}}},
        ExtremeTouch{"slid", {IndenterShape::Sphere, 5, 0, {15, 15}, 0.6, kSlidByAMillimetre}}),
    [](const auto& row) { return "Row" + std::to_string(row.index); });

} // namespace
} // namespace palp
