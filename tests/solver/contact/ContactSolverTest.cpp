#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"
#include "solver/contact/ContactPoints.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

Indenter sphere(double radius_mm, double x_mm, double y_mm, const Press& press, double friction = 0) {
  return {IndenterShape::Sphere, radius_mm, 0, {x_mm, y_mm}, friction, press};
}

LoadCase under(const Indenter& indenter) {
  LoadCase load;
  load.indenters = {indenter};
  return load;
}

/// On the mesh that the load asks for, `coarser` times the default size.
HyperelasticProblem problemFor(const SensorDesign& design, const LoadCase& load, double coarser = 1) {
  MeshOptions options;
  options.meshSize_mm = coarser * standardMeshSize_mm(design);
  return {design, sensorMesh(design, meshFor(design, load, options))};
}

/// The same mesh for all touches, and solved in a moment.
HyperelasticProblem hexahedra(const SensorDesign& design) {
  MeshOptions options;
  options.mapped = {{15, 15, 4}};
  return {design, sensorMesh(design, options)};
}

Solution solved(const HyperelasticProblem& problem, const LoadCase& load, int threads = 0) {
  NewtonOptions options;
  options.threads = threads;
  return problem.solve(load, options);
}

/// The sum of the surface tractions times the nodes' areas, and the largest of what `measure` gives for a node's force.
template <class Measure>
double largestOfNodes(const HyperelasticProblem& problem, const Solution& solution, Measure measure) {
  double largest = -1e300;
  for (const ContactPoint& point : contactPoints(problem.mesh())) {
    const Eigen::Vector3d traction = solution.state().contactTraction_MPa.col(point.node);
    if (!traction.isZero(0)) largest = std::max(largest, measure(point.node, traction));
  }
  return largest;
}

struct LayerCase {
  std::string name;
  Indenter indenter;
  double depth_mm, force_N, tolerance;
};
void PrintTo(const LayerCase& layer, std::ostream* out) {
  *out << layer.name;
}

class BondedLayer : public testing::TestWithParam<LayerCase> {};

/// Hayes, Keer, Herrmann, Mockros 1972, solved anew; an infinite layer of the paper's rubber at small strain.
TEST_P(BondedLayer, AnswersARigidIndenterAsTheClosedFormSays) {
  const SensorDesign design = paperDesign();
  Indenter indenter = GetParam().indenter;
  indenter.control = Motion{GetParam().depth_mm, Eigen::Vector2d::Zero()};
  const LoadCase load = under(indenter);
  const Solution solution = solved(problemFor(design, load), load);
  ASSERT_TRUE(solution.converged) << solution.stopReason;
  EXPECT_NEAR(-solution.state().indenters[0].force_N.z(), GetParam().force_N,
              GetParam().tolerance * GetParam().force_N);
}

const Indenter kBall{IndenterShape::Sphere, 50, 0, {15, 15}, 0, {}};
INSTANTIATE_TEST_SUITE_P(Tables, BondedLayer,
                         testing::Values(LayerCase{"a over h 0.2", kBall, 0.017132, 0.087991, 0.005},
                                         LayerCase{"a over h 0.4", kBall, 0.059334, 0.730064, 0.005},
                                         LayerCase{"a over h 0.6", kBall, 0.118666, 2.656570, 0.005}),
                         [](const auto& row) { return "Row" + std::to_string(row.index); });

TEST(ContactSolver, TheForceIsTheReactionAndNothingPulls) {
  const SensorDesign design = paperDesign();
  const LoadCase load = under(sphere(5, 15, 7.5, {{0, 0, -6}}));
  const HyperelasticProblem problem = problemFor(design, load, 1.5);
  const Solution solution = solved(problem, load);
  ASSERT_TRUE(solution.converged) << solution.stopReason;
  const IndenterState& state = solution.state().indenters[0];
  EXPECT_NEAR(state.force_N.z(), -6, 6e-8);
  EXPECT_LT((solution.reaction_N + state.force_N).norm(), 1e-7 * 6);
  EXPECT_EQ(state.slipShare, 1) << "nothing holds it";
  const Eigen::Vector3d tip = tipAtRest_mm(load.indenters[0], problem.mesh()) + state.translation_mm;
  const auto place = [&](int node) {
    return Eigen::Vector3d(problem.mesh().nodes_mm.col(node) + solution.state().displacements_mm.col(node) - tip);
  };
  EXPECT_LT(largestOfNodes(problem, solution,
                           [&](int node, const Eigen::Vector3d& traction) {
                             return -traction.dot(distance(load.indenters[0], place(node)).normal);
                           }),
            0)
      << "no tension";
  double deepest = 0;
  for (const ContactPoint& point : contactPoints(problem.mesh()))
    deepest = std::max(deepest, -distance(load.indenters[0], place(point.node)).gap_mm);
  EXPECT_LT(deepest, 1e-6);
}

TEST(ContactSolver, MirroredTouchesMirror) {
  const SensorDesign design = paperDesign();
  const HyperelasticProblem problem = hexahedra(design);
  Eigen::Matrix<double, 3, 2> forces, moves;
  for (int side : {0, 1}) {
    const LoadCase load = under(sphere(12, side ? 19 : 11, 13, {{side ? -0.4 : 0.4, 0, -2}}, 0.5));
    const Solution solution = solved(problem, load);
    ASSERT_TRUE(solution.converged) << solution.stopReason;
    forces.col(side) = solution.state().indenters[0].force_N;
    moves.col(side) = solution.state().indenters[0].translation_mm;
  }
  const Eigen::Vector3d mirror(-1, 1, 1);
  EXPECT_LT((forces.col(0) - mirror.cwiseProduct(forces.col(1))).norm(), 1e-7);
  EXPECT_LT((moves.col(0) - mirror.cwiseProduct(moves.col(1))).norm(), 1e-7 * moves.col(0).norm());
}

