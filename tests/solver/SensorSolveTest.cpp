#include "model/DesignError.h"
#include "solver/BatchSolver.h"
#include "solver/DiscretisationError.h"
#include "solver/HyperelasticProblem.h"
#include "solver/MeshQuality.h"
#include "solver/SensorMesh.h"
#include "solver/statics/LinearisedBlock.h"
#include "tests/solver/CoarseSensor.h"

#include <SourceDir.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>
#include <random>
#include <thread>

using namespace palp;

namespace {

int mostIterations(const Solution& s) {
  int most = 0;
  for (const NewtonStep& step : s.newton) most = std::max(most, step.iteration);
  return most;
}

/// Smallest volume ratio at the quadrature points of a state.
double smallestJ(const HyperelasticProblem& problem, const LoadIncrement& increment) {
  const Assembler& assembler = problem.block().assembler;
  const Discretisation& mesh = assembler.discretisation();
  ElementState state = mesh.atRest();
  state.displacements = increment.displacements_mm.reshaped();
  for (int e = 0; e < lanes * mesh.blocks(); ++e)
    for (int k = 0; k < mesh.unknowns(); ++k)
      state.unknowns[laneIndex(e, mesh.unknowns(), k)] = increment.elementUnknowns(k, std::min(e, mesh.elements() - 1));
  ElementTangents tangents;
  ElementForces forces;
  assembler.tangent(state, tangents, forces, 1, {});
  return forces.smallestJ;
}

/// Relative L2 error of row-wire 4 against the converged reference.
double referenceError(const std::string& name, const HyperelasticProblem& problem, const Solution& solution) {
  nlohmann::json reference;
  std::ifstream(PALP_SOURCE_DIR "/tests/reference/converged.json") >> reference;
  const auto& u = reference["cases"][name]["u_mm"];
  const Eigen::Matrix3Xd ours = problem.electrodes(solution.state()).upper_mm;
  double error = 0, norm = 0;
  for (int e = 0; e < 10; ++e)
    for (int d = 0; d < 3; ++d) {
      const double value = u[e][d];
      error += std::pow(ours(d, 40 + e) - value, 2);
      norm += value * value;
    }
  return std::sqrt(error / norm);
}

TEST(DefaultMesh, MeetsTheReferencesWithinTwoPercent) {
  const SensorDesign design = paperDesign();
  const HyperelasticProblem problem(design, sensorMesh(design));
  EXPECT_LT(referenceError("A", problem, problem.solve(onArea(0, 1, 0, -6))), 0.02);
  // The reference of this load is itself good to 1.2 %.
  const Solution half = problem.solve(onArea(1, 5, -5, -60));
  EXPECT_TRUE(half.converged);
  EXPECT_LE(half.iterations(), 6);
  EXPECT_LT(referenceError("E_half", problem, half), 0.025);
}

TEST(Sensor, HasUpperElectrodesAsNodesAndAreasAlongFaces) {
  SensorDesign design = paperDesign();
  design.upper.along_mm.assign(10, {});
  for (int w = 0; w < 10; ++w) // wire by wire elsewhere: no common lines
    for (int e = 0; e < 10; ++e) design.upper.along_mm[w].push_back(1.2 + 2.9 * e + 0.05 * w);
  const Mesh mesh = sensorMesh(design, {.meshSize_mm = 7, .mapped = {}});
  const Eigen::Matrix3Xd electrodes = design.upperElectrodes_mm();
  ASSERT_EQ(mesh.upperElectrodeNodes.size(), 100U);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(Eigen::Vector3d(mesh.nodes_mm.col(mesh.upperElectrodeNodes[i])), Eigen::Vector3d(electrodes.col(i)));
  for (int f = 0; f < mesh.topFaces.cols(); ++f) {
    const Rectangle area = design.areaRectangle(mesh.topFaceAreas(f));
    for (int n = 0; n < 3; ++n) {
      const Eigen::Vector2d p = mesh.nodes_mm.col(mesh.topFaces(n, f)).head<2>();
      EXPECT_TRUE((p.array() >= area.low_mm.array() - 1e-12).all() &&
                  (p.array() <= area.high_mm.array() + 1e-12).all());
    }
  }
  EXPECT_GT(meshQuality(mesh).minDihedral_deg, 0.5);
}

TEST(Sensor, BalancesEveryLoadWithItsReactions) {
  LoadCase load{{{0, {1, 0.5, -6}}, {4, {-1, 1, -2}}}, {{{11, 17}, 2.5, {0.5, 0.2, -3}}}};
  const Solution s = paperProblem().solve(load);
  ASSERT_TRUE(s.converged) << s.stopReason;
  EXPECT_LT((s.reaction_N + load.totalForce_N()).norm(), 1e-9 * load.totalForce_N().norm());
}

TEST(Sensor, MirroredLoadsGiveMirroredAnswers) {
  const auto u = paperProblem().electrodes(paperProblem().solve(onArea(0, 1, 0.5, -6)).state()).upper_mm;
  const auto v = paperProblem().electrodes(paperProblem().solve(onArea(2, -1, 0.5, -6)).state()).upper_mm;
  Eigen::Matrix3Xd mirrored = v;
  for (int r = 0; r < 10; ++r)
    for (int e = 0; e < 10; ++e)
      mirrored.col(10 * r + e) = Eigen::Vector3d(-1, 1, 1).cwiseProduct(v.col(10 * r + 9 - e));
  EXPECT_LT((u - mirrored).norm() / u.norm(), 0.03); // both have the coarse mesh's error
}

TEST(Sensor, NeedsFewIterationsAtAnyPoissonRatio) {
  SensorDesign design = paperDesign();
  Eigen::Matrix3Xd nearly;
  for (const double nu : {0.0, 0.3, 0.49, 0.499, 0.4999, 0.499999, 0.5}) {
    design.material.poissonRatio = nu;
    const HyperelasticProblem problem = coarse(design);
    const Solution s = problem.solve(onArea(0, 1, 0, -6));
    EXPECT_TRUE(s.converged) << nu << s.stopReason;
    EXPECT_EQ(s.increments.size(), 2U) << nu;
    EXPECT_LE(mostIterations(s), 4) << nu;
    const Eigen::Matrix3Xd u = problem.electrodes(s.state()).upper_mm;
    if (nu == 0.499999) nearly = u;
    if (nu == 0.5) { // no jump at the incompressible limit
      EXPECT_LT((u - nearly).norm() / u.norm(), 1e-4);
    }
  }
}

TEST(Sensor, CarriesBigLoads) {
  for (const Eigen::Vector3d& force : {Eigen::Vector3d(3, 3, -60), Eigen::Vector3d(0, 0, -150)}) {
    const Solution s = paperProblem().solve({{{1, force}}, {}});
    EXPECT_TRUE(s.converged) << s.stopReason;
    EXPECT_LE(s.iterations(), 20);
  }
}

TEST(Sensor, CarriesABigLoadOnACornerInOneLoadStep) {
  // Full steps lead from here to states whose tangent is not positive definite, at residuals below the load's.
  const Solution s = paperProblem().solve(onArea(0, 0, 0, -150));
  EXPECT_TRUE(s.converged) << s.stopReason;
  EXPECT_LE(s.iterations(), 14); // as on the edge's area; on the default mesh 16
  EXPECT_EQ(s.increments.size(), 2U);
  // A step may leave a residual behind that the next one mends, but none that grows beyond Newton's reach.
  for (std::size_t i = 1; i < s.newton.size(); ++i)
    EXPECT_LT(s.newton[i].relativeResidual, 2 * s.newton[i - 1].relativeResidual) << i;
}

TEST(Sensor, SaysWhetherToleranceOrRoundingEndsIt) {
  const Solution below = paperProblem().solve(onArea(0, 1, 0, -6));
  EXPECT_TRUE(below.converged);
  EXPECT_TRUE(below.stopReason.empty()) << below.stopReason;
  EXPECT_LT(below.newton.back().relativeResidual, 1e-9);
  const Solution rounded = paperProblem().solve(onArea(0, 1, 0, -6), {.relativeTolerance = 1e-18});
  EXPECT_TRUE(rounded.converged);
  EXPECT_NE(rounded.stopReason.find("round-off level"), std::string::npos) << rounded.stopReason;
  EXPECT_NE(rounded.stopReason.find("1e-18"), std::string::npos) << rounded.stopReason;
  EXPECT_LT(rounded.newton.back().relativeResidual, 1e-12);
}

TEST(Sensor, ALoadNearRoundingIsSolvedAsFarAsNumbersGoAndSaysSo) {
  const auto perNewton = [](double force_N, std::string& reason) {
    const Solution s = paperProblem().solve({{{3, force_N * Eigen::Vector3d(0.2, 0, -1)}}, {}});
    EXPECT_TRUE(s.converged) << force_N << " N: " << s.stopReason;
    EXPECT_LT(s.newton.size(), 8u) << force_N << " N";
    reason = s.stopReason;
    return Eigen::Matrix3Xd(paperProblem().electrodes(s.state()).upper_mm / force_N);
  };
  std::string reason;
  const Eigen::Matrix3Xd small = perNewton(1e-2, reason);
  EXPECT_TRUE(reason.empty()) << reason;
  for (const double force_N : {1e-7, 1e-8, 1e-9}) {
    const Eigen::Matrix3Xd tiny = perNewton(force_N, reason);
    EXPECT_LT((tiny - small).norm(), 1e-3 * small.norm()) << force_N << " N";
  }
  EXPECT_NE(reason.find("round-off level"), std::string::npos) << reason;
}

TEST(Sensor, ABlockThatIsNotStableAtRestIsADesignWithoutASolution) {
  SensorDesign design = paperDesign();
  std::get<MooneyRivlin>(design.material.law).c01_MPa = -2 * std::get<MooneyRivlin>(design.material.law).c10_MPa;
  try {
    (void)coarse(design, 12).solve(onArea(0, 0, 0, -1));
    ADD_FAILURE() << "solved";
  } catch (const DesignError& refused) { // no mistake of the program's
    EXPECT_NE(std::string(refused.what()).find("material.c01_MPa"), std::string::npos) << refused.what();
  }
}

TEST(Sensor, EndsHonestlyWhereTheBlockLosesStability) {
  const HyperelasticProblem problem = coarse(paperDesign(), 12);
  const Eigen::Vector3d force(60, -60, -720); // many times what the sensor is for
  const Solution s = problem.solve({{{1, force}}, {}}, {.smallestStep = 0.05});
  ASSERT_FALSE(s.converged);
  EXPECT_FALSE(s.cancelled);
  EXPECT_FALSE(s.stopReason.empty());
  EXPECT_GT(s.reachedLoadFraction, 0.1);
  EXPECT_LT(s.reachedLoadFraction, 1);
  EXPECT_EQ(s.state().loadFraction, s.reachedLoadFraction);
  EXPECT_TRUE(s.state().displacements_mm.allFinite());
  EXPECT_TRUE(s.state().elementUnknowns.allFinite());
  EXPECT_GT(smallestJ(problem, s.state()), 0); // no element inside out
  // An equilibrium: the clamped face carries the share of the load that was reached.
  EXPECT_LT((s.reaction_N + s.reachedLoadFraction * force).norm(), 1e-8 * force.norm());
  // And the same one that a solve to that share alone finds.
  const Solution again = problem.solve({{{1, s.reachedLoadFraction * force}}, {}});
  ASSERT_TRUE(again.converged) << again.stopReason;
  EXPECT_LT((again.state().displacements_mm - s.state().displacements_mm).norm(),
            1e-6 * s.state().displacements_mm.norm());
}

TEST(Sensor, GivesTheSameBytesWithAnyNumberOfThreads) {
  const HyperelasticProblem one = coarse(), two = coarse();
  const Solution a = one.solve(onArea(3, 1, -1, -5), {.threads = 1}),
                 b = two.solve(onArea(3, 1, -1, -5), {.threads = 2});
  EXPECT_EQ(a.state().displacements_mm, b.state().displacements_mm);
  EXPECT_EQ(a.state().elementUnknowns, b.state().elementUnknowns);
}

TEST(Sensor, FindsAnewTheFactorThatItReleased) {
  const HyperelasticProblem problem = coarse();
  const Solution before = problem.solve(onArea(3, 1, -1, -6));
  problem.releaseFactor();
  const Solution after = problem.solve(onArea(3, 1, -1, -6));
  EXPECT_EQ(before.state().displacements_mm, after.state().displacements_mm);
  EXPECT_EQ(before.newton.size(), after.newton.size());
}

// A gentle load is solved with the tangent at rest alone, the second takes tangents on the way, and the third fails in
// one step and goes back to rest.
TEST(Sensor, HoldsOneTangentAtATimeWhereItIsAskedToAndSolvesTheSame) {
  const HyperelasticProblem problem = coarse();
  for (const double down_N : {-0.01, -6., -150.}) {
    const LoadCase load = onArea(0, 0, 0, down_N);
    std::weak_ptr<const InitialTangent> rest = problem.block().initialTangent(1, {});
    const Solution two = problem.solve(load, {.threads = 1});
    EXPECT_FALSE(rest.expired());
    bool held = true;
    const Solution one = problem.solve(load, {.threads = 1, .oneTangent = true},
                                       {[&](const NewtonStep&) { held = !rest.expired(); }, {}});
    EXPECT_EQ(held, down_N > -1) << down_N;
    EXPECT_EQ(rest.expired(), !held) << "kept for the next solve where it was not let go";
    EXPECT_EQ(one.converged, two.converged);
    EXPECT_EQ(one.newton.size(), two.newton.size());
    EXPECT_EQ(one.state().displacements_mm, two.state().displacements_mm);
    EXPECT_EQ(one.state().elementUnknowns, two.state().elementUnknowns);
  }
}

TEST(Sensor, AnswersForProbesWhileItFactorises) {
  // Another thread holds the factorisation for seconds: nobody who asks for something else may wait for it.
  const HyperelasticProblem problem(paperDesign(), sensorMesh(paperDesign(), {.meshSize_mm = 2, .mapped = {}}));
  const LoadIncrement rest{0, Eigen::Matrix3Xd::Zero(3, problem.mesh().nodeCount()),
                           Eigen::MatrixXd::Zero(7, problem.mesh().elementCount())};
  problem.findOrdering();
  std::stop_source stop;
  std::atomic<bool> factorised = false;
  std::jthread working([&] {
    static_cast<void>(problem.findFactor(1, stop.get_token()));
    factorised = true;
  });
  EXPECT_EQ(problem.electrodes(rest).upper_mm.norm(), 0);
  problem.releaseFactor();
  const bool before = !factorised;
  // Who wants the factor as well waits no longer than it is asked to.
  std::stop_source other;
  other.request_stop();
  EXPECT_EQ(problem.findFactor(1, other.get_token()), 0U);
  EXPECT_TRUE(before && !factorised);
  stop.request_stop();
}

TEST(Sensor, IsSharedByItsCopiesAndNeverEmpty) {
  std::optional<HyperelasticProblem> first(coarse());
  BatchSolver batch(*first);
  const HyperelasticProblem copy = *first, second = std::move(*first);
  EXPECT_EQ(&copy.mesh(), &second.mesh());
  EXPECT_EQ(first->dof(), copy.dof()); // NOLINT(bugprone-use-after-move): moving copies
  first.reset();
  const std::vector<LoadCase> loads{onArea(3, 0, 0, -1)};
  const auto answers = batch.solve(loads);
  ASSERT_EQ(answers.size(), 1U);
  const Eigen::Matrix3Xd full = copy.electrodes(copy.solve(loads[0]).state()).upper_mm;
  EXPECT_LT((answers[0].upper_mm - full).norm(), 1e-6 * full.norm()); // the batch's tolerance
}

TEST(Sensor, LeavesNothingBrokenWhenCancelled) {
  const HyperelasticProblem problem = coarse();
  std::stop_source stop;
  NewtonObserver observer{.step = [&](const NewtonStep&) { stop.request_stop(); }, .stop = stop.get_token()};
  const Solution cancelled = problem.solve(onArea(0, 0, 0, -6), {}, observer);
  EXPECT_TRUE(cancelled.cancelled);
  EXPECT_FALSE(cancelled.converged);
  EXPECT_TRUE(problem.solve(onArea(0, 0, 0, -6)).converged);
}

TEST(Sensor, StopsAnywhereAndSolvesAgain) {
  // A request at any time of a solve: at rest, in the ordering, the factorisation, the iterations.
  std::mt19937 random(1);
  int cancelled = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const HyperelasticProblem problem = coarse();
    std::stop_source stop;
    std::jthread asking([&, wait = std::chrono::microseconds(random() % 200000)] {
      std::this_thread::sleep_for(wait);
      stop.request_stop();
    });
    const Solution s = problem.solve(onArea(0, 0, 0, -6), {}, {.step = {}, .stop = stop.get_token()});
    EXPECT_NE(s.cancelled, s.converged);
    EXPECT_TRUE(s.state().displacements_mm.allFinite());
    cancelled += s.cancelled;
    EXPECT_TRUE(problem.solve(onArea(0, 0, 0, -6)).converged);
  }
  EXPECT_GT(cancelled, 0);
}

