// The live path on the simulated board, printed as a table.
//   live_benchmark [latency [SECONDS]]       report to force, 1000 and 8000 reports/s, all rows, 600 centres
//   live_benchmark memory [SECONDS [RATE]]   resident memory each 10 s (default 600 s at 8000 reports/s)
//   live_benchmark coverage                  forces against the truth, by network, noise and tare
//   live_benchmark missing                   forces against the truth and time, by the number of missing column-wires

#include "app/study/live/LiveHistory.h"
#include "app/study/live/LiveSource.h"
#include "io/DecoderFile.h"
#include "tests/app/study/live/LiveFixture.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace palp {
namespace {

constexpr double kGoodNoise = 5e-6;
constexpr double kPlainNoise = 1e-4;

double residentMB() {
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

LiveOptions simulated(int rate_Hz, Decoder decoder) {
  LiveOptions options;
  options.decoder = std::move(decoder);
  options.tareFrames = 50;
  options.open = [rate_Hz] {
    SimulatedBoardOptions board;
    board.rate_Hz = rate_Hz;
    return openSimulatedBoard(board);
  };
  return options;
}

/// Drains as the window does.
void run(LiveSession& live, double seconds, LiveHistory& history) {
  const double end_s = hostClock_s() + seconds;
  while (hostClock_s() < end_s) {
    for (auto& frame : live.drain()) history.add(std::move(frame));
    std::this_thread::sleep_for(std::chrono::milliseconds(33));
  }
}

void latency(double seconds) {
  std::printf("%-9s %10s %10s %8s %6s %6s   %-26s %-26s %8s\n", "network", "reports/s", "measured", "frames", "lost",
              "bad", "report to force [ms]", "board to force [ms]", "CPU [%]");
  for (const DecoderKind kind : {DecoderKind::Rbf, DecoderKind::MaximumLikelihood}) {
    const Decoder decoder = liveDecoder(kGoodNoise, kind);
    for (const int rate_Hz : {1000, 8000}) {
      LiveHistory history;
      LiveSession live(simulated(rate_Hz, decoder));
      run(live, 1, history);
      const double cpuBefore_s = cpu_s();
      run(live, seconds, history);
      const double cpu_percent = 100 * (cpu_s() - cpuBefore_s) / seconds;
      const LiveStatus s = live.status();
      std::printf("%-9s %10d %10.1f %8llu %6llu %6llu   %6.3f %6.3f %8.3f     %6.3f %6.3f %8.3f   %8.1f\n",
                  name(kind).c_str(), rate_Hz, s.reportsPerSecond, static_cast<unsigned long long>(s.counts.frames),
                  static_cast<unsigned long long>(s.counts.lost), static_cast<unsigned long long>(s.counts.bad),
                  1e3 * s.decoding.p50_s, 1e3 * s.decoding.p99_s, 1e3 * s.decoding.longest_s, 1e3 * s.latency.p50_s,
                  1e3 * s.latency.p99_s, 1e3 * s.latency.longest_s, cpu_percent);
    }
    if (kind == DecoderKind::Rbf)
      std::printf("(rbf: %d centres, all rows; columns p50, p99, max)\n", decoder.report.centers);
  }
}

void memory(double seconds, int rate_Hz) {
  LiveHistory history;
  LiveSession live(simulated(rate_Hz, readNetwork(shippedNetwork())));
  std::printf("%8s %10s %12s %8s %8s\n", "t [s]", "RSS [MB]", "reports", "lost", "overflow");
  const double start_s = hostClock_s();
  while (hostClock_s() - start_s < seconds) {
    run(live, std::min(10.0, seconds), history);
    const LiveStatus s = live.status();
    std::printf("%8.0f %10.1f %12llu %8llu %8llu\n", hostClock_s() - start_s, residentMB(),
                static_cast<unsigned long long>(s.counts.reports), static_cast<unsigned long long>(s.counts.lost),
                static_cast<unsigned long long>(s.overflowed));
    std::fflush(stdout);
  }
  std::printf("CPU: %.1f %% of a core\n", 100 * cpu_s() / (hostClock_s() - start_s));
}

void cover(const std::string& what, const Decoder& decoder, double noise, int tareFrames) {
  BoardDisturbance disturbance;
  disturbance.noise = noise;
  VirtualBoard board = simulatedBoard(shippedSamples(), disturbance, 1000, 11);
  const BoardConfiguration configuration = board.configuration();
  VirtualStream stream(std::move(board), configuration);
  ForceDecoder live(decoder, stream.board().info(), paperDesign());
  if (tareFrames > 0) live.startTare(tareFrames);
  const SimulatedTouch touch(shippedSamples());
  Eigen::Array3d within = Eigen::Array3d::Zero();
  Eigen::Array3d square = Eigen::Array3d::Zero();
  int frames = 0, rest = 0, restShown = 0;
  stream.run(3000, [&](const BoardFrame& frame) {
    const DecodedForces forces = live.decode(frame);
    if (live.taring() || !forces.valid) return;
    const SimulatedTouch::Truth truth = touch.truth(frame.time_s);
    const Eigen::Array3d error = (forces.forces_N.col(0) - truth.force_N).array();
    within += (error.abs() <= 3 * forces.standardDeviation_N.col(0).array()).cast<double>();
    square += error.square();
    ++frames;
    if (truth.force_N.norm() > 0) return;
    ++rest;
    restShown += forces.shown[0] ? 1 : 0;
  });
  const Eigen::Array3d percent = 100 * within / frames;
  const Eigen::Array3d rms = (square / frames).sqrt();
  std::printf("%-10s %8.0e %6d %8d   %6.2f %6.2f %6.2f     %8.5f %8.5f %8.5f   %5d of %d\n", what.c_str(), noise,
              tareFrames, frames, percent.x(), percent.y(), percent.z(), rms.x(), rms.y(), rms.z(), restShown, rest);
}

void coverage() {
  std::printf("%-10s %8s %6s %8s   %-20s     %-26s   %s\n", "network", "noise", "tare", "frames",
              "within 3 sd [%] x y z", "rms error [N] x y z", "arrows at rest");
  for (const double noise : {kGoodNoise, kPlainNoise})
    for (const int tareFrames : {0, 50}) {
      cover("shipped", readNetwork(shippedNetwork()), noise, tareFrames);
      for (const DecoderKind kind : {DecoderKind::MaximumLikelihood, DecoderKind::Rbf})
        cover(name(kind), liveDecoder(noise, kind), noise, tareFrames);
    }
}

/// Errors and stated deviations [N], all components together, and time a frame, without so many column-wires.
void decodeWithout(const std::string& what, const Decoder& decoder, double noise, int missing, int dropEvery) {
  BoardDisturbance disturbance;
  disturbance.noise = noise;
  VirtualBoard board = simulatedBoard(shippedSamples(), disturbance, 1000, 21);
  for (int k = 0; k < missing; ++k) board.faults().openColumns.push_back((7 + 11 * k) % 30);
  board.faults().dropEvery = dropEvery;
  const BoardConfiguration configuration = board.configuration();
  VirtualStream stream(std::move(board), configuration);
  ForceDecoder live(decoder, stream.board().info(), paperDesign());
  const SimulatedTouch touch(shippedSamples());
  double square = 0, variance = 0, within = 0, first_s = 0;
  int frames = 0, valid = 0;
  double decoding_s = 0;
  stream.run(600, [&](const BoardFrame& frame) {
    ++frames;
    const double start_s = hostClock_s();
    const DecodedForces forces = live.decode(frame);
    const double took_s = hostClock_s() - start_s;
    decoding_s += took_s;
    first_s = std::max(first_s, took_s);
    if (!forces.valid) return;
    ++valid;
    const Eigen::Array3d error = (forces.forces_N.col(0) - touch.truth(frame.time_s).force_N).array();
    square += error.square().sum();
    variance += forces.standardDeviation_N.squaredNorm();
    within += (error.abs() <= 3 * forces.standardDeviation_N.col(0).array()).cast<double>().sum();
  });
  const double count = std::max(1, 3 * valid);
  std::printf("%-8s %8.0e %8d %6d %6d of %d   %9.5f %9.5f %8.2f   %8.3f %8.3f\n", what.c_str(), noise, missing,
              dropEvery, valid, frames, std::sqrt(square / count), std::sqrt(variance / count), 100 * within / count,
              1e3 * decoding_s / frames, 1e3 * first_s);
}

void missing() {
  std::printf("%-8s %8s %8s %6s %13s   %9s %9s %8s   %8s %8s\n", "network", "noise", "columns", "lost", "with forces",
              "error [N]", "sd [N]", "3 sd [%]", "mean ms", "most ms");
  for (const DecoderKind kind : {DecoderKind::MaximumLikelihood, DecoderKind::Rbf}) {
    const Decoder decoder = liveDecoder(kPlainNoise, kind);
    for (const int columns : {0, 1, 2, 5, 10, 15}) decodeWithout(name(kind), decoder, kPlainNoise, columns, 0);
    for (const int every : {20, 7}) decodeWithout(name(kind), decoder, kPlainNoise, 0, every);
  }
}

} // namespace
} // namespace palp

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "latency";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 0;
  if (what == "latency") {
    palp::latency(seconds > 0 ? seconds : 10);
  } else if (what == "memory") {
    palp::memory(seconds > 0 ? seconds : 600, argc > 3 ? std::atoi(argv[3]) : 8000);
  } else if (what == "coverage") {
    palp::coverage();
  } else if (what == "missing") {
    palp::missing();
  } else {
    std::fprintf(stderr, "live_benchmark: '%s'; allowed is latency, memory, coverage or missing\n", what.c_str());
    return 2;
  }
  return 0;
}
