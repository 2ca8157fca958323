#include "app/study/live/drift/DriftWatch.h"

namespace palp {

namespace {

constexpr double kPaceOver_s = 10;       // that its pace is taken from
constexpr double kDriftGap_s = 3;        // without frames, after which a drift is looked for anew
constexpr double kDriftInterval_s = 0.5; // between two looks at what the drift reads as
constexpr double kDriftShare = 0.01;     // of the force range, from which a tare is suggested
constexpr double kSteadier = 0.7;        // of the steady pace: a drift below is steady from there

} // namespace

void DriftWatch::forget(LiveStatus& status) {
  restart();
  forgetPace();
  status.drift.reset();
  status.tareSuggested = status.driftsOn = false;
}

void DriftWatch::judge(const LiveFrame& live, const ForceDecoder* decoder, double now_s, LiveStatus& status) {
  if (decoder == nullptr || !live.forces.valid || decoder->taring()) return restart();
  if (now_s > judged_s_ + kDriftGap_s) { // nobody looked meanwhile: what was known is of another time
    restart();
    forgetPace();
  }
  monitor_.add(live.change, decoder->noise(), live.frame.time_s);
  if (now_s < judged_s_ + kDriftInterval_s) return;
  judged_s_ = now_s;
  status.drift = monitor_.drift();
  status.driftForce_N = status.drift ? decoder->drifted_N(*status.drift).norm() : 0;
  status.tareSuggested = status.driftForce_N > kDriftShare * decoder->range_N();
  judgePace(live.frame.time_s, *decoder, status);
}

/// Waits while the drift is so fast that a tare now would be needed again within a minute.
void DriftWatch::judgePace(double time_s, const ForceDecoder& decoder, LiveStatus& status) {
  status.driftRate_N_min = 0;
  const bool wentOn = std::exchange(status.driftsOn, false);
  if (!status.drift) return forgetPace();
  if (!seen_.empty() && time_s < seen_.back().first) forgetPace(); // a recording went back
  seen_.push_back({time_s, *status.drift});
  while (seen_.front().first < time_s - kPaceOver_s) seen_.pop_front();
  const auto [then_s, then] = seen_.front();
  const double minutes = (time_s - then_s) / 60;
  if (minutes < kPaceOver_s / 120) return; // too short a time to tell
  status.driftRate_N_min = decoder.drifted_N(*status.drift - then).norm() / minutes;
  status.steadyRate_N_min = kDriftShare * decoder.range_N();
  const double steady = wentOn ? kSteadier * status.steadyRate_N_min : status.steadyRate_N_min;
  status.driftsOn = status.tareSuggested && status.driftRate_N_min > steady;
}

} // namespace palp
