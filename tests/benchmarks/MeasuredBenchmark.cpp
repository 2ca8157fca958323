// Cost of what measured rows need: errors with groups of rows left out against single rows left out, and a memory's
// states for one frame.

#include "nn/LeaveOneOut.h"
#include "nn/measured/GroupRidge.h"
#include "nn/measured/InputStage.h"
#include "nn/measured/MeasuredFeatures.h"
#include "nn/measured/RowDependence.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace palp {
namespace {

constexpr Eigen::Index kRows = 5500, kReadings = 12;
constexpr double kSpreads[] = {0.5, 1, 2, 4}; // the work is the same at each

/// Smooth readings of three slow forces, with noise.
const MeasuredRows& record() {
  static const MeasuredRows rows = [] {
    MeasuredRows made{Eigen::MatrixXd(kRows, kReadings), Eigen::MatrixXd(kRows, 3), {}, Eigen::VectorXi::Zero(kRows)};
    std::mt19937 engine(1);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd answer(3, kReadings);
    for (double& value : answer.reshaped()) value = normal(engine);
    for (Eigen::Index i = 0; i < kRows; ++i) {
      const auto t = static_cast<double>(i);
      made.targets.row(i) << std::sin(0.011 * t), std::cos(0.017 * t), std::sin(0.003 * t) - 1;
      made.readings.row(i) = (made.targets.row(i) * answer).array().tanh();
      for (double& value : made.readings.row(i)) value += 0.01 * normal(engine);
    }
    return made;
  }();
  return rows;
}

void groupsLeftOut(benchmark::State& state) {
  const MeasuredRows& rows = record();
  const Eigen::MatrixXd inputs = rows.readings.transpose();
  const Eigen::MatrixXd scaled = inputScaler(inputs, kReadings).apply(inputs);
  std::vector<double> lambdas;
  for (int exponent = -11; exponent <= 0; ++exponent) lambdas.push_back(std::pow(10.0, exponent));
  double error = 0;
  for (auto _ : state)
    for (const double spread : kSpreads) {
      const Features features = featuresOf(scaled, spread, 300, 1);
      const auto errors =
          GroupRidge(features.at(scaled), rows.targets).errors(foldsFor(rows, RowOrder::Time), lambdas, {});
      error = errors[4].norm() / rows.targets.norm();
    }
  state.counters["error"] = error;
}

/// Of trainRbf's choice of a spread, with every row a centre.
void singleRowsLeftOut(benchmark::State& state) {
  RbfOptions options;
  options.ridge = 1e-6;
  double error = 0;
  for (auto _ : state)
    error = leaveOneOut(record().readings.transpose(), record().targets.transpose(),
                        {std::begin(kSpreads), std::end(kSpreads)}, options)
                .back()
                .score;
  state.counters["error"] = error;
}

void memoryOfOneFrame(benchmark::State& state) {
  MemoryStates states({0.1, 0.4, 1.6, 6.4});
  const Eigen::VectorXd readings = Eigen::VectorXd::Random(300);
  double time_s = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(states.next(time_s, readings).data());
    time_s += 0.01;
  }
}

BENCHMARK(groupsLeftOut)->Unit(benchmark::kMillisecond);
BENCHMARK(singleRowsLeftOut)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(memoryOfOneFrame)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace palp

BENCHMARK_MAIN();
