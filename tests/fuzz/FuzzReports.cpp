// Fuzzing: any bytes as reports of a board. Complete frames hold finite resistances only.

#include "io/board/FrameAssembler.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace {

using namespace palp;

constexpr std::size_t kHead = 3;

/// Repairs what chance alone would hardly ever make (ID, version, checksum), where the input asks for it.
std::vector<std::uint8_t> reportOf(std::span<const std::uint8_t> piece) {
  std::vector<std::uint8_t> report(piece.begin() + 1, piece.end());
  if ((piece[0] & 1) == 0 || report.size() != kReportBytes) return report;
  Report sealed{};
  std::copy(report.begin(), report.end(), sealed.begin());
  sealed[0] = (piece[0] & 2) != 0 ? 0x02 : 0x01;
  sealed[1] = sealed[0] == 0x02 ? 0x01 : 0x10;
  seal(sealed);
  return {sealed.begin(), sealed.end()};
}

void require(bool holds) {
  if (!holds) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kHead) return 0;
  BoardInfo info;
  info.rowWires = 1 + data[0] % kMostRowWires;
  info.columnWires = 1 + data[1] % 255;
  BoardConfiguration configuration;
  configuration.rowMask = data[2] * 0x01010101U;
  FrameAssembler assembler(info, configuration);
  double time_s = 0;
  for (std::size_t at = kHead; at + 1 < size; at += kReportBytes + 1) {
    const auto piece = std::span(data, size).subspan(at, std::min(kReportBytes + 1, size - at));
    assembler.add(reportOf(piece), time_s += 1e-3, [](const BoardFrame& frame) {
      require(frame.resistances_ohm.allFinite() && frame.resistances_ohm.minCoeff() >= 0 &&
              std::isfinite(frame.time_s));
      wireFaults(frame);
    });
  }
  for (const auto& decoded : {decodeInfo(std::span(data, size)), decodeInfo(reportOf(std::span(data, size)))})
    if (const auto* found = std::get_if<BoardInfo>(&decoded)) require(found->rowWires <= kMostRowWires);
  decodeConfiguration(std::span(data, size));
  decodeCommand(std::span(data, size));
  return 0;
}
