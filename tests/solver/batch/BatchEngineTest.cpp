#include "solver/batch/BatchEngine.h"

#include "solver/SensorMesh.h"
#include "tests/solver/CoarseSensor.h"

#include <gtest/gtest.h>

#include <numeric>

namespace palp {
namespace {

/// The paper's block on a mesh coarse enough for a test.
const HyperelasticProblem& problem() {
  static const HyperelasticProblem coarse(paperDesign(), sensorMesh(paperDesign(), {.meshSize_mm = 12, .mapped = {}}));
  return coarse;
}

/// The same of a few hexahedra, for what takes many iterations of full Newton.
const HyperelasticProblem& fewHexahedra() {
  static const HyperelasticProblem few(paperDesign(),
                                       sensorMesh(paperDesign(), {.meshSize_mm = {}, .mapped = {{8, 8, 4}}}));
  return few;
}

/// Gentle loads, and the second of them many times what the sensor is for: the tangent at rest says nothing about it.
const std::vector<LoadCase> gentleAndHuge{onArea(1, 0.5, 0, -3), onArea(1, 0, 0, -150), onArea(1, 0, -1, -1)};

TEST(BatchEngine, LeavesALoadUnansweredThatTheTangentAtRestDoesNotSolve) {
  BatchEngine engine(problem(), problem().block().initialTangent(2, {}), 1e-6, 2);
  const auto answers = engine.solve(gentleAndHuge, 1e-6, {}, {});
  ASSERT_EQ(answers.size(), gentleAndHuge.size());
  EXPECT_FALSE(answers[1]);
  for (const std::size_t gentle : {0, 2}) {
    ASSERT_TRUE(answers[gentle]);
    const auto alone = engine.solve(std::span(gentleAndHuge).subspan(gentle, 1), 1e-6, {}, {});
    ASSERT_TRUE(alone[0]);
    EXPECT_EQ(alone[0]->upper_mm, answers[gentle]->upper_mm); // a lane that fails leaves its neighbours alone
  }
}

// A load outside the force range has no predictor and begins at rest; what stands beside it may begin elsewhere.
TEST(BatchEngine, AnswersALoadThatBeginsAtRestWithTheSameBytesBesideAnyOther) {
  BatchEngine engine(problem(), problem().block().initialTangent(2, {}), 1e-6, 1);
  const std::vector<LoadCase> mixed{onArea(1, 0.3, 0, -9), onArea(1, 0.5, 0, -3)};
  const auto both = engine.solve(mixed, 1e-6, {}, {});
  const auto alone = engine.solve(std::span(mixed).first(1), 1e-6, {}, {});
  ASSERT_TRUE(both[0] && alone[0]);
  EXPECT_EQ(both[0]->upper_mm, alone[0]->upper_mm);
  EXPECT_EQ(both[0]->upperPressure_MPa, alone[0]->upperPressure_MPa);
}

TEST(BatchEngine, CountsEveryLoadOnceInItsProgress) {
  BatchEngine engine(problem(), problem().block().initialTangent(2, {}), 1e-6, 2);
  const std::vector<LoadCase> many(100, gentleAndHuge[0]); // in four groups
  std::vector<std::size_t> counts;
  ASSERT_EQ(engine.solve(many, 1e-6, [&](std::size_t count) { counts.push_back(count); }, {}).size(), many.size());
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), many.size());
}

TEST(BatchSolver, TakesFullNewtonWhereTheBatchFails) {
  BatchSolver batch(fewHexahedra(), {.relativeTolerance = 1e-6, .surrogate = false, .threads = 2});
  const auto answers = batch.solve(gentleAndHuge);
  ASSERT_EQ(answers.size(), gentleAndHuge.size());
  const Solution full = fewHexahedra().solve(gentleAndHuge[1], {.relativeTolerance = 1e-11, .threads = 2});
  ASSERT_TRUE(full.converged) << full.stopReason;
  const ElectrodeDisplacements truth = fewHexahedra().electrodes(full.state());
  EXPECT_EQ(answers[1].upper_mm, truth.upper_mm); // the very same solve
  EXPECT_EQ(answers[1].lower_mm, truth.lower_mm);
  EXPECT_EQ(answers[1].upperPressure_MPa, truth.upperPressure_MPa);
  // 32 for the area's predictor, one a load, and full Newton once for the load that failed: the check of one load in
  // 700 falls on that load, has nothing to compare there and takes the next.
  EXPECT_EQ(batch.solves(), 32U + gentleAndHuge.size() + 2U);
  ASSERT_TRUE(batch.measuredError().has_value());
  EXPECT_LT(*batch.measuredError(), 1e-5);
  EXPECT_TRUE(batch.nonUniqueLoads().empty());
}

TEST(BatchSolver, NamesTheLoadThatHasNoSolution) {
  BatchSolver batch(fewHexahedra(), {.relativeTolerance = 1e-6, .surrogate = false, .threads = 2});
  const std::vector<LoadCase> hopeless{gentleAndHuge[0], onArea(1, 60, -60, -720)};
  try {
    (void)batch.solve(hopeless);
    FAIL() << "720 N have a solution";
  } catch (const ConvergenceError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("load 1: ", 0), 0U) << error.what();
  }
}

} // namespace
} // namespace palp
