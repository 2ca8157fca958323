// Sample files by format: time to write and to read 100,000 samples of 604 numbers, beside the size and the deviation
// of what was read.

#include "io/SampleFile.h"

#include <SourceDir.h>
#include <benchmark/benchmark.h>

#include <array>
#include <filesystem>

namespace palp {
namespace {

namespace fs = std::filesystem;

constexpr std::array kEndings{".csv", ".h5", ".npz"};

/// 100,000 samples: those of the virtual board again and again, each time with other low digits; their resistances
/// stand for displacements too.
SampleSet manySamples() {
  SampleSet few = loadSamples(PALP_SOURCE_DIR "/resources/board/paper-samples.csv");
  few.displacements_mm = 1e-3 * few.resistances_ohm;
  SampleSet all = few;
  const Eigen::Index count = 100'000;
  all.area = few.area.replicate(count / few.size() + 1, 1).topRows(count);
  for (const auto values : {&SampleSet::forces_N, &SampleSet::displacements_mm, &SampleSet::resistances_ohm}) {
    (all.*values).resize((few.*values).rows(), count);
    for (Eigen::Index i = 0; i < count; ++i)
      (all.*values).col(i) = (few.*values).col(i % few.size()) * (1 + 1e-6 * static_cast<double>(i));
  }
  return all;
}

const SampleSet& samples() {
  static const SampleSet all = manySamples();
  return all;
}

fs::path fileOf(std::int64_t format) {
  return fs::temp_directory_path() / (std::string("palp-samples") + kEndings[static_cast<std::size_t>(format)]);
}

void write(benchmark::State& state) {
  const SampleSet& all = samples();
  for (auto _ : state) saveSamples(fileOf(state.range(0)), all, true);
  state.counters["samples"] = static_cast<double>(all.size());
  state.counters["MB"] = static_cast<double>(fs::file_size(fileOf(state.range(0)))) / 1e6;
  state.SetLabel(kEndings[static_cast<std::size_t>(state.range(0))]);
}

void read(benchmark::State& state) {
  const SampleSet& all = samples();
  double error = 0;
  for (auto _ : state) {
    const SampleSet back = loadSamples(fileOf(state.range(0)));
    state.PauseTiming();
    error = (back.resistances_ohm - all.resistances_ohm).cwiseAbs().maxCoeff();
    state.ResumeTiming();
  }
  state.counters["error"] = error;
  state.SetLabel(kEndings[static_cast<std::size_t>(state.range(0))]);
  fs::remove(fileOf(state.range(0)));
}

BENCHMARK(write)
    ->Arg(0)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(2);
BENCHMARK(read)
    ->Arg(0)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(2);

} // namespace
} // namespace palp

BENCHMARK_MAIN();
