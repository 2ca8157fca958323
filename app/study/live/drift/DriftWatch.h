#pragma once

// Private to LiveSession.

#include "app/study/live/LiveSession.h"
#include "app/study/live/drift/DriftMonitor.h"

#include <deque>
#include <utility>

namespace palp {

/// Judges the drift of the sensor at rest: the force it reads as, its pace, and whether a tare would help.
class DriftWatch {
public:
  /// Takes a frame at a time of the host's clock, and twice a second writes what is known of the drift to the status. A
  /// frame without a force, a tare that is being taken, and no network (null) begin anew.
  void judge(const LiveFrame& live, const ForceDecoder* decoder, double now_s, LiveStatus& status);
  /// What follows is of another place of the recording.
  void restart() { monitor_.restart(); }
  /// The sensor was tared: the pace before is discarded.
  void forgetPace() { seen_.clear(); }
  /// Another network decodes: nothing is known.
  void forget(LiveStatus& status);

private:
  void judgePace(double time_s, const ForceDecoder& decoder, LiveStatus& status);

  DriftMonitor monitor_;
  std::deque<std::pair<double, double>> seen_; ///< board's time, drift
  double judged_s_ = 0;                        ///< host's clock
};

} // namespace palp
