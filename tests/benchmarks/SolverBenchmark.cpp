// Error against time of the solver, CalculiX beside it where ccx is installed. The error is that of row-wire 4 in case
// A of tests/reference/converged.json.
#include "solver/BatchSolver.h"
#include "solver/CalculixDeck.h"
#include "solver/SensorMesh.h"

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

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
    state.counters["iterations"] = double(solution.newton.size() - 1);
  }
}
BENCHMARK(oneLoad)->Arg(200)->Arg(150)->Arg(100)->Arg(60)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

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
    state.counters["error_against_newton"] = batch.measuredError();
    const std::vector<LoadCase> one{caseA};
    state.counters["mesh_error_percent"] = 100 * errorInCaseA(batch.solve(one)[0].upper_mm);
    state.counters["dof"] = problem.dof();
  }
}
BENCHMARK(sevenHundredSamples)
    ->Args({200, 0})
    ->Args({100, 0})
    ->Args({100, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

/// CalculiX with C3D10 on our mesh, input reading included; 700 runs would take 700 times as long (extrapolated).
void calculix(benchmark::State& state) {
  if (std::system("command -v ccx > /dev/null") != 0) {
    state.SkipWithError("ccx is not installed");
    return;
  }
  const SensorDesign design = paperDesign();
  const double size = standardMeshSize_mm(design) * double(state.range(0)) / 100;
  const Mesh mesh = sensorMesh(design, {.meshSize_mm = size, .mapped = {}});
  const auto folder = std::filesystem::temp_directory_path() / "palp-benchmark";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "deck.inp") << calculixDeck(design, mesh, caseA);
  const std::string command = "cd '" + folder.string() + "' && OMP_NUM_THREADS=2 ccx deck > ccx.log 2>&1";
  for (auto _ : state)
    if (std::system(command.c_str()) != 0) state.SkipWithError("ccx failed");
  std::map<int, Eigen::Vector3d> printed;
  std::ifstream results(folder / "deck.dat");
  for (std::string line; std::getline(results, line);) {
    std::istringstream numbers(line);
    int node = 0;
    Eigen::Vector3d u;
    if (numbers >> node >> u.x() >> u.y() >> u.z()) printed[node] = u;
  }
  Eigen::Matrix3Xd upper(3, static_cast<Eigen::Index>(mesh.upperElectrodeNodes.size()));
  for (Eigen::Index i = 0; i < upper.cols(); ++i) upper.col(i) = printed[mesh.upperElectrodeNodes[i] + 1];
  state.counters["error_percent"] = 100 * errorInCaseA(upper);
  state.counters["nodes"] = mesh.nodeCount();
  std::filesystem::remove_all(folder);
}
BENCHMARK(calculix)->Arg(200)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

} // namespace

BENCHMARK_MAIN();
