#pragma once

#include "app/study/live/LiveSession.h"
#include "io/ForceOutlet.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace palp {

/// What other programs get of a frame; NaN where a component is not measured.
OutgoingFrame outgoing(const LiveFrame& live, double host_unix_s);

/// What became of the frames of one outlet.
struct SenderCounts {
  std::uint64_t sent = 0;    ///< handed to the system
  std::uint64_t dropped = 0; ///< nobody took them, or they came faster than they went
  LatencySummary latency;    ///< from the decoded frame to its being sent
  std::string failure;       ///< why nothing is taken any more; empty while all is well
};

/// Sends frames to one outlet. Who gives them never waits: a receiver that stops reading loses frames, and nothing else
/// changes. An outlet that may wait has a thread of its own; any other is served by who gives, as a thread that must
/// wake first is milliseconds late on a busy computer.
class ForceSender {
public:
  /// `waits`: who gives waits while too many frames are there, as a recording can that is played as fast as it can be
  /// read; then only what the receiver refuses is lost.
  explicit ForceSender(std::unique_ptr<ForceOutlet> outlet, bool waits = false);
  /// Ends immediately; frames that wait are dropped.
  ~ForceSender();
  ForceSender(const ForceSender&) = delete;
  ForceSender& operator=(const ForceSender&) = delete;

  /// From any thread, with the host's clock since 1970-01-01 UTC, the same for all receivers.
  void give(std::shared_ptr<const LiveFrame> frame, double host_unix_s);
  [[nodiscard]] SenderCounts counts() const;
  /// Waits until all that was given is sent, at most so long; what still waits then is dropped.
  void finish(std::chrono::milliseconds most);

private:
  struct Waiting {
    std::shared_ptr<const LiveFrame> frame;
    double host_unix_s = 0;
    std::chrono::steady_clock::time_point given;
  };
  void run(const std::stop_token& stop);
  /// One frame, whose fate is counted.
  void send(const Waiting& next);

  std::unique_ptr<ForceOutlet> outlet_;
  bool waits_ = false;
  std::mutex direct_;        ///< one frame after another, where no thread of ours sends them
  mutable std::mutex mutex_; ///< of all below
  std::condition_variable_any changed_;
  std::deque<Waiting> waiting_;
  bool sending_ = false;
  SenderCounts counts_;
  LatencyMeter latency_;
  std::jthread thread_; ///< none where the outlet never waits; last: it uses all of the above
};

} // namespace palp