TEST(Sensor, RefusesALoadThatCannotAct) {
  EXPECT_THROW(static_cast<void>(paperProblem().solve(onArea(6, 0, 0, -1))), DesignError);
  EXPECT_THROW(sensorMesh(paperDesign(), {.meshSize_mm = -1, .mapped = {}}), DesignError);
  EXPECT_THROW(sensorMesh(paperDesign(), {.meshSize_mm = 0.01, .mapped = {}}), DesignError);
}

TEST(Sensor, FieldsAreThoseOfTheState) {
  const Solution s = paperProblem().solve(onArea(1, 0, 0, -6));
  const NodalFields f = paperProblem().fields(s.state());
  EXPECT_EQ(f.displacement_mm, s.state().displacements_mm);
  EXPECT_LT((f.pressure_MPa + f.cauchy_MPa.topRows<3>().colwise().sum().transpose() / 3).norm(), 1e-12);
  EXPECT_GT(f.vonMises_MPa.maxCoeff(), 0);
  EXPECT_NEAR(f.volumeRatio.mean(), 1, 0.01); // nearly incompressible
}

TEST(MappedHexahedra, AgreeWithTetrahedraAsTheyAreRefined) {
  const SensorDesign design = paperDesign();
  const Eigen::Matrix3Xd u = paperProblem().electrodes(paperProblem().solve(onArea(4, 1, 0, -6)).state()).upper_mm;
  double previous = 1;
  for (const int n : {10, 20}) {
    const HyperelasticProblem hexes(design, sensorMesh(design, {.meshSize_mm = {}, .mapped = std::array{n, n, n / 2}}));
    const double error = (hexes.electrodes(hexes.solve(onArea(4, 1, 0, -6)).state()).upper_mm - u).norm() / u.norm();
    EXPECT_LT(error, 0.6 * previous);
    previous = error;
  }
  EXPECT_LT(previous, 0.1);
}

