#include "solver/IndependentResidual.h"

#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

#include <array>

using namespace palp;

TEST(IndependentResidual, IsSmallForASolutionAndNotForOneThatIsPerturbed) {
  const SensorDesign design = paperDesign();
  const HyperelasticProblem problem(design, sensorMesh(design, {.meshSize_mm = {}, .mapped = std::array{4, 4, 2}}));
  LoadCase load;
  load.areas.push_back({1, {0.3, 0.2, -4}});
  Solution solution = problem.solve(load);
  ASSERT_TRUE(solution.converged);
  EXPECT_LT(independentResidual(design, problem.mesh(), load, solution), 1e-8); // Newton stops at 1e-9
  solution.increments.back().displacements_mm *= 1.001;
  EXPECT_GT(independentResidual(design, problem.mesh(), load, solution), 1e-4);
}
