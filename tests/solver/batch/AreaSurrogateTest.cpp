#include "solver/batch/AreaSurrogate.h"

#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace palp {
namespace {

constexpr int kArea = 2;

struct Fit {
  SensorDesign design;
  HyperelasticProblem problem;
  BatchEngine engine;
  std::optional<AreaSurrogate> surrogate;

  explicit Fit(double tolerance, const SensorDesign& d = paperDesign())
      : design(d), problem(d, sensorMesh(d, {.meshSize_mm = 12, .mapped = {}})),
        engine(problem, problem.block().initialTangent(2, {}), tolerance, 2),
        surrogate(AreaSurrogate::fit(engine, design, std::array{kArea}, tolerance, {}).front()) {}
};

double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& truth) {
  return (a - truth).norm() / truth.norm();
}

TEST(AreaSurrogate, KeepsItsStatedErrorAtForcesOfItsRange) {
  const Fit fit(1e-6);
  ASSERT_TRUE(fit.surrogate);
  EXPECT_GT(fit.surrogate->error(), 0);
  EXPECT_LE(fit.surrogate->error(), 1e-6);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d low = fit.design.forceRange.low_N, high = fit.design.forceRange.high_N;
    const Eigen::Vector3d force_N =
        low + Eigen::Vector3d(share(random), share(random), share(random)).cwiseProduct(high - low);
    const Solution full = fit.problem.solve({{{kArea, force_N}}, {}}, {.relativeTolerance = 1e-11});
    ASSERT_TRUE(full.converged);
    const ElectrodeDisplacements truth = fit.problem.electrodes(full.state());
    const ElectrodeDisplacements answer = fit.surrogate->evaluate({&force_N, 1})[0];
    // The error is relative to a displacement that vanishes with the force, so a small force may show a little more
    // than the 24 forces it was measured on.
    EXPECT_LE(relativeDifference(answer, truth, fit.design), 2 * fit.surrogate->error()) << force_N.transpose();
    EXPECT_LE(relative(answer.lower_mm, truth.lower_mm), 10 * fit.surrogate->error());
    EXPECT_LE(relative(answer.upperPressure_MPa, truth.upperPressure_MPa), 10 * fit.surrogate->error());
  }
}

TEST(AreaSurrogate, TakesTheSmallestDegreeThatMeetsTheTolerance) {
  const Fit rough(1e-2), fine(1e-6);
  ASSERT_TRUE(rough.surrogate && fine.surrogate);
  EXPECT_LT(rough.surrogate->degree(), fine.surrogate->degree());
  EXPECT_LE(rough.surrogate->error(), 1e-2);
  EXPECT_LT(rough.engine.solves(), fine.engine.solves());
}

TEST(AreaSurrogate, AnswersNoForceWithNothingAndEightForcesAsOne) {
  const Fit fit(1e-3);
  ASSERT_TRUE(fit.surrogate);
  std::vector<Eigen::Vector3d> forces_N;
  for (int i = 0; i < lanes; ++i)
    forces_N.push_back(i == 5 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(0.1 * i, 1, -i));
  const auto eight = fit.surrogate->evaluate(forces_N);
  ASSERT_EQ(eight.size(), forces_N.size());
  EXPECT_EQ(eight[5].upper_mm.norm(), 0);
  for (std::size_t i = 0; i < forces_N.size(); ++i)
    EXPECT_EQ(fit.surrogate->evaluate({&forces_N[i], 1})[0].upper_mm, eight[i].upper_mm) << i;
}

TEST(AreaSurrogate, IsNoneWhereALoadOfItsRangeHasNoAnswer) {
  SensorDesign design = paperDesign();
  design.forceRange.low_N.z() = -300; // where the tangent at rest is of no use
  EXPECT_FALSE(Fit(1e-3, design).surrogate);
}

TEST(AreaSurrogate, IsNoneWhereTheFitIsStopped) {
  Fit fit(1e-2);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(AreaSurrogate::fit(fit.engine, fit.design, std::array{kArea}, 1e-2, stop.get_token()).front());
}

TEST(AreaSurrogate, ItsErrorIsOfAllThatTheReadingsFollow) {
  SensorDesign design = paperDesign();
  ElectrodeDisplacements truth = ElectrodeDisplacements::atRest(design);
  truth.upper_mm.setConstant(0.1);
  truth.lower_mm.setConstant(0.01);
  truth.upperPressure_MPa.setConstant(0.05);
  ElectrodeDisplacements lower = truth, pressure = truth;
  lower.lower_mm.row(2) *= 1.5;
  pressure.upperPressure_MPa *= 1.5;
  EXPECT_EQ(relativeDifference(lower, truth, design), 0) << "held electrodes and pressures change no reading";
  EXPECT_EQ(relativeDifference(pressure, truth, design), 0);
  design.lowerFollowsRubber = true;
  design.pressureLaw = PressureLaw{};
  EXPECT_GT(relativeDifference(lower, truth, design), 0.01);
  EXPECT_GT(relativeDifference(pressure, truth, design), 0.1);
}

} // namespace
} // namespace palp