TEST(ErrorEstimate, IsRightWithinAFactorOfThree) {
  const SensorDesign design = paperDesign();
  const HyperelasticProblem fine(design, sensorMesh(design, {.meshSize_mm = 3, .mapped = {}}));
  for (const LoadCase& load : {onArea(1, 0, 1, -3), onArea(5, 1, 1, -1)}) {
    const Eigen::Matrix3Xd truth = fine.electrodes(fine.solve(load).state()).upper_mm;
    const Solution s = paperProblem().solve(load);
    const double error = (paperProblem().electrodes(s.state()).upper_mm - truth).norm() / truth.norm();
    const double estimate = discretisationError(paperProblem(), load, s).relative.value();
    EXPECT_LT(estimate, 3 * error);
    EXPECT_GT(estimate, error / 3);
  }
}

TEST(ErrorEstimate, IsNoneWhereTheCoarserMeshDoesNotBearTheLoad) {
  const HyperelasticProblem problem = coarse(paperDesign(), 12);
  const LoadCase load = onArea(1, 0, 0, -1);
  Solution s = problem.solve(load);
  s.increments.back().loadFraction = 1e6; // as if this mesh had borne a million newtons
  const DiscretisationError error = discretisationError(problem, load, s);
  EXPECT_FALSE(error.relative.has_value());
  EXPECT_NE(error.method.find("did not converge"), std::string::npos) << error.method;
}

TEST(ErrorEstimate, SaysHowFarItCanBeTrusted) {
  const HyperelasticProblem tets = coarse(paperDesign(), 12),
                            hexes(paperDesign(), sensorMesh(paperDesign(), {.meshSize_mm = {}, .mapped = {{6, 6, 3}}}));
  const LoadCase load = onArea(1, 0, 0, -1);
  const std::string graded = discretisationError(tets, load, tets.solve(load)).method;
  EXPECT_NE(graded.find("within a factor of 3"), std::string::npos) << graded;
  const std::string mapped = discretisationError(hexes, load, hexes.solve(load)).method;
  EXPECT_NE(mapped.find("their own error"), std::string::npos) << mapped;
}

} // namespace
