#include "solver/BatchSolver.h"
#include "tests/solver/CoarseSensor.h"
#include "tests/solver/TestBlocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace palp;
using namespace palp::test;

namespace {

/// Yeoh and Ogden of the printed closed forms (tests/model/RubberLawTest.cpp has their numbers), and two more.
const std::vector<RubberLaw>& solvedLaws() {
  static const std::vector<RubberLaw> laws{Yeoh{0.2, 0.03, 0.002}, Ogden{{0.4, 0.02}, {2, 5}}, Gent{0.4, 12},
                                           NeoHooke{0.2}};
  return laws;
}

class SolvedLaw : public testing::TestWithParam<std::size_t> {
protected:
  const RubberLaw& law_ = solvedLaws()[GetParam()];
};
INSTANTIATE_TEST_SUITE_P(Laws, SolvedLaw, testing::Range(std::size_t{0}, solvedLaws().size()));

/// Nominal stress along z of a distorted incompressible cube with symmetry planes at the axes.
double solvedStress(const RubberLaw& law, TestMode mode, double stretch) {
  const auto isEnd = [](double x) { return x > 1 - 1e-9; };
  const BoundaryValueProblem p(cubeTets(2, 0.2), Material{law, 0.5}, [&](const Eigen::Vector3d& x, int d) {
    if (x(d) < 1e-9) return std::optional(0.);
    if (!isEnd(x(d)) || d == 0) return std::optional<double>();
    if (d == 2) return std::optional(stretch - 1);
    if (mode == TestMode::Planar) return std::optional(0.);
    return mode == TestMode::Equibiaxial ? std::optional(stretch - 1) : std::nullopt;
  });
  const NewtonResult result = p.solve();
  EXPECT_TRUE(result.converged) << result.stopReason;
  return p.reaction(result, 2, [&](const Eigen::Vector3d& x) { return isEnd(x.z()); });
}

TEST_P(SolvedLaw, GivesTheClosedFormsOfIncompressibleRubber) {
  for (const auto& [mode, name] : kTestModes.all())
    for (const double stretch : {0.7, 1.3, 2.0}) {
      if (mode == TestMode::Equibiaxial && stretch == 2 && std::holds_alternative<Gent>(law_)) continue; // tested below
      EXPECT_NEAR(solvedStress(law_, mode, stretch), nominalStress_MPa(law_, mode, stretch), 1e-8) << name << stretch;
    }
}

TEST(GentsLaw, GivesTheStressNearItsLimit) {
  const Gent gent{0.4, 6}; // I1 - 3 = 5.06 at stretch 2
  EXPECT_NEAR(solvedStress(gent, TestMode::Equibiaxial, 2), nominalStress_MPa(gent, TestMode::Equibiaxial, 2), 1e-8);
}

SensorDesign sensorOf(const RubberLaw& law) {
  SensorDesign design = paperDesign();
  design.material.law = law;
  return design;
}

/// Row-wire 4 under (0.5, 0.3, -6) N on load area 1: displacements by hexahedra of order 3 with pressures of order 2 of
/// another program, 92,880 unknowns, right to 1e-3.
TEST(YeohsLaw, DeformsTheBlockAsAnotherProgramDoes) {
  constexpr double reference[10][3] = {{-0.01239517, 0.00240362, -0.00041523}, {-0.01501248, 0.00382012, 0.00426477},
                                       {-0.02133494, 0.00933565, 0.00782108},  {-0.02626188, 0.02436737, -0.03017667},
                                       {0.00228925, 0.03652672, -0.048439},    {0.02431216, 0.03833195, -0.04765166},
                                       {0.0473126, 0.02925257, -0.03007194},   {0.03513228, 0.01354332, 0.00988667},
                                       {0.0246214, 0.00639229, 0.00588586},    {0.02056669, 0.00450155, -0.00077207}};
  const SensorDesign design = sensorOf(Yeoh{0.2, 0.03, 0.002}); // nu = 0.499: K = 200 MPa, as there
  const HyperelasticProblem problem(design, sensorMesh(design, {}));
  const Solution solution = problem.solve(onArea(1, 0.5, 0.3, -6));
  ASSERT_TRUE(solution.converged) << solution.stopReason;
  const Eigen::Matrix3Xd u = problem.electrodes(solution.state()).upper_mm;
  double error = 0, norm = 0;
  for (int e = 0; e < 10; ++e)
    for (int d = 0; d < 3; ++d) {
      error += std::pow(u(d, 40 + e) - reference[e][d], 2);
      norm += std::pow(reference[e][d], 2);
    }
  EXPECT_LT(std::sqrt(error / norm), 0.015 + 0.001); // the mesh's error, and the reference's
}

TEST_P(SolvedLaw, OfABatchAgreesWithSingleSolves) {
  const HyperelasticProblem problem = coarse(sensorOf(law_), 9);
  const std::vector<LoadCase> loads{onArea(0, 0.5, -0.3, -3), onArea(4, -0.2, 0.6, -1)};
  const auto batch = BatchSolver(problem).solve(loads, {});
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const Solution solution = problem.solve(loads[k]);
    ASSERT_TRUE(solution.converged) << solution.stopReason;
    const Eigen::Matrix3Xd u = problem.electrodes(solution.state()).upper_mm;
    EXPECT_LT((batch[k].upper_mm - u).norm(), 1e-6 * u.norm());
  }
}

TEST(GentsLaw, EndsASolveWithAClearSentenceWhereItLocks) {
  const BoundaryValueProblem p(cubeTets(2, 0), Material{Gent{0.4, 0.3}, 0.5}, [](const Eigen::Vector3d& x, int d) {
    if (x(d) < 1e-9) return std::optional(0.);
    return d == 2 && x.z() > 1 - 1e-9 ? std::optional(0.5) : std::nullopt;
  });
  const NewtonResult result = p.solve();
  EXPECT_FALSE(result.converged);
  EXPECT_NEAR(1 + 0.5 * result.increments.back().loadFraction, 1.347, 0.01); // where l^2 + 2/l - 3 = 0.3
  EXPECT_NE(result.stopReason.find("limit jm of Gent's law"), std::string::npos) << result.stopReason;
}

TEST(GentsLaw, CarriesALoadByStiffening) {
  const HyperelasticProblem soft = coarse(sensorOf(NeoHooke{0.4}), 9), locking = coarse(sensorOf(Gent{0.8, 0.002}), 9);
  const LoadCase load = onArea(1, 0, 0, -30);
  const Solution a = soft.solve(load), b = locking.solve(load);
  ASSERT_TRUE(a.converged && b.converged) << b.stopReason;
  EXPECT_LT(b.state().displacements_mm.norm(), 0.5 * a.state().displacements_mm.norm());
}

} // namespace
