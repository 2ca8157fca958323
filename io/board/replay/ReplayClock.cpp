#include "io/board/replay/ReplayClock.h"

#include "io/board/Protocol.h"

#include <algorithm>

namespace palp {

namespace {

constexpr double kLate_s = 0.25;     ///< later than this the host was suspended; below, the clocks' own jitter
constexpr double kInTime_s = 0.02;   ///< from here on reports come immediately again
constexpr double kMostLate_s = 10;   ///< later than this: the board's clock was stopped
constexpr double kClockDrift = 1e-4; ///< of two quartz clocks, at most

} // namespace

double ReplayClock::timeOf(const RecordingEntry& entry, const BoardInfo& info) {
  if (entry.kind == RecordingEntry::Kind::Raw) {
    const auto decoded = decodeInput(entry.bytes, info);
    if (const auto* readings = std::get_if<Readings>(&decoded)) follow(readings->deviceClock_us, entry.hostTime_s);
  } else if (entry.kind == RecordingEntry::Kind::Connected) {
    deviceClock_us_.reset();
    late_s_ = 0;
  }
  const double time_s = entry.hostTime_s - late_s_;
  last_s_ = any_ && late_s_ > 0 ? std::max(last_s_, time_s) : time_s;
  any_ = true;
  return last_s_;
}

void ReplayClock::follow(std::uint32_t deviceClock_us, double hostTime_s) {
  const auto step_us = deviceClock_us_ ? static_cast<std::int32_t>(deviceClock_us - *deviceClock_us_) : -1;
  deviceClock_us_ = deviceClock_us;
  if (step_us >= 0) device_s_ += 1e-6 * step_us;
  const double seen_s = hostTime_s - device_s_;
  if (step_us < 0 || seen_s - offset_s_ > kMostLate_s) { // the first, a board that restarted, or its clock was stopped
    offset_s_ = seen_s;
    late_s_ = 0;
    return;
  }
  offset_s_ = std::min(offset_s_ + kClockDrift * 1e-6 * step_us, seen_s);
  const double late_s = seen_s - offset_s_;
  late_s_ = late_s > (late_s_ > 0 ? kInTime_s : kLate_s) ? late_s : 0;
}

} // namespace palp
