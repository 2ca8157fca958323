#pragma once

#include "io/board/FrameAssembler.h"
#include "io/board/VirtualBoard.h"

#include <vector>

namespace palp {

/// A board of 3 row-wires and 32 column-wires (three reports a row-wire, the last with two readings), without noise, at
/// 1000 reports/s.
inline BoardSettings smallBoard() {
  BoardSettings settings;
  settings.info.rowWires = 3;
  settings.info.columnWires = 32;
  settings.info.serial = "SMALL-1";
  settings.info.model = "SMALL";
  settings.configuration.rowMask = 0b111;
  settings.disturbance.noise = 0;
  return settings;
}

/// Resistances that tell their place: 300 + 10 row + column / 100 [ohm].
inline Eigen::MatrixXd placeResistances(int rows = 3, int columns = 32) {
  Eigen::MatrixXd resistances(rows, columns);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) resistances(r, c) = 300 + 10 * r + c / 100.0;
  return resistances;
}

inline VirtualBoard boardWith(const BoardSettings& settings) {
  return {settings,
          [resistances = placeResistances(settings.info.rowWires, settings.info.columnWires)](
              double) -> const Eigen::MatrixXd& { return resistances; }};
}

using Bytes = std::vector<std::uint8_t>;

/// The first reports of a board on a virtual clock.
inline std::vector<Bytes> reportsOf(VirtualBoard& board, std::size_t count, std::uint64_t start_us = 1000) {
  std::vector<Bytes> reports;
  for (std::uint64_t clock_us = start_us; reports.size() < count; clock_us += 100)
    board.advance(clock_us, [&](std::span<const std::uint8_t> bytes) {
      if (reports.size() < count) reports.emplace_back(bytes.begin(), bytes.end());
    });
  return reports;
}

/// All frames that the reports make.
inline std::vector<BoardFrame> framesOf(FrameAssembler& assembler, const std::vector<Bytes>& reports) {
  std::vector<BoardFrame> frames;
  double time_s = 0;
  for (const Bytes& report : reports)
    assembler.add(report, time_s += 1e-3, [&](const BoardFrame& frame) { frames.push_back(frame); });
  return frames;
}

} // namespace palp
