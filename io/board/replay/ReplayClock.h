#pragma once

#include "io/board/Recording.h"

namespace palp {

/// When what a recording holds was measured, by the host's clock. A suspended host got its reports late and many
/// together: those that came more than a quarter of a second late by the board's clock take their time from that.
class ReplayClock {
public:
  /// Of the next entry.
  [[nodiscard]] double timeOf(const RecordingEntry& entry, const BoardInfo& info);

private:
  void follow(std::uint32_t deviceClock_us, double hostTime_s);

  std::optional<std::uint32_t> deviceClock_us_; ///< of the last report
  double device_s_ = 0;                         ///< that clock without its wraps
  double offset_s_ = 0;                         ///< host's clock minus the board's, where reports come immediately
  double late_s_ = 0;                           ///< that is taken off the last report's time
  double last_s_ = 0;                           ///< time of the last entry
  bool any_ = false;
};

} // namespace palp
