#pragma once

#include "app/study/live/LiveSession.h"
#include "io/board/SimulatedSource.h"
#include "tests/app/study/live/LiveFixture.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

namespace palp {

inline constexpr double kPatience_s = 10;

inline VirtualBoard paperBoard(int rate_Hz = 1000) {
  return simulatedBoard(shippedSamples(), {}, rate_Hz, 3);
}

/// A board that can be pulled out, silenced or refused from the test.
struct Plug {
  std::atomic<bool> in{true}, silent{false}, refused{false};
};

class PluggedSource : public SimulatedSource {
public:
  PluggedSource(VirtualBoard board, std::shared_ptr<Plug> plug)
      : SimulatedSource(std::move(board)), plug_(std::move(plug)) {}
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override {
    if (!plug_->in) return Outcome::Gone;
    if (!plug_->silent) return SimulatedSource::read(report, timeout);
    std::this_thread::sleep_for(timeout / 10);
    return Outcome::Nothing;
  }
  [[nodiscard]] std::string reason() const override { return "pulled out"; }

private:
  std::shared_ptr<Plug> plug_;
};

inline LiveOptions plugged(const std::shared_ptr<Plug>& plug) {
  LiveOptions options;
  options.open = [plug]() -> std::unique_ptr<ReportSource> {
    if (plug->refused) throw BoardPermissionError("no permission");
    if (!plug->in) return nullptr;
    return std::make_unique<PluggedSource>(paperBoard(), plug);
  };
  return options;
}

template <class Condition> bool waitFor(const LiveSession& live, const Condition& condition) {
  const double end_s = hostClock_s() + kPatience_s;
  while (hostClock_s() < end_s) {
    if (condition(live.status())) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

inline bool waitForState(const LiveSession& live, LiveState state) {
  return waitFor(live, [state](const LiveStatus& status) { return status.state == state; });
}

inline bool waitForFrames(const LiveSession& live, std::uint64_t frames) {
  return waitFor(live, [frames](const LiveStatus& status) { return status.counts.frames >= frames; });
}

} // namespace palp
