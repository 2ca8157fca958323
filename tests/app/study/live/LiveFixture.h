#pragma once

#include "app/study/decoding/DecoderTraining.h"
#include "app/study/decoding/TrainOptions.h"
#include "app/study/live/ForceDecoder.h"
#include "app/study/live/SimulatedTouch.h"
#include "io/SampleFile.h"
#include "io/board/FrameAssembler.h"

#include <SourceDir.h>
#include <filesystem>
#include <random>

namespace palp {

/// Solved samples of the paper's design that ship with Palp.
inline const SampleSet& shippedSamples() {
  static const SampleSet samples =
      loadSamples(std::filesystem::path(PALP_SOURCE_DIR) / "resources" / "board" / "paper-samples.csv");
  return samples;
}

/// More of the same, by the polynomials through them.
inline SampleSet manySamples(int perArea) {
  const SimulatedTouch touch(shippedSamples());
  SampleSet set = shippedSamples();
  const int size = perArea * set.areaCount;
  set.area.resize(size);
  set.forces_N.resize(3, size);
  set.displacements_mm.resize(0, size);
  set.resistances_ohm.resize(set.resistances_ohm.rows(), size);
  std::mt19937_64 engine(9);
  std::uniform_real_distribution<double> side(-1, 1);
  for (int i = 0; i < size; ++i) {
    const SimulatedTouch::Truth truth{i % set.areaCount, {side(engine), side(engine), 3 * side(engine) - 3}};
    set.area(i) = truth.area;
    set.forces_N.col(i) = truth.force_N;
    set.resistances_ohm.col(i) = touch.resistances_ohm(truth).reshaped<Eigen::RowMajor>();
  }
  return set;
}

/// A network for live use: all rows, trained for this noise.
inline Decoder liveDecoder(double noise, DecoderKind kind = DecoderKind::MaximumLikelihood) {
  TrainOptions options;
  options.input = InputKind::Resistance;
  options.rows = "all";
  options.noise = noise;
  options.decoder = kind;
  return trainDecoder(manySamples(100), nullptr, options);
}

/// Frames of a virtual board on a clock of its own, as fast as they can be made.
class VirtualStream {
public:
  VirtualStream(VirtualBoard board, const BoardConfiguration& configuration)
      : board_(std::move(board)), assembler_(board_.info(), configuration) {}

  template <class Take> void run(std::uint64_t frames, const Take& take) {
    const std::uint64_t end = assembler_.counts().frames + frames;
    while (assembler_.counts().frames < end) {
      clock_us_ += 1000;
      board_.advance(clock_us_, [&](std::span<const std::uint8_t> report) {
        assembler_.add(report, 1e-6 * static_cast<double>(clock_us_), take);
      });
    }
  }
  VirtualBoard& board() { return board_; }

private:
  VirtualBoard board_;
  FrameAssembler assembler_;
  std::uint64_t clock_us_ = 0;
};

} // namespace palp
