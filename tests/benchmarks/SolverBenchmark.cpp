// Error against time of the solver, CalculiX beside it where ccx is installed, and how it stands extremes. The error is
// that of row-wire 4 in case A of tests/reference/converged.json, unless it says otherwise. With PALP_INSTRUCTION_SET
// (baseline, avx2) the same on a processor that has less.
#include "solver/BatchSolver.h"
#include "solver/ConductionField.h"
#include "solver/DiscretisationError.h"
#include "solver/SensorMesh.h"
#include "tests/benchmarks/CalculixBricks.h"
#include "tests/solver/TestBlocks.h"

#include <SourceDir.h>
#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <sys/resource.h>
#include <thread>

using namespace palp;

namespace {

const LoadCase caseA{{{0, {1, 0, -6}}}, {}};

double errorInCaseA(const Eigen::Matrix3Xd& upper_mm) {
  nlohmann::json reference;
  std::ifstream(PALP_SOURCE_DIR "/tests/reference/converged.json") >> reference;
  double error = 0, norm = 0;
  for (int e = 0; e < 10; ++e)
    for (int d = 0; d < 3; ++d) {
      const double value = reference["cases"]["A"]["u_mm"][e][d];
      error += std::pow(upper_mm(d, 40 + e) - value, 2);
      norm += value * value;
    }
  return std::sqrt(error / norm);
}

/// One load from nothing, meshing included; the argument is the mesh size in percent of the default.
void oneLoad(benchmark::State& state) {
  const SensorDesign design = paperDesign();
  const double size = standardMeshSize_mm(design) * double(state.range(0)) / 100;
  for (auto _ : state) {
    const HyperelasticProblem problem(design, sensorMesh(design, {.meshSize_mm = size, .mapped = {}}));
    const Solution solution = problem.solve(caseA);
    state.counters["error_percent"] = 100 * errorInCaseA(problem.electrodes(solution.state()).upper_mm);
    state.counters["dof"] = problem.dof();
    state.counters["iterations"] = solution.iterations();
  }
}
BENCHMARK(oneLoad)
    ->Arg(200)
    ->Arg(150)
    ->Arg(100)
    ->Arg(60)
    ->Arg(45)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

/// The network of the paper's wires under the field in one solved state, rest and meshing left out; the error is that
/// of the mesh's displacements and field in d ln R, as estimated.
void oneFieldState(benchmark::State& state) {
  SensorDesign design = paperDesign();
  design.resistance = FieldLaw{};
  const HyperelasticProblem problem(design, sensorMesh(design));
  const Solution solution = problem.solve(caseA);
  const ConductionField field(problem);
  benchmark::DoNotOptimize(field.network(solution.state())); // and the state at rest
  for (auto _ : state) {
    const auto network = field.network(solution.state());
    const Eigen::MatrixXd resistances = NetworkReading(*network, Readout::Floating).resistances_ohm();
    state.PauseTiming();
    state.counters["error_percent"] =
        100 * discretisationError(problem, caseA, solution, {}, 0, &resistances).resistances.value_or(0);
    state.ResumeTiming();
  }
}
BENCHMARK(oneFieldState)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(3);

/// The paper's 700 samples from nothing: 600 to train on all areas, 100 to test on one.
void sevenHundredSamples(benchmark::State& state) {
  const SensorDesign design = paperDesign();
  const double size = standardMeshSize_mm(design) * double(state.range(0)) / 100;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> side(-1, 1), down(-6, 0);
  std::vector<LoadCase> loads;
  for (int i = 0; i < 700; ++i) {
    const double x = side(random), y = side(random), z = down(random);
    loads.push_back({{{i < 600 ? i / 100 : 0, {x, y, z}}}, {}});
  }
  for (auto _ : state) {
    const HyperelasticProblem problem(design, sensorMesh(design, {.meshSize_mm = size, .mapped = {}}));
    BatchSolver batch(problem, {.relativeTolerance = state.range(1) ? 1e-8 : 1e-6, .surrogate = false, .threads = 0});
    benchmark::DoNotOptimize(batch.solve(loads));
    state.counters["error_against_newton"] = batch.measuredError().value_or(0);
    const std::vector<LoadCase> one{caseA};
    state.counters["mesh_error_percent"] = 100 * errorInCaseA(batch.solve(one)[0].upper_mm);
    state.counters["dof"] = problem.dof();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    state.counters["peak_MB_so_far"] = double(usage.ru_maxrss) / 1024;
  }
}
BENCHMARK(sevenHundredSamples)
    ->Args({200, 0})
    ->Args({100, 0})
    ->Args({100, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

/// CalculiX's best, C3D20R 20x20x8, on case A; and 700 such runs, extrapolated from three loads.
void calculix(benchmark::State& state) {
  const SensorDesign design = paperDesign();
  const std::array counts{static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                          static_cast<int>(state.range(2))};
  const std::vector<LoadCase> loads{caseA, {{{4, {-1, 0.5, -3}}}, {}}, {{{2, {0.2, -1, -1}}}, {}}};
  for (auto _ : state) {
    double seconds = 0;
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const bench::CalculixAnswer answer = bench::calculixBricks(design, counts, loads[i]);
      if (!answer.ran) {
        state.SkipWithError("ccx is not installed, or it failed");
        return;
      }
      seconds += answer.seconds;
      if (i > 0) continue;
      state.counters["error_percent"] = 100 * errorInCaseA(answer.upper_mm);
      state.SetIterationTime(answer.seconds);
    }
    state.counters["s_for_700_extrapolated_from_3"] = 700 * seconds / double(loads.size());
  }
}
BENCHMARK(calculix)->Args({20, 20, 8})->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(1);

/// Error of the nearly and the fully incompressible block against a mesh 1.6 times finer; the argument is the
/// compressibility 1 - 2 nu in millionths.
void poissonRatio(benchmark::State& state) {
  SensorDesign design = paperDesign();
  design.material.poissonRatio = 0.5 - double(state.range(0)) / 2e6;
  const double size = standardMeshSize_mm(design);
  const HyperelasticProblem fine(design, sensorMesh(design, {.meshSize_mm = size / 1.6, .mapped = {}}));
  const Eigen::Matrix3Xd truth = fine.electrodes(fine.solve(caseA).state()).upper_mm;
  const HyperelasticProblem problem(design, sensorMesh(design));
  for (auto _ : state) {
    const Solution s = problem.solve(caseA);
    state.counters["error_percent"] = 100 * (problem.electrodes(s.state()).upper_mm - truth).norm() / truth.norm();
    state.counters["iterations"] = s.iterations();
    state.counters["load_steps"] = double(s.increments.size() - 1);
  }
}
BENCHMARK(poissonRatio)
    ->Arg(20000)
    ->Arg(2000)
    ->Arg(200)
    ->Arg(2)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

/// Loads far beyond the paper's, on one area of the default mesh; the arguments are the force in N.
void bigLoad(benchmark::State& state) {
  const SensorDesign design = paperDesign();
  const HyperelasticProblem problem(design, sensorMesh(design));
  const LoadCase load{{{1, {double(state.range(0)), double(state.range(1)), double(state.range(2))}}}, {}};
  for (auto _ : state) {
    const Solution s = problem.solve(load, {.smallestStep = 0.01});
    state.counters["converged"] = s.converged;
    state.counters["load_fraction"] = s.reachedLoadFraction;
    state.counters["iterations"] = s.iterations();
    state.SetLabel(s.stopReason);
  }
}
BENCHMARK(bigLoad)
    ->Args({3, 3, -60})
    ->Args({0, 0, -150})
    ->Args({5, -5, -60})
    ->Args({10, -10, -120})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

/// Thin and tall blocks (height in mm) on the default mesh against a mesh 1.6 times finer, and the error's estimate.
void blockHeight(benchmark::State& state) {
  SensorDesign design = paperDesign();
  const double height = double(state.range(0));
  design.upper.z_mm = {{0.8 * height}};
  design.lower.z_mm = {{0.2 * height}};
  design.block_mm.z() = height;
  const LoadCase load{{{static_cast<int>(state.range(1)), {0, 1, -3}}}, {}};
  const double size = standardMeshSize_mm(design);
  const HyperelasticProblem fine(design, sensorMesh(design, {.meshSize_mm = size / 1.6, .mapped = {}}));
  const Eigen::Matrix3Xd truth = fine.electrodes(fine.solve(load).state()).upper_mm;
  for (auto _ : state) {
    const HyperelasticProblem problem(design, sensorMesh(design));
    const Solution s = problem.solve(load);
    const Eigen::Matrix3Xd difference = problem.electrodes(s.state()).upper_mm - truth;
    state.counters["error_percent"] = 100 * difference.norm() / truth.norm();
    state.counters["row_4_percent"] = 100 * difference.middleCols(40, 10).norm() / truth.middleCols(40, 10).norm();
    state.counters["estimate_percent"] = 100 * discretisationError(problem, load, s).relative.value();
  }
}
BENCHMARK(blockHeight)->ArgsProduct({{1, 5, 30}, {0, 4}})->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

/// Longest time from a request to stop to the return, over requests at random times of a solve and of a sampling; the
/// argument is the mesh size in percent of the default.
void cancel(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  const SensorDesign design = paperDesign();
  const double size = standardMeshSize_mm(design) * double(state.range(0)) / 100;
  std::vector<LoadCase> loads(700, caseA);
  for (std::size_t i = 0; i < loads.size(); ++i) loads[i].areas[0].area = static_cast<int>(i % 6);
  const auto solve = [&](const std::stop_token& stop) {
    const HyperelasticProblem problem(design, sensorMesh(design, {.meshSize_mm = size, .mapped = {}}));
    benchmark::DoNotOptimize(problem.solve(caseA, {}, {.step = {}, .stop = stop}));
  };
  const auto sample = [&](const std::stop_token& stop) {
    const HyperelasticProblem problem(design, sensorMesh(design, {.meshSize_mm = size, .mapped = {}}));
    BatchSolver batch(problem);
    benchmark::DoNotOptimize(batch.solve(loads, {}, stop));
  };
  std::mt19937 random(1);
  const auto longest = [&](const auto& work, double seconds) {
    double worst = 0;
    for (int trial = 0; trial < 20; ++trial) {
      std::stop_source stop;
      Clock::time_point asked;
      std::jthread asking([&, wait = std::uniform_real_distribution<double>(0, seconds)(random)] {
        std::this_thread::sleep_for(std::chrono::duration<double>(wait));
        asked = Clock::now();
        stop.request_stop();
      });
      work(stop.get_token());
      const Clock::time_point returned = Clock::now();
      asking.join();
      worst = std::max(worst, std::chrono::duration<double>(returned - asked).count());
    }
    return worst;
  };
  for (auto _ : state) {
    const Clock::time_point start = Clock::now();
    solve({});
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    state.counters["solve_s"] = longest(solve, seconds);
    state.counters["sample_s"] = longest(sample, 3 * seconds);
  }
}
BENCHMARK(cancel)->Arg(100)->Arg(55)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

/// Error of a harmonic displacement field on n x n x n cells of a cube, of tetrahedra: its order is the element's.
void convergence(benchmark::State& state) {
  constexpr double k = 3;
  const auto exact = [](const Eigen::Vector3d& x) {
    const double e = 1e-6 * std::exp(k * x.x() / std::sqrt(2.)), a = k * x.y(), b = k * x.z() / std::sqrt(2.);
    return Eigen::Vector3d(e * std::cos(a) * std::cosh(b) / std::sqrt(2.), -e * std::sin(a) * std::cosh(b),
                           e * std::cos(a) * std::sinh(b) / std::sqrt(2.));
  };
  const test::BoundaryValueProblem p(test::cubeTets(static_cast<int>(state.range(0)), 0), test::rubberOf(0.499),
                                     [&](const Eigen::Vector3d& x, int d) {
                                       const bool boundary = x.minCoeff() < 1e-9 || x.maxCoeff() > 1 - 1e-9;
                                       return boundary ? std::optional(exact(x)(d)) : std::nullopt;
                                     });
  for (auto _ : state) {
    const NewtonResult result = p.solve(1e-9);
    double error = 0, norm = 0;
    for (int i = 0; i < p.mesh.nodeCount(); ++i) {
      const Eigen::Vector3d truth = exact(p.mesh.nodes_mm.col(i));
      error += (result.increments.back().state.displacements.segment<3>(3 * i) - truth).squaredNorm();
      norm += truth.squaredNorm();
    }
    state.counters["error"] = std::sqrt(error / norm);
  }
}
BENCHMARK(convergence)->Arg(2)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

/// 100,000 answers from surrogates, from nothing; palp sample --surrogate writes them to a file as well.
void surrogates(benchmark::State& state) {
  const SensorDesign design = paperDesign();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> side(-1, 1), down(-6, 0);
  std::vector<LoadCase> loads;
  for (int i = 0; i < 100000; ++i) {
    const double x = side(random), y = side(random), z = down(random);
    loads.push_back({{{i % 6, {x, y, z}}}, {}});
  }
  for (auto _ : state) {
    const HyperelasticProblem problem(design, sensorMesh(design));
    BatchSolver batch(problem, {.relativeTolerance = 1e-6, .surrogate = true, .threads = 0});
    benchmark::DoNotOptimize(batch.solve(loads));
    state.counters["error_against_newton"] = batch.measuredError().value_or(0);
    state.counters["full_solves"] = double(batch.solves());
  }
}
BENCHMARK(surrogates)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

} // namespace

BENCHMARK_MAIN();
