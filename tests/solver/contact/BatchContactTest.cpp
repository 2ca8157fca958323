#include "solver/BatchSolver.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

HyperelasticProblem touchedHexahedra() {
  const SensorDesign design = paperDesign();
  MeshOptions options;
  options.mapped = {{15, 15, 4}};
  return {design, sensorMesh(design, options)};
}

/// Fine enough all over the top for what presses there.
HyperelasticProblem tetrahedra() {
  const SensorDesign design = paperDesign();
  MeshOptions options;
  options.zones = {{design.block_mm.head<2>() / 2, design.block_mm.head<2>() / 2, {2, 2}}};
  options.fineBorders = false;
  return {design, sensorMesh(design, options)};
}

LoadCase touch(double radius_mm, double x_mm, double y_mm, double press_N) {
  LoadCase load;
  load.indenters = {{IndenterShape::Sphere, radius_mm, 0, {x_mm, y_mm}, 0, Press{{0, 0, -press_N}}}};
  return load;
}

double difference(const ElectrodeDisplacements& a, const ElectrodeDisplacements& b) {
  return (a.upper_mm - b.upper_mm).norm() / b.upper_mm.norm();
}

TEST(BatchContact, FindsWhatFullNewtonFinds) {
  const HyperelasticProblem problem = tetrahedra();
  const std::vector<LoadCase> loads{touch(5, 15, 7.5, 6), touch(3, 4, 22, 1)};
  BatchOptions options;
  options.relativeTolerance = 1e-6;
  BatchSolver batch(problem, options);
  const std::vector<ElectrodeDisplacements> answers = batch.solve(loads);
  ASSERT_EQ(answers.size(), loads.size());
  EXPECT_LT(batch.measuredError().value(), 1e-5) << "the share that it measures itself";
  for (std::size_t i = 1; i < loads.size(); ++i) {
    const Solution full = problem.solve(loads[i]);
    ASSERT_TRUE(full.converged) << full.stopReason;
    EXPECT_LT(difference(answers[i], problem.electrodes(full.state())), 1e-5) << i;
  }
}

/// Pressed first and then sideways, near the limit of friction and far from it, off the middle and at the edge.
TEST(BatchContact, FrictionGoesTheWayOfFullNewton) {
  const HyperelasticProblem problem = touchedHexahedra();
  std::vector<LoadCase> loads{touch(5, 15, 12, 3), touch(6, 6, 22, 2), touch(5, 15, 12, 1)};
  loads[0].indenters[0].friction = 0.3;
  loads[0].indenters[0].control = Press{{0.8, 0.2, -3}};
  loads[1].indenters[0].friction = 0.8;
  loads[1].indenters[0].control = Press{{-0.3, 0.1, -2}};
  loads[2].indenters[0].friction = 0.5;
  BatchOptions options;
  options.checkFirst = false;
  BatchSolver batch(problem, options);
  const auto answers = batch.solve(loads);
  ASSERT_EQ(answers.size(), loads.size());
  EXPECT_EQ(batch.leftToNewton(), 0U);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Solution full = problem.solve(loads[i]);
    ASSERT_TRUE(full.converged) << full.stopReason;
    EXPECT_LT(difference(answers[i], problem.electrodes(full.state())), 1e-5) << i;
    LoadCase smooth = loads[i];
    smooth.indenters[0].friction = 0;
    smooth.indenters[0].control = Press{{0, 0, loads[i].indenters[0].press()->force_N.z()}};
    EXPECT_GT(difference(answers[i], batch.solve({&smooth, 1})[0]), 1e-3) << "friction matters, load " << i;
  }
}

TEST(BatchContact, FrictionBesideALoadedAreaIsLeftToNewton) {
  const HyperelasticProblem problem = touchedHexahedra();
  LoadCase load = touch(6, 20, 20, 1);
  load.indenters[0].friction = 0.5;
  load.areas = {{0, {0, 0, -0.5}}};
  BatchOptions options;
  options.checkFirst = false;
  BatchSolver batch(problem, options);
  ASSERT_EQ(batch.solve({&load, 1}).size(), 1U);
  EXPECT_EQ(batch.leftToNewton(), 1U);
}

TEST(BatchContact, ATouchThatReachesBeyondThePartThatIsSaidIsSolvedAllTheSame) {
  const HyperelasticProblem problem = touchedHexahedra();
  const std::vector<LoadCase> loads{touch(5, 8, 15, 2), touch(5, 13.5, 15, 2)}; // the second across the border
  BatchOptions part;
  part.touched = Rectangle{{3, 10}, {14, 20}};
  part.checkFirst = false;
  BatchSolver some(problem, part), whole(problem);
  const auto answers = some.solve(loads), expected = whole.solve(loads);
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_LT(difference(answers[0], expected[0]), 1e-7);
  EXPECT_LT(difference(answers[1], expected[1]), 1e-5) << "by full Newton";
  EXPECT_EQ(some.solves(), 3U) << "the second twice, nothing checked";
}

