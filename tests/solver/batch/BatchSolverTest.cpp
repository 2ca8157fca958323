#include "solver/BatchSolver.h"

#include "model/DesignError.h"
#include "tests/solver/CoarseSensor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <stop_token>

using namespace palp;

namespace {

TEST(Batch, AnswersAsFullNewtonWhateverStandsBesideALoad) {
  BatchSolver batch(paperProblem(), {.relativeTolerance = 1e-6, .surrogate = false, .threads = 2});
  std::vector<LoadCase> loads{
      onArea(0, 1, -1, -6), onArea(0, 0.2, 0.1, -0.5),          {{{0, {1, 0, -3}}, {1, {0, 1, -2}}}, {}},
      onArea(0, 0, 0, -15), {{}, {{{20, 9}, 2, {0, 0.3, -2}}}}, onArea(0, 0, 0, 0)};
  const auto answers = batch.solve(loads);
  ASSERT_EQ(answers.size(), loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const auto full = paperProblem().electrodes(paperProblem().solve(loads[i]).state());
    EXPECT_LE((answers[i].upper_mm - full.upper_mm).norm(), 1e-6 * full.upper_mm.norm()) << i;
    EXPECT_LE((answers[i].lower_mm - full.lower_mm).norm(), 1e-5 * full.lower_mm.norm()) << i;
  }
  EXPECT_LE(batch.measuredError().value(), 1e-6);
  BatchSolver other(paperProblem(), {.relativeTolerance = 1e-6, .surrogate = false, .threads = 1});
  const auto alone = other.solve(std::span(loads).subspan(1, 1));
  EXPECT_EQ(alone[0].upper_mm, answers[1].upper_mm);
  EXPECT_EQ(alone[0].upperPressure_MPa, answers[1].upperPressure_MPa);
}

TEST(Batch, OfSurrogatesKeepsTheErrorThatItStates) {
  BatchSolver batch(paperProblem(), {.relativeTolerance = 1e-6, .surrogate = true, .threads = 2});
  std::vector<LoadCase> loads;
  for (int i = 0; i < 100; ++i) loads.push_back(onArea(2, std::sin(i), std::cos(3 * i), -3 + 3 * std::sin(2 * i)));
  const auto answers = batch.solve(loads);
  const auto full = paperProblem().electrodes(paperProblem().solve(loads[42]).state());
  EXPECT_LE(batch.measuredError().value(), 1e-5);
  EXPECT_LE((answers[42].upper_mm - full.upper_mm).norm(), 3e-5 * full.upper_mm.norm());
}

TEST(Batch, FitsSurrogatesOnceAndTellsTheirErrorBeforeAnyLoad) {
  BatchSolver batch(paperProblem(), {.relativeTolerance = 1e-6, .surrogate = true, .threads = 2});
  EXPECT_EQ(batch.surrogateError(), 0);
  const std::array areas{4};
  ASSERT_TRUE(batch.fitSurrogates(areas));
  EXPECT_GT(batch.surrogateError(), 0);
  const std::size_t solves = batch.solves();
  EXPECT_LT(solves, 200U); // a fit takes few full solves
  std::vector<LoadCase> loads;
  for (int i = 0; i < 5000; ++i) loads.push_back(onArea(4, std::sin(i), std::cos(3 * i), -3 + 3 * std::sin(2 * i)));
  EXPECT_EQ(batch.solve(loads).size(), loads.size());
  EXPECT_LE(batch.solves(), solves + 3); // the answers take none but a few checks
}

TEST(Batch, CountsLoadsFromTheNumberGiven) {
  BatchSolver batch(paperProblem());
  const std::vector<LoadCase> loads{onArea(3, 0, 0, -1), onArea(9, 0, 0, -1)};
  try {
    static_cast<void>(batch.solve(loads, {}, {}, 500));
    FAIL() << "area 9 is none of the design's";
  } catch (const DesignError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("load 501: area: got 9"), std::string::npos) << refusal.what();
  }
}

TEST(Batch, StopsAndGoesOn) {
  BatchSolver batch(paperProblem());
  std::stop_source stop;
  stop.request_stop();
  const std::vector<LoadCase> loads{onArea(3, 0, 0, -1)};
  EXPECT_TRUE(batch.solve(loads, {}, stop.get_token()).empty());
  EXPECT_EQ(batch.solve(loads).size(), 1U);
}

} // namespace
