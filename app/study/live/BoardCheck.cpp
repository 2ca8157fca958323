#include "app/study/live/BoardCheck.h"

#include "model/base/Text.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kRateTolerance = 0.02;

using Results = std::vector<BoardCheckResult>;

std::string rounded(double value) {
  return text(std::round(10 * value) / 10);
}

void none(Results& results, const std::string& what, std::uint64_t count) {
  results.push_back({what, count == 0, std::to_string(count)});
}

void checkInfo(Results& results, const BoardInfo& info) {
  results.push_back({"protocol 1", info.protocol >> 8 == 1,
                     std::to_string(info.protocol >> 8) + "." + std::to_string(info.protocol & 0xFF)});
  results.push_back({"1 to 32 row-wires, 1 to 255 column-wires",
                     info.rowWires <= kMostRowWires && info.columnWires >= 1,
                     std::to_string(info.rowWires) + " x " + std::to_string(info.columnWires)});
  results.push_back(
      {"electrodes on each wire", info.electrodesPerRowWire > 0 && info.electrodesPerColumnWire > 0,
       std::to_string(info.electrodesPerRowWire) + " and " + std::to_string(info.electrodesPerColumnWire)});
  results.push_back({"a serial number, for calibration to find its board", !info.serial.empty(), info.serial});
  results.push_back({"a model name", !info.model.empty(), info.model});
  results.push_back({"read-out, if the board reports it", true, // older boards do not
                     info.readout ? kReadouts.name(*info.readout) : "not reported"});
  results.push_back({"effective bits 12 to 24", info.effectiveBits >= 12 && info.effectiveBits <= 24,
                     std::to_string(info.effectiveBits)});
  results.push_back({"pitches and thickness above 0", info.pitchX_mm > 0 && info.pitchY_mm > 0 && info.thickness_mm > 0,
                     text(info.pitchX_mm) + ", " + text(info.pitchY_mm) + ", " + text(info.thickness_mm) + " mm"});
}

void checkStream(Results& results, const LiveStatus& status, double seconds) {
  const ReportCounts& counts = status.counts;
  const double wanted = status.configuration ? status.configuration->rate_Hz : 0;
  const double rate = static_cast<double>(counts.reports) / seconds;
  results.push_back({"reports per second as configured, to 2 %", std::abs(rate - wanted) <= kRateTolerance * wanted,
                     rounded(rate) + " of " + text(wanted)});
  none(results, "no report of wrong length, ID, checksum or range", counts.bad);
  none(results, "no gap in the sequence", counts.lost);
  none(results, "no report twice or out of order", counts.duplicates + counts.backwards);
  none(results, "no restart", counts.restarts);
  none(results, "no report of another configuration", counts.stale);
  none(results, "no frame that lacks a report", counts.incompleteFrames);
  results.push_back({"complete frames", counts.frames > counts.incompleteFrames, std::to_string(counts.frames)});
}

} // namespace

std::vector<BoardCheckResult> checkBoard(const LiveStatus& status, double seconds,
                                         const std::vector<std::uint8_t>& descriptor) {
  Results results;
  if (!descriptor.empty()) {
    const auto published = reportDescriptor();
    results.push_back({"the published report descriptor",
                       std::equal(descriptor.begin(), descriptor.end(), published.begin(), published.end()),
                       std::to_string(descriptor.size()) + " bytes"});
  }
  results.push_back({"a board that responds", status.info.has_value(),
                     status.info             ? status.source
                     : status.reason.empty() ? "none was found in this time"
                                             : status.reason});
  if (!status.info) return results;
  checkInfo(results, *status.info);
  checkStream(results, status, seconds);
  return results;
}

} // namespace palp