TEST(ContactSolver, GivesTheSameBytesAtAnyNumberOfThreads) {
  const SensorDesign design = paperDesign();
  const LoadCase load = under(sphere(8, 10, 15, {{0.3, 0, -3}}, 0.6));
  const HyperelasticProblem problem = hexahedra(design);
  const Solution one = solved(problem, load, 1), three = solved(problem, load, 3);
  ASSERT_TRUE(one.converged) << one.stopReason;
  EXPECT_TRUE(one.state().displacements_mm == three.state().displacements_mm);
}

TEST(ContactSolver, FrictionStaysInsideItsConeAndHoldsTheForceAside) {
  const SensorDesign design = paperDesign();
  const LoadCase load = under(sphere(12, 15, 15, {{0.5, 0, -2}}, 0.4));
  const HyperelasticProblem problem = hexahedra(design);
  const Solution solution = solved(problem, load);
  ASSERT_TRUE(solution.converged) << solution.stopReason;
  const IndenterState& state = solution.state().indenters[0];
  EXPECT_LT((state.force_N - Eigen::Vector3d(0.5, 0, -2)).norm(), 1e-7);
  EXPECT_GT(state.translation_mm.x(), 0) << "it gives way";
  EXPECT_GT(state.slipShare, 0) << "its rim slides";
  EXPECT_LT(state.slipShare, 1) << "its middle sticks";
  const Eigen::Vector3d tip = tipAtRest_mm(load.indenters[0], problem.mesh()) + state.translation_mm;
  EXPECT_LE(largestOfNodes(problem, solution,
                           [&](int node, const Eigen::Vector3d& traction) {
                             const Eigen::Vector3d n =
                                 distance(load.indenters[0], problem.mesh().nodes_mm.col(node) +
                                                                 solution.state().displacements_mm.col(node) - tip)
                                     .normal;
                             const double p = traction.dot(n);
                             return (traction - p * n).norm() / (0.4 * p);
                           }),
            1 + 1e-6);
}

TEST(ContactSolver, APlaneOverAllOfTheTopFindsTheBondedBlocksStiffness) {
  const SensorDesign design = paperDesign();
  LoadCase load = under({IndenterShape::Plane, 0, 0, {15, 15}, 0, Motion{0.01, Eigen::Vector2d::Zero()}});
  const HyperelasticProblem problem = hexahedra(design);
  const Solution solution = solved(problem, load);
  ASSERT_TRUE(solution.converged) << solution.stopReason;
  EXPECT_NEAR(solution.state().indenters[0].contactArea_mm2, 900, 1e-6) << "all of it touches";
  EXPECT_LT((solution.reaction_N + solution.state().indenters[0].force_N).norm(),
            1e-7 * solution.state().indenters[0].force_N.norm());
}

TEST(ContactSolver, EveryShapePressesWithWhatTheClampedFaceHolds) {
  const SensorDesign design = paperDesign();
  const HyperelasticProblem problem = hexahedra(design);
  for (const Indenter& indenter : {Indenter{IndenterShape::Sphere, 6, 0, {10, 20}, 0.5, Press{{0.2, 0.1, -2}}},
                                   Indenter{IndenterShape::Pin, 4, 0, {28, 16}, 0, Press{{0, 0, -0.5}}},
                                   Indenter{IndenterShape::Flat, 4, 0.5, {20, 20}, 0.3, Motion{0.1, {0.05, 0}}},
                                   Indenter{IndenterShape::CylinderX, 6, 0, {15, 15}, 0, Press{{0, 0, -10}}},
                                   Indenter{IndenterShape::CylinderY, 6, 0, {15, 15}, 0, Motion{0.3, {0, 0}}},
                                   Indenter{IndenterShape::Plane, 0, 0, {15, 15}, 0, Press{{0, 0, -20}}}}) {
    SCOPED_TRACE(shapeName(indenter.shape));
    const Solution solution = solved(problem, under(indenter));
    ASSERT_TRUE(solution.converged) << solution.stopReason;
    const Eigen::Vector3d force_N = solution.state().indenters[0].force_N;
    if (const Press* press = indenter.press()) {
      EXPECT_NEAR(force_N.z(), press->force_N.z(), 1e-8 * force_N.norm());
    }
    EXPECT_LT((solution.reaction_N + force_N).norm(), 1e-7 * force_N.norm());
    for (const ContactPoint& point : contactPoints(problem.mesh()))
      EXPECT_LE(solution.state().contactTraction_MPa(2, point.node), 1e-9) << "nothing pulls the top up";
  }
}

TEST(ContactSolver, StopsAtOnce) {
  const SensorDesign design = paperDesign();
  const LoadCase load = under(sphere(5, 15, 15, {{0, 0, -1}}));
  const HyperelasticProblem problem = problemFor(design, load, 2);
  std::stop_source stop;
  int steps = 0;
  const Solution solution = problem.solve(load, {},
                                          {.step =
                                               [&](const NewtonStep&) {
                                                 if (++steps == 2) stop.request_stop();
                                               },
                                           .stop = stop.get_token()});
  EXPECT_TRUE(solution.cancelled);
  EXPECT_FALSE(solution.converged);
  EXPECT_EQ(steps, 2);
}

} // namespace
} // namespace palp
