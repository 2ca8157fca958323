#include "io/board/FrameAssembler.h"

#include <algorithm>
#include <bit>

namespace palp {

namespace {

constexpr int kReorderedReports = 64; // the kernel's queue
constexpr std::int32_t kReorderedClock_us = 1'000'000;
constexpr double kSecondsPerMicrosecond = 1e-6;

int reportsPerRow(const BoardInfo& info) {
  return (info.columnWires + kReadingsPerReport - 1) / kReadingsPerReport;
}

std::vector<bool> expectedRows(const BoardInfo& info, const BoardConfiguration& configuration) {
  std::vector<bool> rows(static_cast<std::size_t>(info.rowWires));
  const bool single = configuration.mode == BoardMode::SingleRow;
  for (int row = 0; row < info.rowWires; ++row) {
    const bool inMask = (configuration.rowMask >> row & 1) != 0;
    rows[static_cast<std::size_t>(row)] = single ? row == std::countr_zero(configuration.rowMask) : inMask;
  }
  return rows;
}

} // namespace

FrameAssembler::FrameAssembler(BoardInfo info, const BoardConfiguration& configuration) : info_(std::move(info)) {
  frame_.resistances_ohm.resize(info_.rowWires, info_.columnWires);
  frame_.state.resize(info_.rowWires, info_.columnWires);
  setConfiguration(configuration);
}

void FrameAssembler::setConfiguration(const BoardConfiguration& configuration) {
  configuration_ = configuration;
  frame_.rowExpected = expectedRows(info_, configuration);
  open_ = false;
  staleInARow_ = 0;
}

void FrameAssembler::restart() {
  forget();
  joins_ = true;
  joined_.reset();
}

void FrameAssembler::forget() {
  last_.reset();
  open_ = false;
}

bool FrameAssembler::belongsToHalf(const Readings& readings) {
  if (!joins_) return false;
  const auto first = std::find(frame_.rowExpected.begin(), frame_.rowExpected.end(), true);
  const bool begins = readings.rowWire == first - frame_.rowExpected.begin() && readings.firstColumn == 0;
  if (!begins && (!joined_ || *joined_ == readings.frame)) {
    joined_ = readings.frame;
    return true;
  }
  joins_ = false;
  return false;
}

std::variant<Readings, BoardEvent, ReportFault> FrameAssembler::add(std::span<const std::uint8_t> report,
                                                                    double hostTime_s, const TakeFrame& take) {
  ++counts_.reports;
  std::variant<Readings, BoardEvent, ReportFault> decoded = decodeInput(report, info_);
  if (std::holds_alternative<ReportFault>(decoded)) ++counts_.bad;
  if (const auto* readings = std::get_if<Readings>(&decoded); readings && follows(*readings, hostTime_s))
    addReadings(*readings, hostTime_s, take);
  return decoded;
}

/// Position of the report after the last one; false where it must be dropped.
bool FrameAssembler::follows(const Readings& readings, double hostTime_s) {
  if (last_) {
    const auto sequenceStep = static_cast<std::uint16_t>(readings.sequence - last_->sequence);
    const auto clockStep_us = static_cast<std::int32_t>(readings.deviceClock_us - last_->deviceClock_us);
    if (sequenceStep == 0 && clockStep_us == 0) {
      ++counts_.duplicates;
      return false;
    }
    const bool slightlyOlder = sequenceStep > 0xFFFF - kReorderedReports;
    if (clockStep_us < 0 && clockStep_us > -kReorderedClock_us && slightlyOlder) {
      ++counts_.backwards;
      return false;
    }
    if (clockStep_us < 0) { // the clock began anew: so did the board
      ++counts_.restarts;
      forget();
      restarted_ = true;
    } else {
      counts_.lost += static_cast<std::uint16_t>(sequenceStep - 1);
      clock_us_ += static_cast<std::uint32_t>(clockStep_us);
    }
  }
  if (!last_ && lastHostTime_s_) // only the host's clock has the length of a pause
    clock_us_ += static_cast<std::uint64_t>(std::max(0.0, hostTime_s - *lastHostTime_s_) / kSecondsPerMicrosecond);
  last_ = readings;
  lastHostTime_s_ = hostTime_s;
  const bool expected = frame_.rowExpected[static_cast<std::size_t>(readings.rowWire)];
  if (readings.generation != (configuration_.generation & 0xF) || !expected) {
    ++counts_.stale;
    ++staleInARow_;
    return false;
  }
  staleInARow_ = 0;
  return true;
}

void FrameAssembler::addReadings(const Readings& readings, double hostTime_s, const TakeFrame& take) {
  if (open_ && readings.frame != frame_.number) endFrame(take);
  if (belongsToHalf(readings)) return;
  if (!open_) beginFrame(readings);
  frame_.hostTime_s = hostTime_s;
  frame_.endTime_s = static_cast<double>(clock_us_) * kSecondsPerMicrosecond;
  place(readings);
  if (missingReports_ == 0) endFrame(take);
}

void FrameAssembler::beginFrame(const Readings& readings) {
  open_ = true;
  frame_.number = readings.frame;
  frame_.time_s = static_cast<double>(clock_us_) * kSecondsPerMicrosecond;
  frame_.resistances_ohm.setZero();
  frame_.state.setConstant(ReadingState::Missing);
  frame_.flags = 0;
  frame_.temperature_degC.reset();
  frame_.restarted = restarted_;
  restarted_ = false;
  placed_.assign(static_cast<std::size_t>(info_.rowWires) * static_cast<std::size_t>(reportsPerRow(info_)), false);
  missingReports_ = 0;
  for (const bool expected : frame_.rowExpected) missingReports_ += expected ? reportsPerRow(info_) : 0;
}

void FrameAssembler::place(const Readings& readings) {
  const double reference_ohm = info_.reference_ohm[static_cast<std::size_t>(readings.rangeIndex)];
  for (int i = 0; i < readings.count; ++i) {
    const DecodedReading reading = decodeCode(readings.codes[static_cast<std::size_t>(i)], reference_ohm);
    frame_.resistances_ohm(readings.rowWire, readings.firstColumn + i) = reading.resistance_ohm;
    frame_.state(readings.rowWire, readings.firstColumn + i) = reading.state;
  }
  frame_.flags |= readings.flags;
  if (readings.temperature_degC) frame_.temperature_degC = readings.temperature_degC;
  const int slot = readings.rowWire * reportsPerRow(info_) + readings.firstColumn / kReadingsPerReport;
  const int full = std::min(kReadingsPerReport, info_.columnWires - readings.firstColumn);
  if (readings.count == full && !placed_[static_cast<std::size_t>(slot)]) --missingReports_;
  placed_[static_cast<std::size_t>(slot)] = true;
}

void FrameAssembler::endFrame(const TakeFrame& take) {
  frame_.complete = missingReports_ == 0;
  open_ = false;
  ++counts_.frames;
  if (!frame_.complete) ++counts_.incompleteFrames;
  take(frame_);
}

} // namespace palp
