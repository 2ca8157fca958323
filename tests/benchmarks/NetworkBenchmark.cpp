// Time and error of the networks, with scipy's time of the same work in the same run (counter `scipy_s`; absent where
// /usr/bin/python3 has no scipy).

#include "nn/LeaveOneOut.h"
#include "nn/RbfEvaluator.h"
#include "nn/RbfTrainer.h"
#include "nn/SpreadSweep.h"
#include "tests/nn/Touches.h"

#include <SourceDir.h>
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace palp {
namespace {

const test::Touches& training() {
  static const test::Touches set = test::touches(100, 30, 1);
  return set;
}

const test::Touches& fresh() {
  static const test::Touches set = test::touches(1667, 30, 2); // 10,002 samples
  return set;
}

/// Seconds that scipy needs, by case; measured once.
double scipySeconds(const std::string& key) {
  static const std::string json = [] {
    std::string text;
    if (FILE* pipe = popen("/usr/bin/python3 " PALP_SOURCE_DIR "/tests/benchmarks/scipy_reference.py --time", "r")) {
      char line[1024];
      while (std::fgets(line, sizeof line, pipe)) text += line;
      pclose(pipe);
    }
    return text;
  }();
  const std::size_t at = json.find("\"" + key + "\": ");
  return at == std::string::npos ? 0 : std::strtod(json.c_str() + at + key.size() + 4, nullptr);
}

RbfOptions atSpread(double spread) {
  RbfOptions options;
  options.spread = spread;
  return options;
}

double errorOf(const RbfNetwork& network) {
  return test::worstRelativeError(network.predict(fresh().samples), fresh().targets);
}

void fit600x30(benchmark::State& state) {
  RbfOptions options = atSpread(2);
  options.leaveOneOut = state.range(0) != 0;
  RbfFit fit;
  for (auto _ : state) fit = trainRbf(training().samples, training().targets, options);
  state.counters["error"] = errorOf(fit.network);
  state.counters["scipy_s"] = scipySeconds("fit_600x30_s");
}

void leaveOneOut40Spreads(benchmark::State& state) {
  const std::vector<double> spreads = logarithmicRange(0.3, 30, 40);
  double best = 0;
  for (auto _ : state) {
    const auto results = leaveOneOut(training().samples, training().targets, spreads, {});
    best = results.front().score;
    for (const LeaveOneOutResult& result : results) best = std::min(best, result.score);
  }
  state.counters["error"] = best;
  state.counters["scipy_s"] = scipySeconds("leave_one_out_40_spreads_s");
}

void predictOneByOne(benchmark::State& state) {
  const RbfNetwork network = trainRbf(training().samples, training().targets, atSpread(2)).network;
  const RbfEvaluator evaluator(network);
  std::vector<double> output(3), scratch(evaluator.scratchSize());
  Eigen::Index i = 0;
  for (auto _ : state) {
    evaluator.evaluate({fresh().samples.col(i).data(), 30}, output, scratch);
    benchmark::DoNotOptimize(output.data());
    i = (i + 1) % fresh().samples.cols();
  }
  state.counters["error"] = errorOf(network);
  state.counters["scipy_s"] = scipySeconds("predict_one_s");
}

void predictTenThousand(benchmark::State& state) {
  const RbfNetwork network = trainRbf(training().samples, training().targets, atSpread(2)).network;
  const RbfEvaluator evaluator(network);
  Eigen::MatrixXd output(3, fresh().samples.cols());
  for (auto _ : state) evaluator.evaluate(fresh().samples, output);
  state.counters["error"] = test::worstRelativeError(output, fresh().targets);
  state.counters["us_a_sample"] =
      benchmark::Counter(static_cast<double>(output.cols()) * static_cast<double>(state.iterations()) * 1e-6,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["scipy_s"] = scipySeconds("predict_10000_s");
}

/// 300 inputs as they are, and the few whitened components that stand above the noise.
void predictOneByOne300Inputs(benchmark::State& state) {
  const test::Touches wide = test::touches(100, 300, 1);
  RbfOptions options = atSpread(2);
  options.tail = Tail::LinearPenalised;
  if (state.range(0) != 0) {
    options.scaling = Scaling::Whiten;
    options.relativeInputNoise = 1e-4;
    options.ridge = 1e-6;
    options.method = LeastSquaresMethod::Cholesky;
  }
  const RbfNetwork network = trainRbf(wide.samples, wide.targets, options).network;
  const RbfEvaluator evaluator(network);
  std::vector<double> output(3), scratch(evaluator.scratchSize());
  for (auto _ : state) {
    evaluator.evaluate({wide.samples.data(), 300}, output, scratch);
    benchmark::DoNotOptimize(output.data());
  }
  state.counters["dimensions"] = static_cast<double>(network.scaler.dimensions());
}

BENCHMARK(fit600x30)->Arg(0)->Arg(1)->ArgName("leave_one_out")->Unit(benchmark::kMillisecond);
BENCHMARK(leaveOneOut40Spreads)->Unit(benchmark::kMillisecond);
BENCHMARK(predictOneByOne)->Unit(benchmark::kMicrosecond);
BENCHMARK(predictTenThousand)->Unit(benchmark::kMillisecond);
BENCHMARK(predictOneByOne300Inputs)->Arg(0)->Arg(1)->ArgName("whitened")->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace palp

BENCHMARK_MAIN();