/// The elements stand in another order there, and the predictor of an area is of the mesh's.
TEST(BatchContact, ALoadedAreaHasTheSameAnswerWhereTouchesAreForeseen) {
  const HyperelasticProblem problem = touchedHexahedra();
  LoadCase load;
  load.areas = {{1, {0.2, 0, -3}}};
  BatchOptions part;
  part.touched = Rectangle{{3, 10}, {14, 20}};
  const auto some = BatchSolver(problem, part).solve({&load, 1}), whole = BatchSolver(problem).solve({&load, 1});
  ASSERT_EQ(some.size(), 1U);
  EXPECT_LT(difference(some[0], whole[0]), 1e-7);
}

TEST(BatchContact, AnAnswerDependsOnItsOwnTouchAlone) {
  const HyperelasticProblem problem = touchedHexahedra();
  LoadCase uniform;
  uniform.areas = {{1, {0.2, 0, -3}}};
  std::vector<LoadCase> loads{touch(4, 9, 9, 2), uniform, touch(6, 20, 12, 4), touch(5, 12, 18, 2)};
  loads.back().indenters[0].friction = 0.5;
  loads.back().indenters[0].control = Press{{0.4, 0, -2}};
  BatchOptions one, three;
  one.threads = 1;
  three.threads = 3;
  BatchSolver batch(problem, three);
  const auto together = batch.solve(loads);
  for (std::size_t i = 0; i < loads.size(); ++i)
    EXPECT_TRUE(BatchSolver(problem, one).solve({&loads[i], 1})[0].upper_mm == together[i].upper_mm) << i;
}

/// More touches than there are lanes, so that some begin where others have been, beside others that go on. Three nodes
/// under a sphere push it aside: it has to be held in its first step.
TEST(BatchContact, ATouchWithFrictionDependsOnItselfAloneAlsoWhereItFollowsAnother) {
  const HyperelasticProblem problem = touchedHexahedra();
  std::vector<LoadCase> loads;
  for (int i = 0; i < 44; ++i) {
    loads.push_back(touch(6 + 0.05 * i, 10.2 + 2 * (i % 4), 7.8 + 2 * (i % 6), 1));
    Indenter& pressing = loads.back().indenters[0];
    const double press_N = 1.5 + 0.04 * i;
    pressing.friction = 0.3 + 0.01 * i;
    pressing.control = Press{{0.1 * press_N, -0.05 * press_N, -press_N}};
  }
  BatchOptions options;
  options.touched = Rectangle{{3, 3}, {27, 27}};
  options.checkFirst = false;
  BatchOptions one = options;
  one.threads = 1;
  BatchSolver batch(problem, options), single(problem, one);
  const auto together = batch.solve(loads);
  ASSERT_EQ(together.size(), loads.size());
  EXPECT_EQ(batch.leftToNewton(), 0U);
  for (const std::size_t i : {0, 7, 21, 43})
    EXPECT_TRUE(single.solve({&loads[i], 1})[0].upper_mm == together[i].upper_mm) << i;
  const Solution full = problem.solve(loads[7]);
  ASSERT_TRUE(full.converged) << full.stopReason;
  EXPECT_LT(difference(together[7], problem.electrodes(full.state())), 1e-5);
}

TEST(BatchContact, AnIndenterBesideALoadedAreaIsNotLeftOutByTheSurrogate) {
  const HyperelasticProblem problem = touchedHexahedra();
  LoadCase load = touch(8, 20, 20, 2);
  load.areas = {{0, {0.2, 0, -1}}};
  BatchOptions surrogate;
  surrogate.surrogate = true;
  const auto answers = BatchSolver(problem, surrogate).solve({&load, 1});
  const Solution full = problem.solve(load);
  ASSERT_TRUE(full.converged) << full.stopReason;
  EXPECT_LT(difference(answers[0], problem.electrodes(full.state())), 1e-5);
}

TEST(BatchContact, TwoTouchesAtOnceAndAMotionAreSolvedAlong) {
  const HyperelasticProblem problem = touchedHexahedra();
  LoadCase two = touch(5, 8, 15, 2);
  two.indenters.push_back(touch(4, 22, 15, 1).indenters[0]);
  LoadCase moved = touch(5, 15, 15, 1);
  moved.indenters[0].control = Motion{0.3, Eigen::Vector2d::Zero()};
  const std::vector<LoadCase> loads{two, moved};
  BatchSolver batch(problem);
  const auto answers = batch.solve(loads);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Solution full = problem.solve(loads[i]);
    ASSERT_TRUE(full.converged) << full.stopReason;
    EXPECT_LT(difference(answers[i], problem.electrodes(full.state())), 1e-5) << i;
  }
}

} // namespace
} // namespace palp
